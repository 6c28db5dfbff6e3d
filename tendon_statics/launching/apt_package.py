"""What ROS's packages are called where they are installed from."""

from __future__ import annotations

import os


def apt_package(name: str) -> str:
    """Return the Debian package of one of ROS's own, in the distribution that is in use."""
    return f'ros-{os.environ.get("ROS_DISTRO") or "jazzy"}-{name.replace("_", "-")}'
