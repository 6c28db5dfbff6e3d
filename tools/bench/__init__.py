"""The bench: how fast the package is beside what it could be, all within one run."""
