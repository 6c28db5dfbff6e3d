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
    numbers: Numbers, one: Any, one_slope: Any, other: Any, other_slope: Any, amplitude: Any
) -> tuple[Any, Any]:
    """Return bounds of A cos + B sin between two angles, at most half a turn apart.

    Parameters
    ----------
    one, one_slope, other, other_slope
        The wave and its slope, or what has the sign of the slope, at the two angles.
    amplitude
        √(A² + B²), or more.
    """
    low, high = numbers.ordered(one, other)
    turns = one_slope * other_slope < 0.0
    if numbers.any(turns):  # once at the most, on the side where the two ends are on the whole
        mean = one + other
        low = numbers.choose(turns & (mean < 0.0), -amplitude, low)
        high = numbers.choose(turns & (mean >= 0.0), amplitude, high)
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
