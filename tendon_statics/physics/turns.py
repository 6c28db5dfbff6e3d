"""Where a function turns, of which the slope is known; no physics."""

from __future__ import annotations

import itertools
import math
from typing import Any

from .roots import BoundedFunction, Probe

PARTS = 4
"""Of a range, in each of which a function turns once at the most"""

MOST_STEPS = 8
"""To where it turns; one or two are enough, but for one with a kink"""


def turning_points(
    function: BoundedFunction, low: Probe, high: Probe, tolerance: float
) -> list[Probe]:
    """Return the function where it turns between two probes, ascending.

    Parameters
    ----------
    tolerance : float
        By how much its value there may be missed.
    """
    step = (high[0] - low[0]) / PARTS
    places = [low[0] + step * part for part in range(1, PARTS)]
    probes = [low, *map(function.probe, places), high]
    return [
        _turn(function, one, other, tolerance)
        for one, other in itertools.pairwise(probes)
        if one[2] * other[2] < 0.0
    ]


def _turn(function: BoundedFunction, low: Probe, high: Probe, tolerance: float) -> Probe:
    """Return the function where it turns between two probes with slopes of opposite signs."""
    rises = low[2] > 0.0
    for _ in range(MOST_STEPS):
        place, expected = _cubic_turn(low, high)
        probe = function.probe(place)
        if abs(probe[1] - expected) <= tolerance:
            break
        if (probe[2] > 0.0) == rises:
            low = probe
        else:
            high = probe
    return probe


def _cubic_turn(low: Any, high: Any) -> tuple[float, float]:
    """Return where the cubic through two probes, with their slopes, turns, and its value there."""
    place, value, slope = low[0], low[1], low[2]
    other_place, other_value, other_slope = high[0], high[1], high[2]
    width = other_place - place
    mean = slope + other_slope - 3.0 * (other_value - value) / width
    root = math.copysign(math.sqrt(mean * mean - slope * other_slope), -slope)
    ahead = 1.0 - (other_slope + root - mean) / (other_slope - slope + 2.0 * root)
    back = 1.0 - ahead
    expected = back * back * ((1.0 + 2.0 * ahead) * value + ahead * width * slope)
    expected += ahead * ahead * ((1.0 + 2.0 * back) * other_value - back * width * other_slope)
    return place + ahead * width, expected
