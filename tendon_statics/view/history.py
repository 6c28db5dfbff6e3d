"""The last minute of a unit or an arm, as columns that a page draws."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from itertools import islice

import numpy as np
from numpy.typing import NDArray

SPAN = 60.0
"""Seconds that are kept and drawn"""

LONGEST_BAND = 1.0
"""Seconds; a sample stands for the time since the one before it, but for no longer than that"""

TIMES = ('before', 'time')
"""Names of the columns that every history has; in ms, as a browser has them"""


class History:
    """The samples of the last minute, and which of them a page has not drawn yet.

    Parameters
    ----------
    rate : float
        Samples per second, at the most.
    names : sequence of str
        What a sample has; `columns` are these, after `TIMES`.
    """

    def __init__(self, rate: float, names: Sequence[str]) -> None:
        self.columns = (*TIMES, *names)
        self.length = math.ceil(SPAN * rate)
        self.count = 0
        """How many samples came so far, also those that are forgotten"""
        self._names = tuple(names)
        self._rows: deque[tuple[float, ...]] = deque(maxlen=self.length)
        self._newest = -math.inf

    def add(self, time: float, sample: Mapping[str, float]) -> None:
        """Add a sample that came at a time in s; what it does not have is not determined."""
        before = max(self._newest, time - LONGEST_BAND)
        values = (sample.get(name, math.nan) for name in self._names)
        self._rows.append((1e3 * before, 1e3 * time, *values))
        self._newest = time
        self.count += 1

    def since(self, count: int) -> dict[str, NDArray[np.float64]]:
        """Return the samples after the first `count`, as far as they are kept, as columns."""
        new = min(self.count - count, len(self._rows))
        rows = list(islice(self._rows, len(self._rows) - new, None))
        columns = np.array(rows, dtype=np.float64).reshape(new, len(self.columns)).T
        return {
            name: np.ascontiguousarray(column)
            for name, column in zip(self.columns, columns, strict=True)
        }
