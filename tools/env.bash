# Source this in bash to use what `make setup` built: ROS 2, the estimator, tendon-statics.
_project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ ! -f "$_project/.venv/.complete" ]; then
  echo "tendon_statics: there is no set-up yet: run 'make setup' in $_project" >&2
  unset _project
  return 1
fi
. "$_project/tools/ros_root.bash"
# ROS's own scripts read variables that may be unset.
_options=$(set +o | grep nounset)
set +u
if has_apt_ros; then
  . "$JAZZY_ROOT/setup.bash"
  . "$_project/.venv/bin/activate"
else
  . "$_project/.venv/bin/activate"
  export AMENT_PREFIX_PATH=$VIRTUAL_ENV CMAKE_PREFIX_PATH=$VIRTUAL_ENV
fi
if [ -f "$_project/install/local_setup.bash" ]; then
  . "$_project/install/local_setup.bash"
fi
eval "$_options"
unset _project _options JAZZY_ROOT
unset -f has_apt_ros
