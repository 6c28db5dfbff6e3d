"""What acts on a unit beside its cables, from messages: gravity, and a force at the tip."""

from __future__ import annotations

import math
from collections.abc import Callable

from ...estimation.orientation import (
    OrientationError,
    Vector,
    gravity_from_acceleration,
    gravity_in_frame,
    turned,
)
from .bag_storage import Message
from .bag_values import BARE_WRENCH, WRENCH

IMU = 'sensor_msgs/msg/Imu'
POSE = 'geometry_msgs/msg/PoseStamped'
ORIENTATION = 'geometry_msgs/msg/QuaternionStamped'
BASES = (IMU, POSE, ORIENTATION)
"""Types that tell how the base is turned"""

WRENCHES = (WRENCH, BARE_WRENCH)


def base_angles(
    imu_mounting: tuple[float, float, float],
) -> Callable[[Message], tuple[float, float] | None]:
    """Return what reads tilt and roll of the base in rad, None where a message tells neither.

    Parameters
    ----------
    imu_mounting : tuple of float
        Roll, pitch and yaw of an IMU in the joint frame, in rad.
    """

    def angles(message: Message) -> tuple[float, float] | None:
        try:
            x, y, z = _gravity(message, imu_mounting)
        except OrientationError:
            return None
        return math.atan2(x, -z), -math.asin(max(-1.0, min(y, 1.0)))

    return angles


def tip_force(component: str) -> Callable[[Message], float]:
    """Return what reads a component of the force of a wrench, in N."""

    def value(message: Message) -> float:
        content = message.content
        force = content.wrench.force if message.kind == WRENCH else content.force
        return float(getattr(force, component))

    return value


def _gravity(message: Message, imu_mounting: tuple[float, float, float]) -> Vector:
    """Gravity's direction in the joint frame.

    Raises
    ------
    OrientationError
        If the message tells none.
    """
    content = message.content
    if message.kind == IMU:
        # REP 145: a covariance that begins with -1 says that there is no orientation.
        has_orientation = content.orientation_covariance[0] != -1.0
        q, a = content.orientation, content.linear_acceleration
        if has_orientation and any((q.x, q.y, q.z, q.w)):
            in_imu = gravity_in_frame(q.x, q.y, q.z, q.w)
        else:
            in_imu = gravity_from_acceleration(a.x, a.y, a.z)
        return turned(in_imu, *imu_mounting)
    q = content.pose.orientation if message.kind == POSE else content.quaternion
    return gravity_in_frame(q.x, q.y, q.z, q.w)
