"""Where gravity points in a frame that an orientation, or an accelerometer at rest, tells."""

from __future__ import annotations

import math

from ..physics.errors import TendonStaticsError

Vector = tuple[float, float, float]

UNIT_TOLERANCE = 1e-3
"""By how much the length of a quaternion may differ from 1: three decimals, or single precision"""

STANDARD_GRAVITY = 9.81
"""m/s²"""

REST_TOLERANCE = 0.1
"""Share by which the acceleration of a base at rest may differ from gravity's, by the scale and
the bias of a sensor"""


class OrientationError(TendonStaticsError, ValueError):
    """What is measured tells no direction of gravity; the text is for the user."""


def gravity_in_frame(x: float, y: float, z: float, w: float) -> Vector:
    """Return gravity's direction in a frame of an orientation in a frame whose Z is up.

    It is the third row of the rotation from the one to the other, negated.

    Parameters
    ----------
    x, y, z, w : float
        Quaternion of the rotation that turns the frame whose Z is up into the other.

    Raises
    ------
    OrientationError
        If it is not finite, or not of length 1.
    """
    length = math.hypot(x, y, z, w)
    if not abs(length - 1.0) <= UNIT_TOLERANCE:
        what = 'not finite' if not math.isfinite(length) else f'of length {length:.6g}'
        raise OrientationError(
            f'the quaternion ({x:.6g}, {y:.6g}, {z:.6g}, {w:.6g}) is {what}; one of length 1 is '
            'needed'
        )
    x, y, z, w = (part / length for part in (x, y, z, w))
    return 2.0 * (w * y - x * z), -2.0 * (y * z + w * x), 2.0 * (x * x + y * y) - 1.0


def gravity_from_acceleration(x: float, y: float, z: float) -> Vector:
    """Return gravity's direction in the frame of an accelerometer at rest, which measures up.

    Parameters
    ----------
    x, y, z : float
        Measured acceleration in m/s², gravity included.

    Raises
    ------
    OrientationError
        If it is not that of a base at rest.
    """
    length = math.hypot(x, y, z)
    if not abs(length - STANDARD_GRAVITY) <= REST_TOLERANCE * STANDARD_GRAVITY:
        raise OrientationError(
            f'the acceleration ({x:.6g}, {y:.6g}, {z:.6g}) is of {length:.6g} m/s^2; of a base at '
            f'rest {STANDARD_GRAVITY:g} m/s^2 are measured'
        )
    return -x / length, -y / length, -z / length


def turned(vector: Vector, roll: float, pitch: float, yaw: float) -> Vector:
    """Turn a vector about the fixed axes X, Y and Z in turn, by angles in rad as in URDF."""
    x, y, z = vector
    y, z = y * math.cos(roll) - z * math.sin(roll), y * math.sin(roll) + z * math.cos(roll)
    x, z = x * math.cos(pitch) + z * math.sin(pitch), z * math.cos(pitch) - x * math.sin(pitch)
    x, y = x * math.cos(yaw) - y * math.sin(yaw), x * math.sin(yaw) + y * math.cos(yaw)
    return x, y, z


def roll_and_pitch(gravity_direction: Vector) -> tuple[float, float]:
    """Return the turns in rad, about X and then Y, of a base in which gravity points so.

    The turn about the vertical is not known; it is 0.
    """
    x, y, z = gravity_direction
    return math.atan2(-y, -z), math.atan2(x, math.hypot(y, z))
