"""From what load cells say to tensions, for node and replay alike; it needs no ROS."""
