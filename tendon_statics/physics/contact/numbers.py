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
    least: Callable[[Any, Any], Any]
    greatest: Callable[[Any, Any], Any]
    any: Callable[[Any], bool]
    """Whether a condition holds anywhere"""


def _choose(condition: bool, one: float, other: float) -> float:
    return one if condition else other


def _least(one: float, other: float) -> float:
    return one if one < other else other


def _greatest(one: float, other: float) -> float:
    return one if one > other else other


# `_least` and `_greatest` take half the time of `min` and `max`.
FLOATS = Numbers(math.sqrt, math.cos, math.sin, _choose, _least, _greatest, bool)


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
    low, high = numbers.least(one, other), numbers.greatest(one, other)
    turns = one_slope * other_slope < 0.0
    if numbers.any(turns):  # once at the most, on the side where the two ends are on the whole
        mean = one + other
        low = numbers.choose(turns & (mean < 0.0), -amplitude, low)
        high = numbers.choose(turns & (mean >= 0.0), amplitude, high)
    return low, high


def product_bounds(low: Any, high: Any, other_low: Any, other_high: Any) -> tuple[Any, Any]:
    """Return bounds of the product of two quantities, from bounds of each."""
    centre, radius = 0.5 * (low + high), 0.5 * (high - low)
    other_centre, other_radius = 0.5 * (other_low + other_high), 0.5 * (other_high - other_low)
    middle = centre * other_centre
    reach = abs(centre) * other_radius + radius * (abs(other_centre) + other_radius)
    return middle - reach, middle + reach
