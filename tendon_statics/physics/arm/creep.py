"""A motion past where an arm can only just not rest.

There one mode of the motion is slow, neither growing nor dying away much, while all others die
away soon. So stiff joints keep up with it, and what is left of f is along that mode u; how fast it
goes is of no account. So the motion is led far along u at once, to where the others are at rest,

    θ = θ_0 + s u + x,   f(θ) = (l·f) u,   l·u = 1,   l·x = 0,

with x from Newton's method, by the modes at the start. That is the slow manifold of a stiff system
to first order: Hairer and Wanner, "Solving Ordinary Differential Equations II", VI.3.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .linear_motion import LinearMotion, largest
from .motion import Motion

Floats = NDArray[np.float64]

FAR_ALONG = 0.05
"""s in rad, of the joint that moves most"""

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
    # u is scaled so that s is the way of the joint that moves most.
    mode, dual = linear.modes[:, slow], linear.inverse[slow]
    scale = float(np.copysign(abs(mode).max(), dual @ linear.velocity))
    along, dual = mode / scale, dual * scale
    fastest = soon * FAR_ALONG / SOON
    if abs(rates[slow]) > SLOW * soon or dual @ linear.velocity > fastest:
        return False
    gains = -1.0 / rates
    gains[slow] = 0.0
    to_rest: Floats = (linear.modes * gains) @ linear.inverse
    way = FAR_ALONG * along
    for _ in range(MOST_TRIALS):
        look = motion.after(way)
        velocity = motion.velocity(look)
        amiss = to_rest @ velocity
        if largest(amiss) <= CLOSE:
            break
        way = way + amiss
    else:
        return False
    sides = np.array(list(motion.moving.values()))
    if not 0.0 < dual @ velocity <= fastest or (sides * velocity < 0.0).any():
        return False
    if motion.changes_at(look, CLOSE * soon):
        return False
    motion.take(look)
    motion.change()
    return True
