"""The last minute of a unit, as columns that a page draws."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from itertools import islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

SPAN = 60.0
"""Seconds that are kept and drawn"""

LONGEST_BAND = 1.0
"""Seconds; a sample stands for the time since the one before it, but for no longer than that"""


class Sample(NamedTuple):
    """What is drawn of one estimate; NaN where it is not determined. Angles in degrees."""

    angle: float = math.nan
    angle_low: float = math.nan
    angle_high: float = math.nan
    admissible: Sequence[tuple[float, float]] = ()
    """Intervals in which friction can hold the unit"""
    pressure: float = math.nan
    """In Pa"""
    pressure_low: float = math.nan
    pressure_high: float = math.nan
    slip_margin: float = math.nan
    tension_l: float = math.nan
    """In N"""
    tension_s: float = math.nan


BANDS = 2
"""How many intervals of admissible angles are drawn over time; the newest has them all"""

COLUMNS = (
    'before',
    'time',
    *(name for name in Sample._fields if name != 'admissible'),
    *(f'admissible_{end}_{band}' for band in range(BANDS) for end in ('low', 'high')),
)
"""Names of the columns; times are in ms, as a browser has them"""


class History:
    """The samples of the last minute, and which of them a page has not drawn yet.

    Parameters
    ----------
    rate : float
        Samples per second, at the most.
    """

    def __init__(self, rate: float) -> None:
        self.length = math.ceil(SPAN * rate)
        self.count = 0
        """How many samples came so far, also those that are forgotten"""
        self._rows: deque[tuple[float, ...]] = deque(maxlen=self.length)
        self._newest = -math.inf

    def add(self, time: float, sample: Sample) -> None:
        """Add a sample that came at a time in s."""
        before = max(self._newest, time - LONGEST_BAND)
        ends = [end for interval in sample.admissible[:BANDS] for end in interval]
        ends += [math.nan] * (2 * BANDS - len(ends))
        numbers = (
            value
            for name, value in zip(sample._fields, sample, strict=True)
            if name != 'admissible'
        )
        self._rows.append((1e3 * before, 1e3 * time, *numbers, *ends))  # type: ignore[arg-type]
        self._newest = time
        self.count += 1

    def since(self, count: int) -> dict[str, NDArray[np.float64]]:
        """Return the samples after the first `count`, as far as they are kept, as columns."""
        new = min(self.count - count, len(self._rows))
        rows = list(islice(self._rows, len(self._rows) - new, None))
        columns = np.array(rows, dtype=np.float64).reshape(new, len(COLUMNS)).T
        return {
            name: np.ascontiguousarray(column)
            for name, column in zip(COLUMNS, columns, strict=True)
        }
