"""A motion in one go, where it is as good as linear."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .excess import Look
from .linear_motion import LinearMotion
from .motion import ROUNDING, TOLERANCE, Motion

Floats = NDArray[np.float64]

NEAR = 0.02
"""Way in rad from the place of rest, were the motion linear, within which this is tried"""

BARELY = 1e-4
"""Way in rad from a place of rest that is left, where a joint is so slow at first that this is
tried too"""

TINY = 1e-6
"""Way in rad that is left to Newton's method in any case"""

SMALL = 1e-3
"""Share of the fastest joint's velocity by which another may seem to fall below its limit"""


def go_on(motion: Motion, velocity: Floats, jacobian: Floats, growth: float) -> bool:
    """Go as far as the same joints move, if that is as good as linear; return whether it was.

    Parameters
    ----------
    velocity, jacobian : array
        Of the motion, where it is.
    growth : float
        The fastest rate at which it grows; below zero where it dies away.
    """
    rest = -_solved(jacobian, velocity)
    reach = abs(rest).max()
    dies = growth < 0.0
    if not reach <= (NEAR if dies else BARELY):
        return False
    if reach <= TINY and dies:
        return _end(motion, rest, jacobian)
    try:
        linear = LinearMotion(jacobian, velocity)
    except np.linalg.LinAlgError:
        return False
    time = linear.first(_changes(motion, linear, jacobian))
    if math.isfinite(time):
        return _leg(motion, linear, time)
    return dies and _end(motion, rest, jacobian)


def _leg(motion: Motion, linear: LinearMotion, time: float) -> bool:
    """Go on to where the joints that move are no longer the same."""
    ways, velocities = linear.at(np.array([time]))
    after = motion.after(ways[:, 0])
    found = motion.velocity(after)
    fastest = max(abs(linear.velocity).max(), abs(found).max())
    amiss = abs(found - velocities[:, 0]).max() / fastest * abs(ways).max()
    if not amiss <= TOLERANCE:
        return False
    motion.take(after)
    motion.change()
    return True


def _end(motion: Motion, way: Floats, jacobian: Floats) -> bool:
    """Go to where M = K for all that move, by Newton's method.

    Parameters
    ----------
    way : array
        Its first step.
    """
    total = np.zeros(len(way))
    for index in range(12):
        total = total + way
        if not abs(total).max() <= 2.0 * NEAR:
            return False
        look = motion.after(total)
        if any(abs(look.angles[joint]) > motion.stops[joint] for joint in motion.moving):
            return False
        velocity = motion.velocity(look)
        if _is_small(motion, velocity, look):
            motion.come_to_rest(look)
            return True
        if index:
            jacobian = motion.jacobian(look)
        way = -_solved(jacobian, velocity)
        if index == 0 and not abs(way).max() <= TOLERANCE:
            return False
    return False


def _is_small(motion: Motion, velocity: Floats, look: Look) -> bool:
    """Whether M = K of all that move, to far less than what sets them moving."""
    return all(
        abs(excess)
        <= max(0.01 * ROUNDING * look.capacity(joint, side)[0], 0.5 * motion.rounding[joint])
        for (joint, side), excess in zip(motion.moving.items(), velocity.tolist(), strict=True)
    )


def _changes(
    motion: Motion, linear: LinearMotion, jacobian: Floats
) -> Callable[[Floats], NDArray[np.bool_]]:
    """Return what tells whether other joints move than at the start, at each of some times."""
    sides = np.array(list(motion.moving.values()))
    angles = np.array([motion.look.angles[joint] for joint in motion.moving])
    to_go = np.array([motion.stops[joint] for joint in motion.moving]) - sides * angles
    if motion.rubs:  # to where it is straight, if it has that before it
        to_go = np.where(sides * angles < 0.0, -sides * angles, to_go)
    resting = motion.resting()
    lacking = -np.array([excess for _, excess in resting.values()])[:, None]
    rows = motion.excess_rows({joint: side for joint, (side, _) in resting.items()})
    sides, to_go = sides[:, None], to_go[:, None]
    ahead = sides * jacobian

    def changes(times: Floats) -> NDArray[np.bool_]:
        ways, velocities = linear.at(times)
        falls = sides * velocities < -SMALL * abs(velocities).max(axis=0)
        falls &= ahead @ velocities < 0.0
        falls |= sides * ways >= to_go
        found: NDArray[np.bool_] = falls.any(axis=0)
        found |= abs(ways).max(axis=0) > 2.0 * NEAR
        if resting:
            found |= (rows @ ways > lacking).any(axis=0)
        return found

    return changes


def _solved(matrix: Floats, values: Floats) -> Floats:
    """Solve a linear equation; infinite where it cannot be."""
    try:
        return np.asarray(np.linalg.solve(matrix, values), np.float64)
    except np.linalg.LinAlgError:
        return np.full(len(values), math.inf)
