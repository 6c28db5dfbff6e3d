"""A long motion in strides, each over all that joints begin and cease on its way.

The velocities f = ±max(|M| − K, 0) of all joints are continuous in their angles, also where a
joint comes to its limit or falls below it, and so they are where it meets its stop if it is let go
on beyond that, while the arm stays as at the stop. A Runge-Kutta method needs no more: what bends
sharply within a step shows in the estimate of its error. This is the pair of orders 3 and 2 by
Bogacki and Shampine, Appl. Math. Lett. 2 (1989), whose last stage is the first of the next; with
so many bends a higher order gains nothing.

What cables with friction remember is that of the way so far, taken for straight within a stride;
but where joints come through the straight, at which the cables forget, it is taken as it bends.

It is far cheaper than `legs`, of which one ends at each such event, but short of breath: what dies
away fast shortens it, as before the rest. So legs go on where strides become short, and lead the
last joints to rest.
"""

from __future__ import annotations

import math

import numpy as np

from .legs import FAR, Leg, aside_and_along
from .linear_motion import Path
from .motion import Motion
from .rest import NEAR

STIFF = 3.0
"""λ t up to which strides of the time t are tried where something dies away at the rate λ: about
where the method is stable"""

SHORT = 0.01
"""Way in rad of the first stride, to try"""

LEAST = 0.002
"""Way in rad below which legs are better"""

FEW = 2
"""Joints that are better led to rest by legs, if that is `NEAR`"""

MOST_STRIDES = 200
MOST_LONGER = 5.0
"""Than one stride the next"""

SAFE = 0.7
"""Share of a stride whose error would just be accepted, that the next is made: what bends sharply
ahead is not foreseen"""

PASSING = 0.15
"""Way in rad of a stride at the most if a joint comes through the straight on it, where cables
with friction forget"""

PARTS = (0.25, 0.5, 0.75)
"""Of a stride, between which its way is taken for straight where that counts"""

ERROR_ASIDE, ERROR_ALONG = 5e-4, 2e-3
"""Error of a stride in rad that is accepted for an arm of `MANY` joints, across the motion and
along it: how fast it goes is of no account, but the velocity at the end tells what is along it for
a short way only"""

MANY = 10
"""Joints: the motion of fewer bends less often, so that less error takes little time"""

SLOWING = 0.5
"""Share of that which is accepted where the motion slows down: where it becomes faster most joints
are on their way to stops, at which errors are forgotten"""


def first_stride(leg: Leg, joints: int) -> float | None:
    """Return the time of a stride to try in the place of a leg; None if the leg is better.

    Parameters
    ----------
    joints : int
        Of the arm.
    """
    if leg.may_rest or joints <= FEW:
        return None
    time = leg.linear.far(SHORT)
    return time if leg.linear.decay * time <= STIFF else None


def go_strides(motion: Motion, time: float) -> None:
    """Go strides until one is short, or few joints are near their rest.

    Parameters
    ----------
    time : float
        Of the first one, to try.
    """
    angles = motion.look.angles
    velocities = motion.flow(angles, motion.leaning(angles))
    scale = min(len(angles) / MANY, 1.0) ** 2
    for _ in range(MOST_STRIDES):
        end, last, error = _stride(motion, angles, velocities, time)
        far = max([abs(new - old) for old, new in zip(angles, end, strict=True)])
        aside, along = aside_and_along(error, last)
        passes = motion.rubs and any(old * new < 0.0 for old, new in zip(angles, end, strict=True))
        most = PASSING if passes else 2.0 * FAR
        before, after = max(map(abs, velocities)), max(map(abs, last))
        allowed = scale * (SLOWING if after < before else 1.0)
        amiss = max(aside / ERROR_ASIDE, along / ERROR_ALONG) / allowed
        share = max(amiss, (far / most) ** 3, 1e-6)
        if share <= 1.0:
            if after == 0.0 and not all(
                v == 0.0 or abs(angle) == stop
                for v, angle, stop in zip(velocities, end, motion.stops, strict=True)
            ):
                break  # beyond where some come to rest, which legs find exactly
            if passes:
                last = _gone_along(motion, time, end, (velocities, last))
            elif motion.rubs:
                motion.take(motion.look_at(end))
            angles, velocities = end, last
            if sum(map(bool, last)) <= FEW and far * after <= NEAR * (before - after):
                break
        longer = min(SAFE * share ** (-1.0 / 3.0), MOST_LONGER)
        if far * longer < LEAST:
            break
        longer = min(longer, FAR / far)
        if share <= 1.0:  # what becomes faster goes farther in the same time
            longer /= max(1.0, after * time / far)
        time *= max(longer, 1.0 / MOST_LONGER)
    motion.set_out_from(motion.look_at(angles))


def _stride(
    motion: Motion, angles: list[float], velocities: list[float], time: float
) -> tuple[list[float], list[float], list[float]]:
    """Return the angles at the end of a stride, the velocities there, and the angles' errors.

    What meets its stop has neither.
    """
    leaning, stops, first = motion.leaning(angles), motion.stops, velocities
    second = motion.flow(_after(angles, first, 0.5 * time, stops), leaning)
    third = motion.flow(_after(angles, second, 0.75 * time, stops), leaning)
    mean = [
        (2.0 * one + 3.0 * two + 4.0 * three) / 9.0
        for one, two, three in zip(first, second, third, strict=True)
    ]
    end = _after(angles, mean, time, stops)
    fourth = motion.flow(end, leaning)
    errors = [
        time * (-5.0 * one + 6.0 * two + 8.0 * three - 9.0 * four) / 72.0
        for one, two, three, four in zip(first, second, third, fourth, strict=True)
    ]
    for joint, stop in enumerate(stops):
        if mean[joint] and abs(end[joint]) == stop:
            fourth[joint] = errors[joint] = 0.0
    return end, fourth, errors


def _after(
    angles: list[float], velocities: list[float], time: float, stops: tuple[float, ...]
) -> list[float]:
    """Return the angles after a time at some velocities, within the stops."""
    return [
        angle
        if -stop <= (angle := start + time * velocity) <= stop
        else math.copysign(stop, angle)
        for start, velocity, stop in zip(angles, velocities, stops, strict=True)
    ]


def _gone_along(
    motion: Motion, time: float, end: list[float], velocities: tuple[list[float], list[float]]
) -> list[float]:
    """Let the cables remember the way of a stride as it bends; return the velocities at its end.

    Parameters
    ----------
    velocities : pair of list of float
        At its start and at its end.
    """
    ways = np.array([motion.look.angles, end]).T
    path = Path(np.array([0.0, time]), ways, np.array(velocities).T)
    stops = np.array(motion.stops)
    for part in PARTS:
        angles = path.way(part * time, 1)
        motion.take(motion.look_at(np.clip(angles, -stops, stops).tolist()))
    motion.take(motion.look_at(end))
    return motion.flow(end, motion.leaning(end))
