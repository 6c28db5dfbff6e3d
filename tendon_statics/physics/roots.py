"""All roots of a function of which bounds of the slope are known; no physics.

An interval over which the slope keeps its sign holds one root or none, which the signs at its ends
tell. One over which the function, with such a slope, cannot come down to zero holds none. Any
other is halved.
"""

from __future__ import annotations

import math
from typing import Any, Protocol

ANGLE_TOLERANCE = 1e-10
"""Width in rad of the bracket at which the search for a root ends; the paper's"""

FLAT_WIDTH = 1e-8
"""Width of an interval in which the rounding of the function hides its slope, if it got this
narrow"""

MOST_INTERVALS = 4000
"""Intervals that are looked at before the rest is taken as too flat to resolve; a few suffice for
any function but one made up to be flat"""

USUAL_STEPS = 4
"""Steps after which every other one halves the bracket; four or five are enough as a rule"""

MOST_HELPED_STEPS = 20
"""Steps after which each halves the bracket"""

CLOSE = 1e-8
"""Length in rad of a step so short that Newton's is exact as a rule; it takes less to work out"""

OVERSHOOT = 0.45 * ANGLE_TOLERANCE
"""How far beyond the root the last step is aimed, so that rounding does not put it before"""

LEAST = 5e-324
"""Added to what may be zero, so that what is divided by it is infinite: no other number changes"""

SAME = 1e-15
"""Distance in rad within which a place is the root"""


Probe = tuple[Any, ...]
"""A function at one place: place, value, slope, and what else it wants to know of it again"""


class BoundedFunction(Protocol):
    """A function of one variable."""

    def probe(self, place: float) -> Probe:
        """Return the function at a place."""

    def slope_bounds(self, one: Probe, other: Probe) -> tuple[float, float]:
        """Return bounds of the slope between two probes, the other ahead of the one.

        NaN or infinite where there are none.
        """


Bracket = tuple[Probe, Probe]
"""Two probes with one root between them, over which the function changes sign"""


def brackets(function: BoundedFunction, low: Probe, high: Probe) -> list[Bracket]:
    """Return ascending, disjoint brackets that hold one root each, and all roots together.

    A root at `low` itself comes as a bracket of no width. Where two roots merge, within about
    1e-7 rad, rounding decides whether they are seen as two or as none.
    """
    found = [(low, low)] if low[1] == 0.0 else []
    pending = [(low, high)]
    unresolved: list[Bracket] = []
    # It grows while it is gone through, level by level, so that at the limit what is left is of
    # one width.
    for interval in pending:
        left, right = interval
        least, greatest = function.slope_bounds(left, right)
        if least > 0.0 or greatest < 0.0:
            if _changes_sign(left[1], right[1]):
                found.append(interval)
        elif _may_vanish(left, right, least, greatest):
            if right[0] - left[0] < FLAT_WIDTH or len(pending) > MOST_INTERVALS:
                unresolved.append(interval)
            else:
                middle = function.probe(0.5 * (left[0] + right[0]))
                pending += (left, middle), (middle, right)
    if unresolved:
        for cluster in _clusters(unresolved):
            found += _brackets_in(cluster)
    if len(found) > 1:
        found.sort(key=_place)
    return found


def refine(function: BoundedFunction, bracket: Bracket) -> tuple[Probe, int]:
    """Narrow a bracket to `ANGLE_TOLERANCE`; return the root and the steps taken.

    Steps go to where the cubic through both ends, with their slopes, is zero, or are Newton's if
    they are short; where that does not help the bracket is halved. The last step is aimed a little
    beyond the root, so that the bracket closes from both ends. The root is where the chord over
    the last bracket is zero, which makes it as exact as the function; it mostly is the last place
    but one.
    """
    low, high = bracket
    rising = low[1] < 0.0 if low[1] else high[1] > 0.0
    steps = 0
    ahead = cubic_zero(low, high)
    while high[0] - low[0] > ANGLE_TOLERANCE:
        if not low[0] < ahead < high[0]:
            ahead = 0.5 * (low[0] + high[0])
        probe = function.probe(ahead)
        value, slope = probe[1], probe[2]
        steps += 1
        if (value < 0.0) is rising:
            low, beyond = probe, OVERSHOOT
        else:
            high, beyond = probe, -OVERSHOOT
        if steps >= MOST_HELPED_STEPS:
            ahead = math.nan
        elif slope and -CLOSE < (step := value / slope) < CLOSE:
            ahead -= step
            if -OVERSHOOT < step < OVERSHOOT:
                ahead += beyond
        elif steps > USUAL_STEPS and steps % 2:
            ahead = math.nan
        else:
            ahead = cubic_zero(low, high)
    root = _chord_zero(low, high)
    if root <= low[0] + SAME:
        return low, steps
    if root >= high[0] - SAME:
        return high, steps
    return function.probe(root), steps


def cubic_zero(low: Any, high: Any) -> Any:
    """Where the place, as a cubic in the value through two probes and their slopes, is at zero.

    NaN, or any place, where the function is not monotonic between them; floats, or arrays.
    """
    place, value, slope = low[0], low[1], low[2]
    other_place, other_value, other_slope = high[0], high[1], high[2]
    rise, width = other_value - value, other_place - place
    share = -value / (rise + LEAST)
    start, end = rise / (slope + LEAST), rise / (other_slope + LEAST)
    bend = start + end - 2.0 * width
    return place + share * (start + share * (width - start - bend + share * bend))


def _chord_zero(low: Probe, high: Probe) -> float:
    """Where the chord between two points is zero."""
    if low[1] == high[1]:
        return high[0]  # type: ignore[no-any-return]
    return high[0] - high[1] * (high[0] - low[0]) / (high[1] - low[1])  # type: ignore[no-any-return]


def _place(bracket: Bracket) -> tuple[float, float]:
    low, high = bracket
    return low[0], high[0]


def _changes_sign(before: float, after: float) -> bool:
    """Whether the function crosses zero after the first end, up to and with the second."""
    return before < 0.0 <= after or before > 0.0 >= after


def _may_vanish(left: Probe, right: Probe, least: float, greatest: float) -> bool:
    """Whether a function with slopes within these bounds, of both signs, can have a zero."""
    return not nearest_zero(left, right, least, greatest) > 0.0


def nearest_zero(left: Probe, right: Probe, least: float, greatest: float) -> float:
    """Return how near to zero a function with slopes within bounds of both signs can come.

    Not above 0 where it can have a zero.
    """
    at_left, at_right, width = left[1], right[1], right[0] - left[0]
    if at_left < 0.0:
        at_left, at_right, least, greatest = -at_left, -at_right, -greatest, -least
    if not (at_left > 0.0 < at_right and least < greatest):
        return 0.0
    # It comes down no further than to where steepest descent and ascent meet.
    lowest: float = at_left * greatest - at_right * least + least * greatest * width
    return lowest / (greatest - least)


def _clusters(intervals: list[Bracket]) -> list[list[Probe]]:
    """Join intervals that lie close together; return the places of each run, ascending."""
    clusters: list[list[Probe]] = []
    for left, right in sorted(intervals, key=_place):
        if clusters and left[0] - clusters[-1][-1][0] <= 10.0 * FLAT_WIDTH:
            clusters[-1] += [left, right]
        else:
            clusters.append([left, right])
    return clusters


def _brackets_in(cluster: list[Probe]) -> list[Bracket]:
    """Brackets where the function is too flat to tell roots apart, and its sign may be rounding.

    Opposite signs at the two ends are one root. With like signs there are two roots if it is of
    the other sign anywhere between, and none if not.
    """
    first, last = cluster[0], cluster[-1]
    if _changes_sign(first[1], last[1]):
        return [(first, last)]
    for probe in cluster[1:-1]:
        if _changes_sign(first[1], probe[1]) and _changes_sign(probe[1], last[1]):
            return [(first, probe), (probe, last)]
    return []
