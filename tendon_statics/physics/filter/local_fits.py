"""Means, lines and parabolas through windows of samples, all at once from sums that run on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SIZES = np.array([1, 2, 3, 5, 9, 17, 33, 65, 129])
"""Samples of a window"""

REACH = int(SIZES[-1])
"""Samples before a place that its windows reach"""

AROUND, MEANS, LINES, PARABOLA = 0, slice(1, 3), slice(3, 5), 5
"""Kinds of windows: around, before, after, lines before and after, and a parabola around"""
KINDS = 6


class LocalFits:
    """What windows at some places in a series of samples say of the signal there.

    Parameters
    ----------
    count : int
        How many samples there are.
    ages : ndarray
        The places, as how many samples came after them, shape ``(n,)``.

    Attributes
    ----------
    there : ndarray
        Which windows there are, by size, kind and place, shape ``(sizes, kinds, n)``.
    number : ndarray
        Number of each of these in `at`, of the same shape.
    error : ndarray
        Standard errors of the values in standard deviations of a sample, by number.
    precision : ndarray
        1 / (standard error of the slope)² in the same unit, by number; 0 where there is none.
    width : int
        How many values and slopes there are.
    slope_from_line : int
        From the number of a line to that of its slope in `at`.
    """

    def __init__(self, count: int, ages: NDArray[np.intp]) -> None:
        place = count - 1 - ages
        sizes = SIZES[:, None]
        full, half = sizes - 1, (sizes - 1) // 2
        nothing = np.zeros_like(full)
        # kind, size, place
        left = np.stack([half, full, nothing, full, nothing, half]) + 0 * ages
        right = np.stack([half, nothing, full, nothing, full, half]) + 0 * ages
        there = (left <= place) & (right <= ages)
        there[AROUND] &= sizes % 2 == 1
        there[LINES] &= sizes >= 3
        there[PARABOLA] &= (sizes % 2 == 1) & (sizes >= 5)
        there[:, 0] = True  # the sample itself
        number = np.zeros(there.shape, np.intp)
        number[there] = np.arange(np.count_nonzero(there))
        self.there, self.number = (by_kind.swapaxes(0, 1) for by_kind in (there, number))

        # From here on in a row: all means, all lines, all parabolas.
        lines, bent = int(number[LINES.start, 0, 0]), int(number[PARABOLA, 0, 0])
        place = np.broadcast_to(place, there.shape)[there]
        first, end = place - left[there], place + right[there] + 1
        size = (end - first).astype(float)
        middle = 0.5 * (first + end - 1)
        lined = size >= 3.0
        lined[:lines] = lined[bent:] = False
        offset = np.where(lined, place - middle, 0.0)
        spread = np.where(size > 1.0, size * (size * size - 1.0) / 12.0, 1.0)  # Σ (k − middle)²
        tilt = offset / spread
        # A value takes so much of the sums over the window of samples, of samples times their
        # numbers, and of samples times their numbers squared.
        values = np.array([1.0 / size - tilt * middle, tilt, 0.0 * tilt])
        peak, bend = _parabola(size[bent:])
        at = place[bent:]
        values[:, bent:] = peak - bend * at**2, 2.0 * bend * at, -bend
        variance = 1.0 / size + offset * tilt
        variance[bent:] = peak
        self.error = np.sqrt(variance)
        # The slope of a line takes so much of the first two.
        self.precision = np.where(lined, spread, 0.0)
        steepness = np.where(lined, 1.0 / spread, 0.0)
        slopes = np.array([-middle * steepness, steepness, 0.0 * steepness])

        # Values of all, then slopes of lines; of each sum those that take anything of it.
        weights = np.concatenate([values, slopes[:, lines:bent]], axis=1)
        taking = slice(0, None), slice(lines, None), slice(bent, len(size))
        self._weights = np.concatenate([weights[k, takes] for k, takes in enumerate(taking)])
        ends = np.array([first, end])
        ends = np.concatenate([ends, ends[:, lines:bent]], axis=1)
        self._ends = np.concatenate(
            [ends[:, takes] + k * (count + 1) for k, takes in enumerate(taking)], axis=1
        )
        self.width = width = ends.shape[1]
        more = slice(width, 2 * width - lines), slice(2 * width - lines, None)
        self._further = tuple(zip(taking[1:], more, strict=True))
        self.slope_from_line = len(size) - lines
        self._numbers = np.arange(float(count))

    def at(self, samples: Floats) -> Floats:
        """Return what they say: values of all windows, then slopes of the lines.

        Parameters
        ----------
        samples : ndarray
            Shape ``(signals, count)``.

        Returns
        -------
        ndarray
            Shape ``(signals, values and slopes)``; the values less the newest sample.
        """
        # Arrays are small, so that what counts is how many calls of NumPy there are.
        signals, count = samples.shape
        sums = np.zeros((signals, 3, count + 1))
        centred, times_number = sums[:, 0, 1:], sums[:, 1, 1:]
        np.subtract(samples, samples[:, -1:], out=centred)
        np.multiply(centred, self._numbers, out=times_number)
        np.multiply(times_number, self._numbers, out=sums[:, 2, 1:])
        np.add.accumulate(sums, axis=2, out=sums)
        at_ends = sums.reshape(signals, -1).take(self._ends, axis=1)
        parts = at_ends[:, 1] - at_ends[:, 0]
        parts *= self._weights
        found: Floats = parts[:, : self.width].copy()
        for takes, more in self._further:
            into = found[:, takes]
            into += parts[:, more]
        return found


def _parabola(size: Floats) -> tuple[Floats, Floats]:
    """Return a and b of the weights a − b k² that give a parabola's value in the middle, k = 0.

    Of windows of at least five samples (Savitzky and Golay, 1964); the others are the sample
    itself. The variance of the value is a.
    """
    scale = np.where(size >= 5.0, size * (size * size - 4.0), np.inf)
    a = np.where(size >= 5.0, 0.75 * (3.0 * size * size - 7.0) / scale, 1.0)
    return a, 15.0 / scale
