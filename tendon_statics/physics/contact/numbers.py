"""The few functions that floats and arrays do not share, so that a formula stands once for both.

Those of arrays are in `array_numbers`, since NumPy is loaded only for a batch.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple


class Numbers(NamedTuple):
    """Functions of floats, or of arrays element by element."""

    square_root: Callable[[Any], Any]
    """√, the same to the last bit for both, which may decide a regime"""
    cosine: Callable[[Any], Any]
    sine: Callable[[Any], Any]
    choose: Callable[[Any, Any, Any], Any]
    """Of two values the first where a condition holds, the second elsewhere"""
    ordered: Callable[[Any, Any], tuple[Any, Any]]
    """Two values, the smaller first; of one that is NaN the second stays the first"""
    swapped: Callable[[Any, Any, Any], tuple[Any, Any]]
    """Two values, exchanged where a condition holds"""
    any: Callable[[Any], bool]
    """Whether a condition holds anywhere"""


def _choose(condition: bool, one: float, other: float) -> float:
    return one if condition else other


# Two values at once, since a call takes as long as the work.
def _ordered(one: float, other: float) -> tuple[float, float]:
    return (one, other) if one < other else (other, one)


def _swapped(condition: bool, one: float, other: float) -> tuple[float, float]:
    return (other, one) if condition else (one, other)


FLOATS = Numbers(math.sqrt, math.cos, math.sin, _choose, _ordered, _swapped, bool)


def wave_bounds(
    numbers: Numbers,
    one: Any,
    one_slope: Any,
    other: Any,
    other_slope: Any,
    lowest: Any,
    highest: Any,
) -> tuple[Any, Any]:
    """Return bounds between two angles of A cos + B sin, or of what rises and falls with it.

    Parameters
    ----------
    one, one_slope, other, other_slope
        It and its slope, or what has the sign of the slope, at the two angles: ascending, and at
        most half a turn apart, so that it turns once at the most.
    lowest, highest
        Its least and greatest value, or beyond: ∓√(A² + B²) for A cos + B sin.
    """
    low, high = numbers.ordered(one, other)
    turns = one_slope * other_slope < 0.0
    if numbers.any(turns):
        low = numbers.choose(turns & (one_slope < 0.0), lowest, low)
        high = numbers.choose(turns & (one_slope > 0.0), highest, high)
    return low, high


def scaled_bounds(numbers: Numbers, low: Any, high: Any, least: Any, most: Any) -> tuple[Any, Any]:
    """Return bounds of a quantity between `low` and `high` times a factor that is not negative.

    Parameters
    ----------
    least, most
        Bounds of the factor.
    """
    choose = numbers.choose
    return low * choose(low < 0.0, most, least), high * choose(high < 0.0, least, most)
