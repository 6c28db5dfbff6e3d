"""What is known of one unit from its readings, without ROS, for node and replay alike."""
