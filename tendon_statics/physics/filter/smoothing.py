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

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .local_fits import KINDS, LINES, MEANS, SIZES, LocalFits

Floats = NDArray[np.float64]

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

_HANDICAPS = np.array([1.0, HANDICAP, HANDICAP, HANDICAP, HANDICAP, 1.0])[:, None, None]
_MEAN_KINDS, _LINE_KINDS = (np.arange(KINDS)[kinds, None, None] for kinds in (MEANS, LINES))


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
    count, ages
        As of `LocalFits`.
    signals : int
        How many signals are estimated.
    """

    def __init__(self, count: int, ages: NDArray[np.intp], signals: int) -> None:
        self._fits = fits = LocalFits(count, ages)
        # Arrays are small, so that what counts is how many calls of NumPy there are, and that they
        # find elements in a row: by size, kind, signal and place; taken by their flat numbers.
        self._spots = np.arange(signals * len(ages)).reshape(signals, -1)
        self._of_signal = fits.width * np.arange(signals)[:, None]
        self._of_slopes = self._of_signal + fits.slope_from_line
        self._of_sizes = fits.number[:, :, None] + self._of_signal
        error = np.where(fits.there, fits.error[fits.number], np.inf)
        half_width = CONFIDENCES[:, None, None] * error
        self._half_width = np.repeat(half_width[:, :, None], signals, axis=2)
        # Where the n narrowest sizes agree: the widest of them that is there, and that before.
        widest, taken = [fits.number[0]], [fits.number[0]]
        for is_there, number in zip(fits.there, fits.number, strict=True):
            taken.append(np.where(is_there, widest[-1], taken[-1]))
            widest.append(np.where(is_there, number, widest[-1]))
        self._chosen = np.array([taken, widest]).reshape(2, -1)
        """Windows, by how many sizes agree and by column: kind and place"""
        columns = np.arange(KINDS * len(ages))
        self._columns = np.repeat(columns.reshape(KINDS, 1, -1), signals, axis=1)
        self._all_columns = len(columns)

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
        fits = self._fits
        found = fits.at(samples)
        # Of each kind, up to which size the intervals have a point in common: from the least of
        # how far they reach up, and the least of how far they reach down.
        of_sizes = found.take(self._of_sizes)
        half_width = stddev * self._half_width
        reach = np.empty((len(SIZES), 2, *of_sizes.shape[1:]))
        np.add(half_width, of_sizes, out=reach[:, 0])
        np.subtract(half_width, of_sizes, out=reach[:, 1])
        for narrower, wider in pairwise(reach):
            np.minimum(narrower, wider, out=wider)
        agreeing = np.add.reduce(reach[:, 0] + reach[:, 1] >= 0.0, axis=0, dtype=np.intp)
        chosen = self._chosen.take(self._all_columns * agreeing + self._columns, axis=1)
        value, wider = found.take(chosen + self._of_signal)
        taken = chosen[0]
        error = np.hypot(stddev * fits.error.take(taken), wider - value)
        lines = taken[LINES]
        slope = found.take(lines + self._of_slopes)
        steep = slope * slope * fits.precision.take(lines) > (SURE * stddev) ** 2
        best = self._best(value, error, slope, steep, stddev)
        which = self._spots.size * best + self._spots
        return Estimate(value.take(which) + samples[:, -1:], error.take(which))

    @staticmethod
    def _best(
        value: Floats, error: Floats, slope: Floats, steep: NDArray[np.bool_], stddev: float
    ) -> NDArray[np.intp]:
        """Return which kind of window is taken at each place.

        Parameters
        ----------
        value, error : ndarray
            What the window of each kind says, shape ``(kinds, signals, places)``.
        slope, steep : ndarray
            Slopes of the two lines, and whether they are ones beyond doubt, shape ``(2, signals,
            places)``.
        stddev : float
            Standard deviation of a sample.
        """
        # Before and after the place, whichever of mean and line is the surer.
        of_mean, of_line = error[MEANS], error[LINES]
        lined = of_line < of_mean
        sure = np.minimum(of_line, of_mean)
        says = np.where(lined, value[LINES], value[MEANS])
        change = says[1] - says[0]
        before, after = sure * sure
        doubt = before + after
        handicapped, least = error, SURE * SURE * doubt
        # A rest needs no handicap, where any window that noise has left whole is as good.
        if np.count_nonzero(steep):
            handicapped = np.where(steep[0] | steep[1], error * _HANDICAPS, error)
            steep &= lined
            least = np.where(steep[0] | steep[1], doubt, least)
        surest: NDArray[np.intp] = handicapped.argmin(axis=0)
        corner = change * change > least
        if not np.count_nonzero(corner):
            return surest
        slope *= lined
        bend = slope[1] - slope[0]
        is_before = change * bend < 0.0
        # A single sample tells of no corner.
        corner &= np.where(is_before, sure[0], sure[1]) < stddev
        corner &= bend != 0.0
        kinds = np.where(lined, _LINE_KINDS, _MEAN_KINDS)
        met = np.where(is_before, kinds[0], kinds[1])
        return np.where(corner, met, surest)
