"""The ROS 2 nodes: topics, services and parameters around the physics."""
