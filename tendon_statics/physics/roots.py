"""All roots of a function of which bounds of the slope are known; no physics.

An interval over which the slope keeps its sign holds one root or none, which the signs at its ends
tell. One over which the function, with such a slope, cannot come down to zero holds none. Any
other is halved.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

ANGLE_TOLERANCE = 1e-10
"""Width in rad of the bracket at which the search for a root ends; the paper's"""

FLAT_WIDTH = 1e-8
"""Width of an interval in which the rounding of the function hides its slope, if it got this
narrow"""

MOST_CUTS = 2000
"""Intervals that are halved before the rest is taken as too flat to resolve; a few suffice for any
function but one made up to be flat"""

MOST_NEWTON_STEPS = 12
"""Steps after which a bracket is halved only; Newton's method takes five or so"""


class BoundedFunction(Protocol):
    """A function of one variable."""

    def value(self, place: float) -> float:
        """Return the function at a place."""

    def value_and_slope(self, place: float) -> tuple[float, float]:
        """Return the function and its slope."""

    def slope_bounds(self, low: float, high: float) -> tuple[float, float]:
        """Return bounds of the slope over an interval; NaN or infinite where there are none."""


class Bracket(NamedTuple):
    """An interval with one root, over which the function changes sign, and its values there."""

    low: float
    at_low: float
    high: float
    at_high: float


def brackets(function: BoundedFunction, low: float, high: float) -> list[Bracket]:
    """Return ascending, disjoint brackets that hold one root each and all together.

    A root at `low` itself comes as a bracket of no width. Where two roots merge, within about
    1e-7 rad, rounding decides whether they are seen as two or as none.
    """
    at_low, at_high = function.value(low), function.value(high)
    found = [Bracket(low, at_low, low, at_low)] if at_low == 0.0 else []
    pending = [Bracket(low, at_low, high, at_high)]
    unresolved: list[Bracket] = []
    cuts = 0
    # Level by level, so that at the limit what is left is of one width.
    while pending:
        level, pending = pending, []
        for interval in level:
            least, greatest = function.slope_bounds(interval.low, interval.high)
            if least > 0.0 or greatest < 0.0:
                if _changes_sign(interval.at_low, interval.at_high):
                    found.append(interval)
            elif _may_vanish(interval, least, greatest):
                left, at_left, right, at_right = interval
                if right - left < FLAT_WIDTH or cuts >= MOST_CUTS:
                    unresolved.append(interval)
                else:
                    middle = 0.5 * (left + right)
                    at_middle = function.value(middle)
                    pending.append(Bracket(left, at_left, middle, at_middle))
                    pending.append(Bracket(middle, at_middle, right, at_right))
                    cuts += 1
    if unresolved:
        for cluster in _clusters(unresolved):
            found += _brackets_in(cluster)
    found.sort()
    return found


def refine(function: BoundedFunction, bracket: Bracket) -> tuple[float, int]:
    """Narrow a bracket to `ANGLE_TOLERANCE`; return the root and the steps taken.

    Newton steps, and halvings where they lead out of the bracket or take too long. Each is aimed a
    little beyond the root, so that the bracket closes from both ends. The root is where the chord
    over the last bracket is zero, which makes it as exact as the function.
    """
    low, at_low, high, at_high = bracket
    rising = at_low < 0.0 if at_low else at_high > 0.0
    overshoot = 0.45 * ANGLE_TOLERANCE
    steps = 0
    ahead = _chord_zero(low, at_low, high, at_high)
    while high - low > ANGLE_TOLERANCE:
        place = ahead if low < ahead < high else 0.5 * (low + high)
        value, slope = function.value_and_slope(place)
        steps += 1
        if (value < 0.0) is rising:
            low, at_low, beyond = place, value, overshoot
        else:
            high, at_high, beyond = place, value, -overshoot
        helpful = slope != 0.0 and steps < MOST_NEWTON_STEPS
        ahead = place - value / slope + beyond if helpful else low
    root = _chord_zero(low, at_low, high, at_high)
    return min(max(root, low), high), steps


def _chord_zero(low: float, at_low: float, high: float, at_high: float) -> float:
    """Where the chord between two points is zero."""
    if at_low == at_high:
        return high
    return high - at_high * (high - low) / (at_high - at_low)


def _changes_sign(before: float, after: float) -> bool:
    """Whether the function crosses zero after the first end, up to and with the second."""
    return before < 0.0 <= after or before > 0.0 >= after


def _may_vanish(interval: Bracket, least: float, greatest: float) -> bool:
    """Whether a function with slopes within these bounds, of both signs, can have a zero."""
    left, at_left, right, at_right = interval
    if not (at_left > 0.0 < at_right or at_left < 0.0 > at_right):
        return True
    if at_left < 0.0:
        at_left, at_right, least, greatest = -at_left, -at_right, -greatest, -least
    # It comes down no further than to where steepest descent and ascent meet.
    lowest = at_left * greatest - at_right * least + least * greatest * (right - left)
    return not lowest > 0.0


def _clusters(intervals: list[Bracket]) -> list[list[tuple[float, float]]]:
    """Join intervals that lie close together; return the points of each run, ascending."""
    clusters: list[list[tuple[float, float]]] = []
    for left, at_left, right, at_right in sorted(intervals):
        points = [(left, at_left), (right, at_right)]
        if clusters and left - clusters[-1][-1][0] <= 10.0 * FLAT_WIDTH:
            clusters[-1] += points
        else:
            clusters.append(points)
    return clusters


def _brackets_in(cluster: list[tuple[float, float]]) -> list[Bracket]:
    """Brackets where the function is too flat to tell roots apart, and its sign may be rounding.

    Opposite signs at the two ends are one root. With like signs there are two roots if it is of
    the other sign anywhere between, and none if not.
    """
    first, last = cluster[0], cluster[-1]
    if _changes_sign(first[1], last[1]):
        return [Bracket(*first, *last)]
    for point in cluster[1:-1]:
        if _changes_sign(first[1], point[1]) and _changes_sign(point[1], last[1]):
            return [Bracket(*first, *point), Bracket(*point, *last)]
    return []
