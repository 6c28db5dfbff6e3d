"""A motion step by step, while it is the same joints that move."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .excess import Look
from .motion import ROUNDING, TOLERANCE, Motion
from .rosenbrock import cubic_path, rosenbrock_step

Floats = NDArray[np.float64]

STEP_ERROR = 1e-4
"""Error of one step in rad that is accepted, as estimated: of an order less, so far too large"""

STRAIGHT = 1e-4
"""How exactly in rad a step ends where a joint with friction of the cables comes to be straight,
where its guides let no tension be but the one before them"""

JUST_BEYOND = 0.01
"""Share of a step by which it is to go beyond where other joints move, so that they do"""


def step_on(motion: Motion, velocity: Floats, jacobian: Floats, step: float) -> float:
    """Go one step on, as long as is right; return what the next may be.

    Parameters
    ----------
    velocity, jacobian : array
        Of the motion, where it is.
    step : float
        What to try, in rad/(N m).
    """
    tried = step
    while True:
        try:
            way, error = rosenbrock_step(
                lambda way: motion.velocity(motion.after(way)), velocity, jacobian, step
            )
            worst = float(abs(error).max()) / STEP_ERROR
        except np.linalg.LinAlgError:
            worst = math.inf
        if not worst <= 1.0:
            step *= max(0.2, 0.9 * worst ** (-1.0 / 3.0)) if math.isfinite(worst) else 0.1
            tried = step
            continue
        after = motion.after(way)
        share = _until(motion, after, velocity, jacobian, step)
        if share < 1.0:
            path = cubic_path(way, step * velocity, step * motion.velocity(after))
            if path is None:  # rushed through, so that only a shorter step tells
                step *= max(share, 1e-3)
                continue
            part = 1.0
            while share < 1.0:
                part *= min(share + JUST_BEYOND, 1.0 - JUST_BEYOND)
                after = motion.after(path(part))
                share = _until(motion, after, velocity, jacobian, part * step)
        motion.take(after)
        motion.change()
        growth: float = 0.9 * max(worst, 1e-6) ** (-1.0 / 3.0)
        return tried * min(6.0, growth)


def _until(motion: Motion, after: Look, velocity: Floats, jacobian: Floats, step: float) -> float:
    """Return the share of a step after which the joints that move are no longer the same.

    It is 1 where they are to its end, or nearly.
    """
    found = 1.0
    for place, (joint, side) in enumerate(motion.moving.items()):
        start, end, stop = motion.look.angles[joint], after.angles[joint], motion.stops[joint]
        beyond = side * end - stop
        if beyond > TOLERANCE:
            found = min(found, (stop - side * start) / (side * (end - start)))
        if motion.rubs and min(-side * start, side * end) > STRAIGHT:
            found = min(found, start / (start - end))
        left = side * after.velocity(joint, side)
        if _counts(-left, step, jacobian[place, place]):
            was = side * float(velocity[place])
            found = min(found, was / (was - left) if was > 0.0 else 0.0)
    for joint in range(len(motion.stops)):
        if joint in motion.moving:
            continue
        side, excess, capacity = after.drive(joint)
        if side * after.angles[joint] >= motion.stops[joint]:
            continue
        if excess > max(ROUNDING * capacity, motion.rounding[joint]) and _counts(
            excess, step, 0.0
        ):
            _, was, _ = motion.look.drive(joint)
            found = min(found, -was / (excess - was) if was < 0.0 else 1.0)
    return found


def _counts(excess: float, step: float, slope: float) -> bool:
    """Whether a joint would go somewhere in a step with an excess that it should not have."""
    rate = max(1.0 / step, abs(slope))
    return excess > TOLERANCE * rate
