"""What the estimator listens to."""
