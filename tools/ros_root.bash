# Sourced by the other scripts: where apt's ROS 2 is, if it is.
JAZZY_ROOT=${JAZZY_ROOT:-/opt/ros/jazzy}

has_apt_ros() {
  [ -f "$JAZZY_ROOT/setup.bash" ]
}
