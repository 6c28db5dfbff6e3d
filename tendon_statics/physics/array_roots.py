"""`roots` for many functions at once, as NumPy arrays; no physics.

With the same bounds: intervals are halved until each is shown to hold one root or none. Those that
take more than a few cuts or steps are marked as unresolved; they are few, and left to `roots`.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .roots import ANGLE_TOLERANCE, cubic_zero

CUTS = 12
"""How often an interval is halved at the most"""

STEPS = 20
"""Steps towards a root at the most; three or four are enough as a rule"""

STILL = 1e-6
"""Step in rad after which the next is not worth taking: each is some square of the one before"""

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]


Lines = list[Floats]
"""A probe of many rows: an array for each thing that is known of them, the first three being
place, value and slope, as in `roots`"""


class ArrayFunction(Protocol):
    """Functions of one variable, one a row."""

    def probe(self, rows: Indices | slice, places: Floats | float) -> Lines:
        """Look at the functions of some rows, each at a place of its own, or all at one."""

    def slope_bounds(
        self, rows: Indices | slice, one: Lines, other: Lines
    ) -> tuple[Floats, Floats]:
        """Return bounds of the slopes between two probes, ascending."""


class Brackets(NamedTuple):
    """What is known of the roots of each row."""

    root_count: NDArray[np.int64]
    low: Floats
    """Place, value and slope at the lower end of the bracket of the lowest root, shape (3, rows);
    infinite where there is none"""
    high: Floats
    at_low: Floats
    """The function at the lower end of the interval that was searched"""
    unresolved: Flags


def array_brackets(function: ArrayFunction, sought: Flags, low: float, high: float) -> Brackets:
    """Bracket the lowest root between two places of each row where one is sought; count all."""
    rows: Any = slice(None)
    count = len(sought)
    roots = np.zeros(count, np.int64)
    lows, highs = np.full((2, 3, count), np.inf)
    left, right = function.probe(rows, low), function.probe(rows, high)
    at_low = left[1]
    unresolved = sought & (at_low == 0.0)
    for cut in range(CUTS + 1):
        least, greatest = function.slope_bounds(rows, left, right)
        settled = (least > 0.0) | (greatest < 0.0)
        (crossing,) = np.nonzero(sought & settled & _change_sign(left[1], right[1]))
        (still,) = np.nonzero(sought & ~settled & _may_vanish(left, right, least, greatest))
        at = crossing if cut == 0 else rows[crossing]
        np.add.at(roots, at, 1)
        np.minimum.at(lows[0], at, left[0][crossing])
        nearest = lows[0, at] == left[0][crossing]
        at, crossing = at[nearest], crossing[nearest]
        for ends, end in ((lows, left), (highs, right)):
            for line, values in zip(ends, end, strict=False):
                line[at] = values[crossing]
        rows = still if cut == 0 else rows[still]
        if not len(rows) or cut == CUTS:
            break
        left, right = [line[still] for line in left], [line[still] for line in right]
        middle = function.probe(rows, 0.5 * (left[0] + right[0]))
        rows = np.concatenate([rows, rows])
        sought = np.ones(len(rows), np.bool_)
        left, right = (
            [np.concatenate(lines) for lines in zip(left, middle, strict=True)],
            [np.concatenate(lines) for lines in zip(middle, right, strict=True)],
        )
    unresolved[rows] = True
    return Brackets(roots, lows, highs, at_low, unresolved)


class Roots(NamedTuple):
    """One root of each row."""

    places: Floats
    steps: NDArray[np.int64]
    unresolved: Flags


def array_refine(function: ArrayFunction, low: Lines, high: Lines) -> Roots:
    """Find the root in the bracket of each row, and prove it as `roots.refine` does.

    The same steps come close. Then the function must change sign over a bracket as narrow as that
    one's last, and the root is where its chord is zero.
    """
    rows = slice(None)
    near, steps = _approach(function, low, high)
    before = np.maximum(near - 0.5 * ANGLE_TOLERANCE, low[0])
    after = np.minimum(near + 0.5 * ANGLE_TOLERANCE, high[0])
    at_before, at_after = function.probe(rows, before)[1], function.probe(rows, after)[1]
    proven = (at_before * at_after <= 0.0) & (at_before != at_after)
    root = after - at_after * (after - before) / (at_after - at_before)
    return Roots(np.clip(root, before, after), steps, ~proven)


def _approach(
    function: ArrayFunction, low: Lines, high: Lines
) -> tuple[Floats, NDArray[np.int64]]:
    """Return a place near the root in each bracket, and the steps taken."""
    rows: Any = slice(None)
    ahead = cubic_zero(low, high)
    near, steps = ahead.copy(), np.zeros(len(ahead), np.int64)
    for _ in range(STEPS):
        inside = (ahead >= low[0]) & (ahead <= high[0])
        place = np.where(inside, ahead, 0.5 * (low[0] + high[0]))
        probe = function.probe(rows, place)
        below = (probe[1] < 0.0) == (low[1] < high[1])
        low = [np.where(below, new, old) for new, old in zip(probe[:3], low, strict=True)]
        high = [np.where(below, old, new) for new, old in zip(probe[:3], high, strict=True)]
        ahead = cubic_zero(low, high)
        near[rows] = ahead
        steps[rows] += 1
        (moving,) = np.nonzero(~(np.abs(ahead - place) <= STILL))
        if not len(moving):
            break
        rows = moving if isinstance(rows, slice) else rows[moving]
        low, high = [line[moving] for line in low], [line[moving] for line in high]
        ahead = ahead[moving]
    return near, steps


def _change_sign(before: Floats, after: Floats) -> Flags:
    """Whether each function crosses zero after the first end, up to and with the second."""
    flags: Flags = ((before < 0.0) & (after >= 0.0)) | ((before > 0.0) & (after <= 0.0))
    return flags


def _may_vanish(left: Lines, right: Lines, least: Any, greatest: Any) -> Flags:
    """Whether functions with slopes within these bounds, of both signs, can have a zero."""
    at_left, at_right, width = left[1], right[1], right[0] - left[0]
    sign = np.sign(at_left)
    least, greatest = (
        np.where(sign > 0.0, least, -greatest),
        np.where(sign > 0.0, greatest, -least),
    )
    lowest = sign * at_left * greatest - sign * at_right * least + least * greatest * width
    flags: Flags = (at_left * at_right <= 0.0) | ~(lowest > 0.0)
    return flags
