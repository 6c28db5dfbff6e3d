"""Parameters of a table, declared on a ROS node and read from it."""
