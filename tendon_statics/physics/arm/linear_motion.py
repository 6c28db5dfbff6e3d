"""The motion x' = f + J x from x = 0 in closed form; no physics."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MOST_GROWTH = 300.0
"""Exponent of what grows beyond which it is no more followed"""

PARTS = np.arange(1, 65) / 64.0
"""Of an interval of time, that are looked at at once"""

DOUBLINGS = 2.0 ** np.arange(-3, 1000)
"""Of the time in which the fastest goes by e"""


class LinearMotion:
    """A linear motion of several coordinates.

    Parameters
    ----------
    jacobian : array
        J, of which no eigenvalue is zero.
    velocity : array
        f.

    Raises
    ------
    numpy.linalg.LinAlgError
        If J has not as many eigenvectors as rows.
    """

    def __init__(self, jacobian: Floats, velocity: Floats) -> None:
        self.velocity, self._jacobian = velocity, jacobian
        self._rates, self._modes = np.linalg.eig(jacobian)
        self._ways = np.linalg.solve(self._modes, velocity) / self._rates

    def at(self, times: Floats) -> tuple[Floats, Floats]:
        """Return way and velocity, a column for each time."""
        growth = self._rates[:, None] * times
        growth = np.where(growth.real > MOST_GROWTH, MOST_GROWTH, growth)
        ways = (self._modes @ (np.expm1(growth) * self._ways[:, None])).real
        return ways, self.velocity[:, None] + self._jacobian @ ways

    def first(self, happens: Callable[[Floats], NDArray[np.bool_]]) -> float:
        """Return the first time at which something happens, infinite if it has died away before.

        It is found to a sixtieth of itself, on the far side.

        Parameters
        ----------
        happens : callable
            Whether it does, at each of some times.
        """
        fast, slow = abs(self._rates).max(), abs(self._rates.real).min()
        count = int(math.log2(8.0 * fast / slow)) + 3
        times = DOUBLINGS[: count + 3] / fast
        start = 0.0
        for _ in range(2):
            found = happens(times)
            if not found.any():
                # Between the places of the finer grid, at whose end it does.
                return float(times[-1]) if start else math.inf
            place = int(found.argmax())
            start, end = (times[place - 1] if place else start), times[place]
            times = start + (end - start) * PARTS
        return float(end)
