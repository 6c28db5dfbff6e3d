"""Many recordings through the model, on many processes or machines, into one data set."""

PURPOSE = 'archives of recordings'
"""For which libraries are needed"""
