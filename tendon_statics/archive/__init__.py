"""Many recordings through the model, on many processes or machines, into one data set."""
