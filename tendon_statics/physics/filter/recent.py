"""The newest samples of tensions, and what they were without noise."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..load import Load
from .local_fits import REACH
from .smoothing import Estimate, Windows

PATH = (0.7, 0.45, 0.28, 0.16, 0.08, 0.03, 0.0)
"""Places of the provisional path, as shares of the time that is not settled"""

KEPT_WINDOWS = 256
"""Sets of windows that are kept for all filters, which begin alike and come to a few; each takes
some 50 kB for two signals, 180 kB for twenty"""


@dataclass(slots=True)
class Sample:
    """When and under what load the tensions were that are not settled."""

    time: float
    load: Load
    reading: tuple[float, float] | None = None
    """Angle and its deviation in rad, where it was measured"""


class RecentSamples:
    """Samples that are not settled, and as many before them as windows reach.

    Parameters
    ----------
    signals : int
        How many tensions a sample has.
    stddev : float
        Standard deviation of the noise of a tension in N.
    """

    def __init__(self, signals: int, stddev: float) -> None:
        self._signals, self._stddev = signals, stddev
        self.forget()

    def forget(self) -> None:
        """Forget all samples."""
        self.waiting: deque[Sample] = deque()
        self.time: float | None = None
        """Of the newest sample in s"""
        self._buffer = SampleBuffer(self._signals)

    def append(self, tensions: Sequence[float], sample: Sample) -> None:
        """Append a sample that is newer than all."""
        self.waiting.append(sample)
        self.time = sample.time
        self._buffer.append(tensions, REACH + len(self.waiting))

    def settled(self, until: float) -> int:
        """Return how many of those waiting are not after a time in s."""
        count = 0
        for sample in self.waiting:
            if sample.time > until:
                break
            count += 1
        return count

    def path(self, settled: int, measured: int) -> tuple[int, ...]:
        """Return the places to look at: all that are settled, and some of the newer ones.

        Parameters
        ----------
        settled, measured : int
            So many of the oldest are settled, or lie up to the last measured angle.

        Returns
        -------
        tuple of int
            Ages, as how many samples came after each.
        """
        return _path(len(self.waiting) - 1, settled, max(settled, measured))

    def smoothed(self, ages: tuple[int, ...]) -> Estimate:
        """Estimate the tensions at samples of these ages, the oldest first."""
        count = min(len(self._buffer), REACH + ages[0])
        windows = _windows(count, ages, self._signals)
        return windows.estimate(self._buffer.newest(count), self._stddev)


@lru_cache(KEPT_WINDOWS)
def _path(newest: int, settled: int, known: int) -> tuple[int, ...]:
    all_settled = range(newest, newest - settled, -1)
    if settled > newest:  # up to now, without a lag
        return tuple(all_settled)
    newer = max(newest - known, 0)
    return (*all_settled, *sorted({round(share * newer) for share in PATH}, reverse=True))


@lru_cache(KEPT_WINDOWS)
def _windows(count: int, ages: tuple[int, ...], signals: int) -> Windows:
    return Windows(count, np.array(ages), signals)


class SampleBuffer:
    """The newest samples of some signals, in a row.

    Parameters
    ----------
    signals : int
        How many signals there are.
    """

    def __init__(self, signals: int) -> None:
        self._values: NDArray[np.float64] = np.zeros((signals, 4 * REACH))
        self._end = 0

    def __len__(self) -> int:
        return self._end

    def append(self, sample: Sequence[float], kept: int) -> None:
        """Append a sample of each signal; of those before it at least so many are kept."""
        if self._end == self._values.shape[1]:
            kept = min(kept, self._end)
            if 2 * kept > self._end:
                self._values = np.pad(self._values, ((0, 0), (0, self._end)))
            self._values[:, :kept] = self._values[:, self._end - kept : self._end]
            self._end = kept
        self._values[:, self._end] = sample
        self._end += 1

    def newest(self, count: int) -> NDArray[np.float64]:
        """Return the newest samples, shape ``(signals, count)``."""
        return self._values[:, self._end - count : self._end]
