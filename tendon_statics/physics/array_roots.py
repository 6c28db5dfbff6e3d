"""`roots` for many functions at once, as NumPy arrays; no physics.

With the same bounds: intervals are halved until each is shown to hold one root or none. Those that
take more than a few cuts or steps are marked as unresolved; they are few, and left to `roots`.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .roots import ANGLE_TOLERANCE

CUTS = 12
"""How often an interval is halved at the most"""

STEPS = 20
"""Steps towards a root at the most; Newton's method takes five or so"""

STILL = 1e-12
"""Step in rad after which the next is not worth taking"""

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]


class ArrayFunction(Protocol):
    """Functions of one variable, one a row."""

    def values(self, rows: Indices | slice, places: Floats | float) -> Floats:
        """Return the functions of some rows, each at a place of its own, or all at one."""

    def values_and_slopes(self, rows: Indices | slice, places: Floats) -> tuple[Floats, Floats]:
        """Return the functions and their slopes."""

    def slope_bounds(
        self, rows: Indices | slice, middles: Floats, half_width: float
    ) -> tuple[Floats, Floats]:
        """Return bounds of the slopes over intervals of one width."""


class Brackets(NamedTuple):
    """What is known of the roots of each row."""

    root_count: NDArray[np.int64]
    low: Floats
    """Lower end of the bracket of the lowest root; infinite where there is none"""
    high: Floats
    at_low: Floats
    """The function at the lower end of the interval that was searched"""
    unresolved: Flags


def array_brackets(function: ArrayFunction, count: int, low: float, high: float) -> Brackets:
    """Bracket the lowest root of each of so many rows between two places, and count all."""
    rows: Any = slice(None)
    roots, lows, highs = np.zeros(count, np.int64), np.full(count, np.inf), np.full(count, np.inf)
    at_left, at_right = function.values(rows, low), function.values(rows, high)
    left, right = np.full(count, low), np.full(count, high)
    at_low = at_left
    unresolved = at_low == 0.0
    half_width = 0.5 * (high - low)
    for _ in range(CUTS):
        middle = 0.5 * (left + right)
        least, greatest = function.slope_bounds(rows, middle, half_width)
        settled = (least > 0.0) | (greatest < 0.0)
        crossing = settled & _change_sign(at_left, at_right)
        rows = np.arange(count)[rows]
        at = rows[crossing]
        np.add.at(roots, at, 1)
        np.minimum.at(lows, at, left[crossing])
        nearest = lows[at] == left[crossing]
        highs[at[nearest]] = right[crossing][nearest]
        still = ~settled & _may_vanish(at_left, at_right, least, greatest, 2.0 * half_width)
        rows, left, right, middle = rows[still], left[still], right[still], middle[still]
        at_left, at_right = at_left[still], at_right[still]
        if not len(rows):
            break
        at_middle = function.values(rows, middle)
        rows = np.concatenate([rows, rows])
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
        at_left = np.concatenate([at_left, at_middle])
        at_right = np.concatenate([at_middle, at_right])
        half_width *= 0.5
    unresolved[rows] = True
    return Brackets(roots, lows, highs, at_low, unresolved)


class Roots(NamedTuple):
    """One root of each row."""

    places: Floats
    steps: NDArray[np.int64]
    unresolved: Flags


def array_refine(function: ArrayFunction, rows: Indices, low: Floats, high: Floats) -> Roots:
    """Find the root in the bracket of each row, and prove it as `roots.refine` does.

    Newton's method, kept within a shrinking bracket, comes close. Then the function must change
    sign over a bracket as narrow as that one's last, and the root is where its chord is zero.
    """
    near, steps = _newton(function, rows, low, high)
    low = np.maximum(near - 0.5 * ANGLE_TOLERANCE, low)
    high = np.minimum(near + 0.5 * ANGLE_TOLERANCE, high)
    at_low, at_high = function.values(rows, low), function.values(rows, high)
    proven = (at_low * at_high <= 0.0) & (at_low != at_high)
    root = high - at_high * (high - low) / (at_high - at_low)
    return Roots(np.clip(root, low, high), steps, ~proven)


def _newton(
    function: ArrayFunction, rows: Indices, low: Floats, high: Floats
) -> tuple[Floats, NDArray[np.int64]]:
    """Return a place near the root in each bracket, and the steps taken."""
    at_low, at_high = function.values(rows, low), function.values(rows, high)
    rising = at_low < at_high
    place = high - at_high * (high - low) / (at_high - at_low)
    steps = np.zeros(len(place), np.int64)
    for _ in range(STEPS):
        value, slope = function.values_and_slopes(rows, place)
        below = (value < 0.0) == rising
        low, high = np.where(below, place, low), np.where(below, high, place)
        ahead = place - value / slope
        inside = (ahead >= low) & (ahead <= high)
        ahead = np.where(inside, ahead, 0.5 * (low + high))
        moving = np.abs(ahead - place) > STILL
        place = ahead
        steps += 1
        if not moving.any():
            break
    return place, steps


def _change_sign(before: Floats, after: Floats) -> Flags:
    """Whether each function crosses zero after the first end, up to and with the second."""
    flags: Flags = ((before < 0.0) & (after >= 0.0)) | ((before > 0.0) & (after <= 0.0))
    return flags


def _may_vanish(
    at_left: Floats, at_right: Floats, least: Any, greatest: Any, width: float
) -> Flags:
    """Whether functions with slopes within these bounds, of both signs, can have a zero."""
    sign = np.sign(at_left)
    least, greatest = (
        np.where(sign > 0.0, least, -greatest),
        np.where(sign > 0.0, greatest, -least),
    )
    lowest = sign * at_left * greatest - sign * at_right * least + least * greatest * width
    flags: Flags = (at_left * at_right <= 0.0) | ~(lowest > 0.0)
    return flags
