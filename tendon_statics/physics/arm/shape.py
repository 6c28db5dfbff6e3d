"""Where the units of an arm are, from its bend angles."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .arm import Arm

Floats = NDArray[np.float64]


class TipPose(NamedTuple):
    """The end of the last unit in the base's frame, or the standard deviations of that."""

    x: float
    """In m, towards cables s"""
    z: float
    """In m, along the first unit at zero bend, from the centre of the first joint"""
    tilt: float
    """Θ_n = θ_1 + … + θ_n in rad, positive towards s"""

    def as_dict(self) -> dict[str, float]:
        """Return it ready for JSON."""
        return self._asdict()


def joint_centres(arm: Arm, bend_angles: tuple[float, ...]) -> list[tuple[float, float]]:
    """Return the (x, z) of all joint centres in m, and of the tip, in the base's frame."""
    x = z = tilt = 0.0
    found = [(x, z)]
    for unit, angle in zip(arm.units, bend_angles, strict=True):
        tilt += angle
        x += unit.length * math.sin(tilt)
        z += unit.length * math.cos(tilt)
        found.append((x, z))
    return found


def tip_pose(arm: Arm, bend_angles: tuple[float, ...]) -> TipPose:
    """Return where the tip is."""
    return TipPose(*joint_centres(arm, bend_angles)[-1], sum(bend_angles))


def tip_poses(arm: Arm, bend_angles: Floats) -> Floats:
    """Return where the tips of many arms are: x, z and tilt, shape ``(3, arms)``.

    Parameters
    ----------
    bend_angles : ndarray
        In rad, shape ``(arms, joints)``.
    """
    tilts = np.cumsum(bend_angles, axis=1)
    lengths = np.array([unit.length for unit in arm.units])
    return np.array([np.sin(tilts) @ lengths, np.cos(tilts) @ lengths, tilts[:, -1]])


def tip_by_angles(arm: Arm, bend_angles: tuple[float, ...]) -> list[TipPose]:
    """Return the derivatives of the tip's pose by each bend angle.

    A joint turns all beyond it about its centre.
    """
    centres = joint_centres(arm, bend_angles)
    tip_x, tip_z = centres[-1]
    return [TipPose(tip_z - z, x - tip_x, 1.0) for x, z in centres[:-1]]
