"""Whether a load cell sits at an end of its range."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

DITHER = 2.0
"""Steps of the converter by which readings at an end of the range differ: one up, one down"""

FINE = 0.01
"""Share of the range seen below which the smallest step may be that of a converter"""


@dataclasses.dataclass
class SaturationCheck:
    """Counts readings in a row that stay at the largest or smallest so far, but for dither.

    The step of the converter is the smallest one seen, where it is small beside the range: of
    readings without noise all have to be the same.
    """

    smallest: float = math.inf
    """N; of all"""
    largest: float = -math.inf
    """N; likewise"""
    step: float = math.inf
    """N; the smallest between two readings that differ"""
    before: float = math.nan
    """N"""
    run: tuple[float, float] = (math.inf, -math.inf)
    """Smallest and largest of those in a row that stay where they are, in N"""
    count: int = 0
    """How many they are"""

    def take(self, tension: float) -> str:
        """Take a reading in N; return at which end those in a row are, empty if at none."""
        if tension != self.before and not math.isnan(self.before):
            self.step = min(self.step, abs(tension - self.before))
        self.before = tension
        self.smallest = min(self.smallest, tension)
        self.largest = max(self.largest, tension)
        low, high = min(self.run[0], tension), max(self.run[1], tension)
        if high - low <= self._dither:
            self.run, self.count = (low, high), self.count + 1
        else:
            self.run, self.count = (tension, tension), 1
        if self.run[1] == self.largest:
            return 'largest'
        return 'smallest' if self.run[0] == self.smallest else ''

    @property
    def _dither(self) -> float:
        dither = DITHER * self.step
        # A quarter more, for readings were scaled and rounded.
        return 1.25 * dither if dither <= FINE * (self.largest - self.smallest) else 0.0

    def rescale(self, scale: Callable[[float], float]) -> None:
        """Go on with readings in other newtons."""
        ends = scale(self.smallest), scale(self.largest)
        self.smallest, self.largest = min(ends), max(ends)
        self.step = abs(scale(self.step) - scale(0.0))
        self.before = scale(self.before)
        ends = scale(self.run[0]), scale(self.run[1])
        self.run = min(ends), max(ends)
