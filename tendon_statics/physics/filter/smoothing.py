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

_AROUND, _LINES = 0, slice(3, 5)
"""Kinds of windows: around, before, after, and lines before and after"""


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
        place = count - 1 - ages
        sizes = SIZES[:, None]
        full, half = sizes - 1, (sizes - 1) // 2
        nothing = np.zeros_like(full)
        # size, kind, place
        left = np.stack([half, full, nothing, full, nothing], axis=1) + 0 * ages
        right = np.stack([half, nothing, full, nothing, full], axis=1) + 0 * ages
        there = (left <= place) & (right <= ages)
        there[:, _AROUND] &= sizes % 2 == 1
        there[:, _LINES] &= sizes[..., None] >= 3
        there[0] = True  # the sample itself
        left, right = np.where(there, left, 0), np.where(there, right, 0)
        first, end = place - left, place + right + 1
        size = (end - first).astype(float)
        middle = 0.5 * (first + end - 1)
        lined = np.zeros(size.shape, bool)
        lined[:, _LINES] = size[:, _LINES] >= 3
        offset = np.where(lined, place - middle, 0.0)
        spread = np.where(size > 1, size * (size * size - 1.0) / 12.0, 1.0)  # Σ (k − middle)²
        tilt = offset / spread
        # A value is a sum over the window plus a sum of samples times their numbers.
        self._of_sums = np.array([1.0 / size - tilt * middle, tilt])[:, None]
        self._first, self._end = first, end
        error = np.where(there, np.sqrt(1.0 / size + offset * tilt), np.inf)
        self._half_width = CONFIDENCES[:, None, None] * error
        self._numbers = np.arange(count)

        # Where the n narrowest sizes agree, the one before the widest of them that is there.
        taken = np.zeros((len(SIZES) + 1, *there.shape[1:]), np.intp)
        widest, before = taken[0].copy(), taken[0].copy()
        for number, is_there in enumerate(there):
            before, widest = (
                np.where(is_there, widest, before),
                np.where(is_there, number, widest),
            )
            taken[number + 1] = before
        kinds, places = np.ogrid[0 : taken.shape[1], 0 : taken.shape[2]]
        self._taken = np.ravel_multi_index((taken, kinds, places), size.shape)
        self._kinds, self._places = kinds, places
        self._error = error.reshape(-1)

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
        signals, count = samples.shape
        base = samples[:, -1:]
        sums = np.zeros((2, signals, count + 1))
        centred = samples - base
        np.cumsum(centred, axis=1, out=sums[0, :, 1:])
        np.cumsum(centred * self._numbers, axis=1, out=sums[1, :, 1:])
        within = sums.take(self._end, axis=-1) - sums.take(self._first, axis=-1)
        within *= self._of_sums
        value = within[0] + within[1]
        # Of each kind, up to which size the intervals have a point in common.
        half_width = stddev * self._half_width
        lowest = np.maximum.accumulate(value - half_width, axis=1)
        highest = np.minimum.accumulate(value + half_width, axis=1)
        agreeing = (lowest <= highest).sum(axis=1)
        taken = self._taken[agreeing, self._kinds, self._places]
        best = self._error[taken].argmin(axis=1)
        series = np.arange(signals)[:, None]
        taken = taken[series, best, self._places[0]]
        return Estimate(
            value.reshape(signals, -1)[series, taken] + base, stddev * self._error[taken]
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
