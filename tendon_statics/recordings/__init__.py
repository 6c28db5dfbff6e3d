"""Recorded sessions: tables and ROS bags in, results out, without a ROS installation."""
