"""Where a motion comes to rest: M = K of all joints that move, by Newton's method."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .linear_motion import largest
from .look import Look
from .motion import ROUNDING, Motion

Floats = NDArray[np.float64]

NEAR = 0.02
"""Way in rad from the place of rest, were the motion linear, within which this is tried"""

CLOSE = 1e-4
"""Way in rad by which the motion may not be linear, so that it goes where a linear one does"""

SLOW = 0.02
"""Share of a step of Newton's method that the next may be with the same Jacobian"""

TINY = 1e-6
"""Way in rad that is left to Newton's method in any case"""


def come_to_rest(motion: Motion, way: Floats, jacobian: Floats) -> float:
    """Go to where M = K for all that move, or stay where that is not where they go.

    Return by how much it was missed: zero if it was gone; else the share of the way by which f
    corrects the way; infinite if that is unknown.

    Parameters
    ----------
    way : array
        To where they would come to rest, were the motion linear.
    jacobian : array
        Of the motion, where it is.
    """
    total = np.zeros(len(way))
    for index in range(12):
        total = total + way
        if not largest(total) <= 2.0 * NEAR:
            break
        look = motion.after(total)
        if any(abs(look.angles[joint]) > motion.stops[joint] for joint in motion.moving):
            break
        velocity = motion.velocity(look)
        if _is_small(motion, velocity, look):
            motion.come_to_rest(look)
            return 0.0
        before, way = largest(way), -_solved(jacobian, velocity)
        if index == 0 and not largest(way) <= CLOSE:
            return largest(way) / before
        if index and largest(way) > SLOW * before:
            jacobian = motion.jacobian(look)
            way = -_solved(jacobian, velocity)
    return math.inf


def _is_small(motion: Motion, velocity: Floats, look: Look) -> bool:
    """Whether M = K of all that move, to far less than what sets them moving."""
    return all(
        abs(excess)
        <= max(0.01 * ROUNDING * look.capacity(joint, side)[0], 0.5 * motion.rounding[joint])
        for (joint, side), excess in zip(motion.moving.items(), velocity.tolist(), strict=True)
    )


def _solved(matrix: Floats, values: Floats) -> Floats:
    """Solve a linear equation; infinite where it cannot be."""
    try:
        return np.asarray(np.linalg.solve(matrix, values), np.float64)
    except np.linalg.LinAlgError:
        return np.full(len(values), math.inf)
