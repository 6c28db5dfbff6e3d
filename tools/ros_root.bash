# Sourced by the other scripts: where apt's ROS 2 is, if it is.
ROS_ROOT=${ROS_ROOT:-/opt/ros/jazzy}

has_apt_ros() {
  [ -f "$ROS_ROOT/setup.bash" ]
}
