"""What the model says of every sample of a recording, and where that is written."""
