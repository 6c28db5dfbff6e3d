"""Where the set of forces ends that noise leaves possible: a search, beside the exact ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Protocol

from .admissible import Interval
from .force_scores import NORMAL, Doubt
from .pushed_unit import BOTH_SIDES

STEP = 1e-6
"""Of differences by a force, as a share of it and of the tensions"""

FAR = 1e6
"""Times the scale of the forces that counts as infinite"""

PLACES = (0.3, 1.0, 4.0, 20.0, 200.0)
"""Of the scale of the forces, to either side, at which the ends under noise are looked for"""

TOLERANCE = 1e-7
"""Share of a force to which an end under noise is found"""


class Doubtful(Protocol):
    """How much speaks against a force; as `Doubt` says it."""

    def beyond(self, force: float, level: float) -> float:
        """Return by how much the doubt, as a score, is beyond that of a level."""


def forces_within(
    doubt: Doubtful, cuts: Sequence[tuple[float, Doubt]], scale: float, level: float
) -> list[Interval]:
    """Return the forces with a doubt up to a level.

    Parameters
    ----------
    cuts : sequence of (float, Doubt)
        Ends of the exact set in N, near which the others are, each with the doubt that grows
        there.
    scale : float
        Of the forces, in N.
    """

    def beyond(force: float) -> float:
        return doubt.beyond(force, level)

    deviations = NORMAL.inv_cdf(0.5 * (1.0 + level))
    places = {0.0}
    for cut, of_cut in cuts:
        places.add(cut)
        step = STEP * (scale + abs(cut))
        rate = abs(of_cut.bounds(cut + step)[0] - of_cut.bounds(cut)[0]) / step
        if 0.0 < rate < math.inf:
            reach = deviations / rate
            places |= {cut + share * reach for share in (-1.5, 1.5)}
    low, high = min(places), max(places)
    middle, spread = 0.5 * (low + high), scale + 0.5 * (high - low)
    places |= {middle + side * share * spread for side in BOTH_SIDES for share in PLACES}
    places |= {middle - FAR * spread, middle + FAR * spread}
    points = [(place, beyond(place)) for place in sorted(places)]
    found: list[Interval] = []
    start = -math.inf if points[0][1] <= 0.0 else math.nan
    for (low, at_low), (high, at_high) in pairwise(points):
        if at_low <= 0.0 < at_high:
            found.append((start, _crossing(beyond, (low, at_low), (high, at_high))))
        elif at_high <= 0.0 < at_low:
            start = _crossing(beyond, (low, at_low), (high, at_high))
    if points[-1][1] <= 0.0:
        found.append((start, math.inf))
    return found


def _crossing(
    function: Callable[[float], float], low: tuple[float, float], high: tuple[float, float]
) -> float:
    """Find where a function changes sign between two places, by the Illinois rule, or halving."""
    for step in range(200):
        (left, at_left), (right, at_right) = low, high
        if right - left <= TOLERANCE * max(abs(left), abs(right), 1e-3):
            break
        place = right - at_right * (right - left) / (at_right - at_left)
        if step % 4 == 3 or not left < place < right:
            place = 0.5 * (left + right)
        value = function(place)
        if value == 0.0:
            return place
        if (value > 0.0) == (at_right > 0.0):
            low, high = (left, 0.5 * at_left), (place, value)
        else:
            low, high = (place, value), (right, 0.5 * at_right)
    return 0.5 * (low[0] + high[0])
