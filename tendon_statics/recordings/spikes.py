"""Where a few values stand out of those before and after them."""

from __future__ import annotations

import math

import numpy as np

from .session import Floats

LONGEST = 10
"""Values of a spike at most"""

UNTIMED = 3
"""Likewise where no times are known"""

BRIEF = 0.1
"""s; a longer pull may be meant"""

STANDS_OUT = 3.0
"""Times the largest other step by which a spike stands out of the values around it at least"""

STAYS = 10
"""Values after one at the beginning that stay where they are"""

AGREE = 0.1
"""Share of a spike's height by which the values before and after it differ at most"""


def spikes(
    values: Floats, least: float, time: Floats | None = None, lowest: float = -math.inf
) -> list[tuple[int, int]]:
    """First place and length of spikes: few values that stand out of those before and after.

    Upwards or downwards.

    NaN is none. A spike stands out of all steps that are of none, too, or the tensions go in
    steps that are meant.

    Parameters
    ----------
    least : float
        By which it stands out at least.
    time : ndarray, optional
        Of each value in s.
    lowest : float
        What is not above it is no spike downwards.
    """
    longest = _longest(time)
    found: list[tuple[int, int, float]] = []
    taken = np.zeros(len(values), dtype=bool)
    steps = abs(np.diff(values))
    of_spikes = np.zeros(len(steps), dtype=bool)
    for width in range(1, min(longest, len(values) - 2) + 1):
        windows = np.lib.stride_tricks.sliding_window_view(values[1:-1], width)
        before, after = values[: -width - 1], values[width + 1 :]
        least_inside, most_inside = windows.min(axis=1), windows.max(axis=1)
        up = least_inside - np.maximum(before, after)
        down = np.minimum(before, after) - most_inside
        height = np.where(least_inside > lowest, np.maximum(up, down), up)
        stands = (height > least) & (abs(after - before) <= AGREE * height)
        for place in (np.flatnonzero(stands) + 1).tolist():
            if not taken[place : place + width].any():
                found.append((place, width, float(height[place - 1])))
                taken[place : place + width] = True
                of_spikes[place - 1 : place + width] = True
    for signed in (values, -np.where(values > lowest, values, math.nan)):
        begun = _at_the_beginning(signed, least, longest)
        if begun is not None and not taken[: begun[0]].any():
            found.append((0, *begun))
            of_spikes[: begun[0]] = True
    others = steps[~of_spikes & np.isfinite(steps)]
    largest = float(others.max()) if len(others) else math.inf
    return sorted((place, width) for place, width, high in found if high > STANDS_OUT * largest)


def _longest(time: Floats | None) -> int:
    """How many values a spike has at most; one is never too long."""
    steps = np.diff(time[np.isfinite(time)]) if time is not None else np.array([])
    steps = steps[steps > 0.0]
    if not len(steps):
        return UNTIMED
    return int(np.clip(BRIEF / np.median(steps), 1, LONGEST))


def _at_the_beginning(values: Floats, least: float, longest: int) -> tuple[int, float] | None:
    """Length and height of a spike that the first values are, after which a level stays."""
    for width in range(1, longest + 1):
        level = values[width : width + STAYS]
        if len(level) < STAYS:
            break
        height = float(values[:width].min() - level.max())
        if height > least and np.ptp(level) <= AGREE * height:
            return width, height
    return None
