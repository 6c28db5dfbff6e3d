# Source this in bash to use what `make setup` built: ROS 2, the estimator, tendon-statics.
# ROS_DISTRO chooses as it does for `make`.
_project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$_project/tools/ros_distro.bash"
_fault=$_unknown_distro
if [ -z "$_fault" ] && [ ! -f "$_project/$_made.venv/.complete" ]; then
  _fault="there is no set-up yet: run 'make setup${_made:+ ROS_DISTRO=$_distro}' in $_project"
fi
if [ -n "$_fault" ]; then
  echo "tendon_statics: $_fault" >&2
  unset _project _fault _distro _made _apt_root _unknown_distro
  unset -f has_apt_ros
  return 1
fi
# ROS's own scripts read variables that may be unset.
_options=$(set +o | grep nounset)
set +u
if has_apt_ros; then
  . "$_apt_root/setup.bash"
  . "$_project/$_made.venv/bin/activate"
else
  . "$_project/$_made.venv/bin/activate"
  export AMENT_PREFIX_PATH=$VIRTUAL_ENV CMAKE_PREFIX_PATH=$VIRTUAL_ENV
fi
if [ -f "$_project/${_made}install/local_setup.bash" ]; then
  . "$_project/${_made}install/local_setup.bash"
fi
eval "$_options"
unset _project _fault _options _distro _made _apt_root _unknown_distro
unset -f has_apt_ros
