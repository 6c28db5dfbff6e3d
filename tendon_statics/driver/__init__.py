"""The stand-in for motor drivers."""
