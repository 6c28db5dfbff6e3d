"""A motion past where an arm can only just not rest.

There one mode of the motion is slow, neither growing nor dying away much, while all others die
away soon. So stiff joints keep up with it, and what is left of f is along that mode u; how fast it
goes is of no account. So the motion is led far along u at once, to where the others are at rest,

    θ = θ_0 + s u + x,   f(θ) = (l·f) u,   l·u = 1,   l·x = 0,

with x from Newton's method, by the modes at the start. That is the slow manifold of a stiff system
to first order: Hairer and Wanner, "Solving Ordinary Differential Equations II", VI.3.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .linear_motion import LinearMotion, largest
from .look import Look
from .motion import Motion

Floats = NDArray[np.float64]

FAR_ALONG = (0.05, 0.02)
"""s in rad, of the joint that moves most, to try"""

SLOW = 0.3
"""Share of the rate of the others at which the slow mode may grow or die away at the most"""

SOON = 3.0
"""How often the others have to die away on the way, by a factor of e"""

CLOSE = 1e-4
"""Error of the way in rad that is accepted"""

MOST_TRIALS = 4


def creep(motion: Motion, linear: LinearMotion) -> bool:
    """Go far along a slow mode; return False if there is none, or something changes on the way.

    Parameters
    ----------
    linear : LinearMotion
        The motion, as it is where it begins.
    """
    rates = linear.rates
    if len(rates) < 2 or np.iscomplexobj(rates):
        return False
    slow = int(rates.argmax())
    soon = -float(np.delete(rates, slow).max())
    if abs(rates[slow]) > SLOW * soon:
        return False
    # u is scaled so that s is the way of the joint that moves most.
    mode, dual = linear.modes[:, slow], linear.inverse[slow]
    scale = math.copysign(largest(mode), dual @ linear.velocity)
    along, dual = mode / scale, dual * scale
    gains = -1.0 / rates
    gains[slow] = 0.0
    to_rest: Floats = (linear.modes * gains) @ linear.inverse
    sides = np.array(list(motion.moving.values()))
    for far in FAR_ALONG:
        fastest = soon * far / SOON
        if dual @ linear.velocity > fastest:
            break
        look = _led_along(motion, far * along, to_rest)
        if look is None or motion.changes_at(look, CLOSE * soon):
            continue
        velocity = motion.velocity(look)
        if 0.0 < dual @ velocity <= fastest and (sides * velocity >= 0.0).all():
            motion.take(look)
            motion.change()
            return True
    return False


def _led_along(motion: Motion, way: Floats, to_rest: Floats) -> Look | None:
    """Let all modes but the slow one come to rest about a way; None if they do not."""
    for _ in range(MOST_TRIALS):
        look = motion.after(way)
        amiss = to_rest @ motion.velocity(look)
        if largest(amiss) <= CLOSE:
            return look
        way = way + amiss
    return None
