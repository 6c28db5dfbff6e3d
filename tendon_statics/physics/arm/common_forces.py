"""The forces that all joints of an arm explain: the intersection of their sets."""

from __future__ import annotations

import math

from ..admissible import Interval

EXACT = 1e-9
"""N, or share of a force above 1 N: how exact an end is"""

End = tuple[float, int | None]
"""A force in N, and the joint that bounds the set there, counted from 1; None for infinity"""


def common_forces(of_joints: list[list[Interval]]) -> list[tuple[End, End]]:
    """Intersect the sets of all joints; where two bound it at the same force, name the first."""
    found: list[tuple[End, End]] = [((-math.inf, None), (math.inf, None))]
    for joint, intervals in enumerate(of_joints, start=1):
        both = [
            (
                low if low[0] >= own_low else (own_low, joint),
                high if high[0] <= own_high else (own_high, joint),
            )
            for low, high in found
            for own_low, own_high in intervals
        ]
        found = [_in_order(*ends) for ends in both if _is_interval(*ends)]
    return found


def _is_interval(low: End, high: End) -> bool:
    """Return whether there is a force between two ends, or one that is both but for rounding."""
    return low[0] <= high[0] + EXACT * max(1.0, abs(high[0]))


def _in_order(low: End, high: End) -> tuple[End, End]:
    """Return two ends of which the lower is not above the other, by rounding alone."""
    if low[0] <= high[0]:
        return low, high
    middle = 0.5 * (low[0] + high[0])
    return (middle, low[1]), (middle, high[1])
