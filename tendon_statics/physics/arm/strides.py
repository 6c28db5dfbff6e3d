"""A long motion in strides, each over all that joints begin and cease on its way.

The velocities f = ±max(|M| − K, 0) of all joints are continuous in their angles, also where a
joint comes to its limit or falls below it, and so they are where it meets its stop if it is let go
on beyond that, while the arm stays as at the stop. A Runge-Kutta method needs no more: what bends
sharply within a step shows in the estimate of its error. This is the pair of orders 5 and 4 by
Dormand and Prince, J. Comput. Appl. Math. 6 (1980), whose last stage is the first of the next.

What cables with friction remember is that of the way so far, taken for straight within a stride;
but where joints come through the straight, at which the cables forget, it is taken as it bends.

It is far cheaper than `legs`, of which one ends at each such event, but short of breath: what dies
away fast shortens it, as before the rest. So legs go on where strides become short.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .excess import Look
from .legs import FAR, Leg, aside_and_along
from .linear_motion import Path
from .motion import Motion

Floats = NDArray[np.float64]

STIFF = 2.0
"""λ t up to which what dies away at the rate λ does not shorten a stride of the time t, as about
where the method is stable"""

SHORT = 0.01
"""Way in rad below which a stride is short"""

MOST_STRIDES = 200
MOST_LONGER = 5.0
"""Than one stride the next"""

PASSING = 0.15
"""Way in rad of a stride at the most if a joint comes through the straight on it, where cables
with friction forget"""

PARTS = (0.25, 0.5, 0.75)
"""Of a stride, between which its way is taken for straight where that counts"""

DAMPING = 0.08
"""How much the error of the stride before counts for the next: where errors grow from stride to
stride it is shorter, so that fewer are tried in vain (Gustafsson's control; Hairer and Wanner,
"Solving Ordinary Differential Equations II", IV.2)"""

ERROR_ASIDE, ERROR_ALONG = 8e-5, 1e-3
"""Error of a stride in rad that is accepted, across the motion and along it: how fast it goes is
of no account, but the velocity at the end tells what is along it for a short way only"""

STAGES: list[Floats] = [
    np.array(weights)
    for weights in (
        [1 / 5],
        [3 / 40, 9 / 40],
        [44 / 45, -56 / 15, 32 / 9],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    )
]
"""Of the velocities before it, in the way to each stage; the last stage is the end"""

ERROR_WEIGHTS: Floats = np.array(
    [71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40]
)
"""Of all velocities, in the difference of the two ways"""


def suits_strides(leg: Leg) -> bool:
    """Return whether a motion that begins as a leg is better gone in strides."""
    return not leg.may_rest and leg.linear.decay * leg.time <= STIFF


def go_strides(motion: Motion, time: float) -> None:
    """Go strides until one is short.

    Parameters
    ----------
    time : float
        Of the first one, to try.
    """
    highest = np.array(motion.stops)
    lowest = -highest
    angles = np.array(motion.look.angles)
    velocities: Floats = np.empty((len(ERROR_WEIGHTS), len(angles)))
    velocities[0] = motion.look.flow(motion.leaning())
    before = 1.0
    for _ in range(MOST_STRIDES):
        leaning, look = motion.leaning(), motion.look
        for number, weights in enumerate(STAGES, start=1):
            beyond = angles + time * weights.dot(velocities[:number])
            end = np.minimum(np.maximum(beyond, lowest), highest)
            look = motion.look_at(end.tolist())
            velocities[number] = look.flow(leaning)
        far = float(abs(end - angles).max())
        stopped = end != beyond
        last = np.where(stopped, 0.0, velocities[-1])
        error = np.where(stopped, 0.0, time * ERROR_WEIGHTS.dot(velocities))
        aside, along = aside_and_along(error, last)
        share = max(aside / ERROR_ASIDE, along / ERROR_ALONG) if far <= 2.0 * FAR else math.inf
        passes = motion.rubs and bool((angles * end < 0.0).any())
        if passes:
            share = max(share, (far / PASSING) ** 5)
        if share <= 1.0:
            if passes:
                ends = np.array([angles, end]).T, np.array([velocities[0], last]).T
                look = _gone_along(motion, Path(np.array([0.0, time]), *ends))
                last = np.where(stopped, 0.0, look.flow(leaning))
            motion.set_out_from(look)
            angles, velocities[0], least = end, last, SHORT
            longer = 0.9 * max(share, 1e-6) ** (0.75 * DAMPING - 0.2) * before**DAMPING
            before = max(share, 1e-3)
        else:  # what bends sharply is soon behind
            least, longer = 0.5 * SHORT, 0.9 * share**-0.2
        longer = min(longer, MOST_LONGER)
        if not (motion.moving and far * longer >= least):
            return
        time *= max(min(longer, FAR / far), 1.0 / MOST_LONGER)


def _gone_along(motion: Motion, path: Path) -> Look:
    """Let the cables remember the way of a stride as it bends; return what is at its end."""
    stops = np.array(motion.stops)
    for part in PARTS:
        angles = path.way(part * float(path.times[1]), 1)
        motion.take(motion.look_at(np.clip(angles, -stops, stops).tolist()))
    return motion.look_at(path.ways[:, 1].tolist())
