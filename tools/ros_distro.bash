# Sourced by the other scripts: which ROS 2 is meant (ROS_DISTRO), in front of which folder's name
# that of its environment and installation goes, and where apt's is, if it is.
_distro=${ROS_DISTRO:-jazzy}
_made=
[ "$_distro" = jazzy ] || _made=build/$_distro/
_apt_root=${APT_ROS_ROOT:-/opt/ros/$_distro}
case $_distro in
  jazzy | kilted) _unknown_distro= ;;
  *) _unknown_distro="ROS_DISTRO is '$_distro': it takes jazzy, the default, or kilted" ;;
esac

has_apt_ros() {
  [ -f "$_apt_root/setup.bash" ]
}
