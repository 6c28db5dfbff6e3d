"""Where a function turns, of which the slope is known; no physics."""

from __future__ import annotations

import math
from typing import Any

from .roots import BoundedFunction, Probe

PARTS = 3
"""Of a range, in each of which a function turns once at the most"""

MOST_STEPS = 8
"""To where it turns; one or two are enough, at a kink two or three"""


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
    found = []
    one = low
    for part in range(1, PARTS + 1):
        other = function.probe(low[0] + part * step) if part < PARTS else high
        if one[2] * other[2] < 0.0:
            found.append(_turn(function, one, other, tolerance))
        one = other
    return found


def _turn(function: BoundedFunction, low: Probe, high: Probe, tolerance: float) -> Probe:
    """Return the function where it turns between two probes with slopes of opposite signs.

    Between those that are left, its value is taken not to go beyond where their tangents meet.
    """
    rises = low[2] > 0.0
    place = _cubic_turn(low, high)
    for _ in range(MOST_STEPS):
        probe = function.probe(place)
        if (probe[2] > 0.0) == rises:
            low = probe
        else:
            high = probe
        # At a kink that is where it turns, but for how it bends.
        ahead, beyond = _tangents_meet(low, high)
        if abs(beyond - probe[1]) <= tolerance:
            break
        place = ahead if low[0] < ahead < high[0] else 0.5 * (low[0] + high[0])
    return probe


def _cubic_turn(low: Any, high: Any) -> float:
    """Where the cubic through two probes, with their slopes, turns."""
    slope, other_slope, width = low[2], high[2], high[0] - low[0]
    mean = slope + other_slope - 3.0 * (high[1] - low[1]) / width
    root = math.copysign(math.sqrt(mean * mean - slope * other_slope), -slope)
    ahead: float = 1.0 - (other_slope + root - mean) / (other_slope - slope + 2.0 * root)
    place: float = low[0] + ahead * width
    return place


def _tangents_meet(low: Any, high: Any) -> tuple[float, float]:
    """Where the tangents at two probes with slopes of opposite signs meet, and at what value."""
    width, slope = high[0] - low[0], low[2]
    ahead = (high[1] - low[1] - high[2] * width) / (slope - high[2])
    return low[0] + ahead, low[1] + ahead * slope
