"""What the estimator publishes."""
