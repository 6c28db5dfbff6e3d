"""The value of a signal behind noisy samples, from windows as wide as the signal lets them be.

At a place in the signal there are windows of five kinds: around it, before it and after it, with
the mean of the samples for a signal at rest, and before and after with a straight line for one
that moves. Wider ones have the smaller standard error, and are wrong where the signal bends within
them. So of each kind the widest is taken with which the confidence intervals of all narrower ones
still have a point in common (the rule of intersecting confidence intervals: Goldenshluger and
Nemirovski, 1997; Katkovnik, 1999, with windows to one side). Of the five the one with the smallest
standard error is the estimate. Next to a corner that is a window that ends there: the mean of a
rest right after a step is as good as in its midst.

Samples are counted, not timed: they are taken to follow each other at a steady rate.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SIZES = np.array([1, 2, 3, 5, 9, 17, 33, 65, 129])
"""Samples of a window"""

REACH = int(SIZES[-1])
"""Samples before a place that its windows reach"""

CONFIDENCES = np.array([4.0, 4.0, 3.5, 3.0, 2.5, 2.25, 2.0, 2.0, 2.0])
"""Half-widths of the confidence intervals of windows of `SIZES`, in standard errors. There are the
more narrow windows in a second, so that chance has the more to offer: a rest is not to be torn
apart by the one sample in thousands that lies far out"""

_AROUND, _BEFORE, _AFTER, _LINE_BEFORE, _LINE_AFTER = range(5)


class Estimate(NamedTuple):
    """What the samples tell of a signal at some places; arrays of the shape of the places."""

    value: Floats
    error: Floats
    """Standard error in units of the standard deviation of a sample"""


class Windows:
    """The windows at some places in a series of samples.

    Parameters
    ----------
    count : int
        How many samples there are.
    ages : ndarray
        The places, as how many samples came after them, shape ``(n,)``.
    """

    def __init__(self, count: int, ages: NDArray[np.intp]) -> None:
        place = (count - 1 - ages)[:, None]
        after, before = ages[:, None], place
        full, half = SIZES - 1, (SIZES - 1) // 2
        nothing = np.zeros_like(place + full)
        reach = np.array(
            [
                [half + nothing, half + nothing],
                [full + nothing, nothing],
                [nothing, full + nothing],
                [full + nothing, nothing],
                [nothing, full + nothing],
            ]
        )  # kind, side, place, size
        left, right = reach[:, 0], reach[:, 1]
        there = (left <= before) & (right <= after)
        there[_AROUND] &= SIZES % 2 == 1
        there[[_LINE_BEFORE, _LINE_AFTER]] &= SIZES >= 3
        there[:, :, 0] = True  # the sample itself
        left, right = np.where(there, left, 0), np.where(there, right, 0)
        self._first = place - left
        self._end = place + right + 1
        size = (self._end - self._first).astype(float)
        lined = np.zeros(size.shape, bool)
        lined[[_LINE_BEFORE, _LINE_AFTER]] = size[[_LINE_BEFORE, _LINE_AFTER]] >= 3
        middle = 0.5 * (self._first + self._end - 1)
        offset = np.where(lined, place - middle, 0.0)
        spread = size * (size * size - 1.0) / 12.0  # Σ (k − middle)²
        spread[size < 2] = 1.0
        self._middle = middle
        self._size = size
        self._tilt = offset / spread
        error = np.sqrt(1.0 / size + offset * offset / spread)
        self._error = np.where(there, error, np.inf)
        self._half_width = CONFIDENCES * self._error
        self._kinds, self._places = np.ogrid[0:5, 0 : len(ages)]
        self._place_numbers = np.arange(len(ages))

    def estimate(self, samples: Floats, stddev: float) -> Estimate:
        """Estimate signals at the places.

        Parameters
        ----------
        samples : ndarray
            Shape ``(signals, count)``.
        stddev : float
            Standard deviation of a sample.

        Returns
        -------
        Estimate
            Of shape ``(signals, places)``.
        """
        base = samples[:, -1:]
        centred = samples - base
        numbers = np.arange(samples.shape[1])
        sums = np.zeros((2, samples.shape[0], samples.shape[1] + 1))
        np.cumsum(centred, axis=1, out=sums[0, :, 1:])
        np.cumsum(centred * numbers, axis=1, out=sums[1, :, 1:])
        total, moment = sums[:, :, self._end] - sums[:, :, self._first]
        value: Any = total / self._size + self._tilt * (moment - self._middle * total)
        half_width = stddev * self._half_width
        # Of each kind, how far the intervals have a point in common, from narrow to wide.
        with np.errstate(invalid='ignore'):
            lowest = np.maximum.accumulate(value - half_width, axis=-1)
            highest = np.minimum.accumulate(value + half_width, axis=-1)
        agreeing = np.logical_and.accumulate(lowest <= highest, axis=-1)
        error = np.where(agreeing, self._error, np.inf)
        shape = (samples.shape[0], len(self._place_numbers), -1)
        error = np.moveaxis(error, 1, 2).reshape(shape)
        value = np.moveaxis(value, 1, 2).reshape(shape)
        best = np.argmin(error, axis=-1)[..., None]
        return Estimate(
            np.take_along_axis(value, best, -1)[..., 0] + base,
            stddev * np.take_along_axis(error, best, -1)[..., 0],
        )


class SampleBuffer:
    """The newest samples of some signals, in a row.

    Parameters
    ----------
    signals : int
        How many signals there are.
    """

    def __init__(self, signals: int) -> None:
        self._values: Floats = np.zeros((signals, 4 * REACH))
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

    def newest(self, count: int) -> Floats:
        """Return the newest samples, shape ``(signals, count)``."""
        return self._values[:, self._end - count : self._end]
