"""The value of a signal behind noisy samples, from windows as wide as the signal lets them be.

At a place in the signal there are windows of six kinds: around it, before it and after it, with
the mean of the samples for a signal at rest; before and after it with a straight line for one that
moves; and around it with a parabola for one that turns. Wider ones have the smaller standard
error, and are wrong where the signal bends within them. So of each kind the widest is taken with
which the confidence intervals of all narrower ones still have a point in common (the rule of
intersecting confidence intervals: Goldenshluger and Nemirovski, 1997; Katkovnik, 1999, with
windows to one side). By that rule bias may grow to twice the standard error before it is noticed.
So the estimate is the window one size narrower, where a bias is a quarter of that or a half; and
its error is the standard error together with the distance between the two, which tells of the bias
that is left. Of the six kinds the one with the smallest error is taken, with a handicap for
windows to one side. Next to a corner that is a window that ends there: the mean of a rest right
after a step is as good as in its midst.

A line that comes up to a corner is believed for a little too long, since a few samples beyond it
do not tell; and a unit would be carried along by a ramp that is seen to go on. But a signal does
not jump. So where windows before and after a place say different things, it bends between two
straight pieces that meet, and is the lower of the two where it bends down, the higher where it
bends up. A rest is not to be taken apart by a corner that noise has made up, though: a place has
thousands of others like it in a minute, and the less sure of two windows at one of them would
carry the unit away for good. So one of the two pieces has to be a line beyond doubt, or they have
to differ beyond doubt.

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

CONFIDENCES = np.array([5.0, 5.0, 4.5, 4.0, 3.5, 3.0, 2.5, 2.25, 2.0])
"""Half-widths of the confidence intervals of windows of `SIZES`, in standard errors. There are the
more narrow windows in an hour, so that chance has the more to offer, and what is told by one alone
is the least sure: a rest is not to be torn apart by what is far out once in a million samples"""

SURE = 3.5
"""Standard errors by which a slope, or the difference of two windows, is one beyond doubt"""

HANDICAP = 2.0
"""So many times as sure as one around a place a window to one side has to be. What bends within a
window misleads it more, and next to a crest the mean of what rises and falls by as much agrees
with those of narrower windows by chance"""

_AROUND, _MEANS, _LINES, _PARABOLA = 0, slice(1, 3), slice(3, 5), 5
"""Kinds of windows: around, before, after, lines before and after, and a parabola around"""
KINDS = 6
_HANDICAPS = np.array([1.0, HANDICAP, HANDICAP, HANDICAP, HANDICAP, 1.0])[:, None]
_MEAN_KINDS, _LINE_KINDS = np.array([[1], [2]]), np.array([[3], [4]])


class Estimate(NamedTuple):
    """What the samples tell of a signal at some places; arrays of the shape of the places."""

    value: Floats
    error: Floats
    """Standard error, in the unit of the samples"""

    def part(self, places: Any) -> Estimate:
        """Return it at some of the places, or at one."""
        return Estimate(self.value[:, places], self.error[:, places])


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
        left = np.stack([half, full, nothing, full, nothing, half], axis=1) + 0 * ages
        right = np.stack([half, nothing, full, nothing, full, half], axis=1) + 0 * ages
        there = (left <= place) & (right <= ages)
        there[:, _AROUND] &= sizes % 2 == 1
        there[:, _LINES] &= sizes[..., None] >= 3
        there[:, _PARABOLA] &= (sizes % 2 == 1) & (sizes >= 5)
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
        # A value takes so much of the sums over the window of samples, of samples times their
        # numbers, and of samples times their numbers squared.
        of_sums = np.array([1.0 / size - tilt * middle, tilt, 0.0 * tilt])
        peak, bend = _parabola(size[:, _PARABOLA])
        of_sums[:, :, _PARABOLA] = peak - bend * place**2, 2.0 * bend * place, -bend
        self._of_sums = of_sums.reshape(3, 1, -1)
        # The slope of a line takes so much of the first two.
        self._of_slope = np.where(lined, spread, 0.0).reshape(-1)  # 1 / (its standard error)²
        self._slope_of_sums = (
            np.where(lined, 1.0 / spread, 0.0) * np.array([-middle, 1.0 + 0.0 * middle])
        ).reshape(2, -1)
        self._ends = np.array([first.reshape(-1), end.reshape(-1)])
        variance = 1.0 / size + offset * tilt
        variance[:, _PARABOLA] = peak
        error = np.where(there, np.sqrt(variance), np.inf)
        self._half_width = (CONFIDENCES[:, None, None] * error).reshape(len(SIZES), -1)
        self._error = error.reshape(-1)
        self._numbers = np.arange(count)

        # Where the n narrowest sizes agree: the widest of them that is there, and that before.
        widest = np.zeros((len(SIZES) + 1, *there.shape[1:]), np.intp)
        taken = widest.copy()
        for number, is_there in enumerate(there):
            widest[number + 1] = np.where(is_there, number, widest[number])
            taken[number + 1] = np.where(is_there, widest[number], taken[number])
        self._places = np.arange(len(ages))
        self._columns = np.arange(KINDS * len(ages))
        """Numbers of the kinds at each place"""
        columns = self._columns.reshape(KINDS, -1)
        self._chosen = (len(self._columns) * np.array([taken, widest]) + columns).reshape(2, -1)
        """Windows, by how many sizes agree and by column"""

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
        # Arrays are small, so that what counts is how many calls of NumPy there are, and how each
        # takes elements: by numbers in the flat array, which is the fastest.
        signals, count = samples.shape
        base = samples[:, -1:]
        sums = np.zeros((3, signals, count + 1))
        centred = sums[0, :, 1:]
        np.subtract(samples, base, out=centred)
        np.multiply(centred, self._numbers, out=sums[1, :, 1:])
        np.multiply(sums[1, :, 1:], self._numbers, out=sums[2, :, 1:])
        np.add.accumulate(sums, axis=2, out=sums)
        at_ends = sums.take(self._ends, axis=2)
        within = at_ends[:, :, 1] - at_ends[:, :, 0]
        values = np.add.reduce(within * self._of_sums, axis=0)
        # Of each kind, up to which size the intervals have a point in common.
        half_width = stddev * self._half_width
        of_sizes = values.reshape(signals, *half_width.shape)
        lowest = np.maximum.accumulate(of_sizes - half_width, axis=1)
        highest = np.minimum.accumulate(of_sizes + half_width, axis=1)
        agreeing = np.add.reduce(lowest <= highest, axis=1, dtype=np.intp)
        chosen = self._chosen.take(len(self._columns) * agreeing + self._columns, axis=1)
        rows = np.arange(signals)[:, None]
        taken = chosen[0]
        value, wider = values.take(chosen + len(self._error) * rows)
        error = np.hypot(stddev * self._error.take(taken), wider - value)
        best = self._best(within, taken, value, error, stddev)
        which = len(self._places) * best + self._places + len(self._columns) * rows
        return Estimate(value.take(which) + base, error.take(which))

    def _best(
        self,
        within: Floats,
        taken: NDArray[np.intp],
        value: Floats,
        error: Floats,
        stddev: float,
    ) -> NDArray[np.intp]:
        """Return which kind of window is taken at each place.

        Parameters
        ----------
        within : ndarray
            Sums over all windows, shape ``(3, signals, windows)``.
        taken, value, error : ndarray
            Of each kind at each place the window, and what it says, shape ``(signals, columns)``.
        stddev : float
            Standard deviation of a sample.
        """
        signals = len(value)
        shape = signals, KINDS, len(self._places)
        taken, value, error = taken.reshape(shape), value.reshape(shape), error.reshape(shape)
        lines = taken[:, _LINES]
        series = within.shape[2] * np.arange(signals)[:, None, None]
        parts = within.reshape(3, -1)[:2].take(lines + series, axis=1)
        parts *= self._slope_of_sums.take(lines, axis=1)
        slope = parts[0] + parts[1]
        steep = slope * slope * self._of_slope.take(lines) > (SURE * stddev) ** 2
        # A rest needs no handicap, where any window that noise has left whole is as good.
        moves = steep[:, :1] | steep[:, 1:]
        surest = np.where(moves, error * _HANDICAPS, error).argmin(axis=1)
        # Before and after the place, whichever of mean and line is the surer.
        lined = error[:, _LINES] < error[:, _MEANS]
        sure = np.minimum(error[:, _LINES], error[:, _MEANS])
        says = np.where(lined, value[:, _LINES], value[:, _MEANS])
        slope *= lined
        steep &= lined
        change, bend = says[:, 1] - says[:, 0], slope[:, 1] - slope[:, 0]
        is_before = (change > 0.0) == (bend < 0.0)
        doubt, change = (sure * sure).sum(axis=1), change * change
        corner = change > doubt
        corner &= steep[:, 0] | steep[:, 1] | (change > SURE * SURE * doubt)
        # A single sample tells of no corner.
        corner &= np.where(is_before, sure[:, 0], sure[:, 1]) < stddev
        corner &= bend != 0.0
        kinds = np.where(lined, _LINE_KINDS, _MEAN_KINDS)
        met = np.where(is_before, kinds[:, 0], kinds[:, 1])
        return np.where(corner, met, surest)


def _parabola(size: Floats) -> tuple[Floats, Floats]:
    """Return a and b of the weights a − b k² that give a parabola's value in the middle, k = 0.

    Of windows of at least five samples (Savitzky and Golay, 1964); the others are the sample
    itself. The variance of the value is a.
    """
    scale = np.where(size >= 5.0, size * (size * size - 4.0), np.inf)
    a = np.where(size >= 5.0, 0.75 * (3.0 * size * size - 7.0) / scale, 1.0)
    return a, 15.0 / scale


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
