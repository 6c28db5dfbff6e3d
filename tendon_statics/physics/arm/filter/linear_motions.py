"""The motions x' = f + J x from x = 0 of many systems at once; no physics.

By doubling: with x and e^{Jt} at a time t, those at twice that are x + e^{Jt} x and its square.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

FIRST = 1.0 / 64.0
"""Of the times that are looked at, in units of that in which the fastest goes by e"""

DOUBLINGS = 30

BLOCK = 10
"""Of them, that are looked at at once"""

REFINEMENTS = 6
"""Halvings of the interval in which something happens"""

DIED = 3e-4
"""Share of its velocity at first below which a motion has died away"""


def times(matrix: Floats, vector: Floats) -> Floats:
    """Return the products of many matrices and vectors."""
    found: Floats = (matrix @ vector[..., None])[..., 0]
    return found


class LinearMotions:
    """Linear motions of several coordinates each, as `LinearMotion` has one.

    Parameters
    ----------
    jacobian, velocity : ndarray
        J and f of each, shapes ``(systems, n, n)`` and ``(systems, n)``.
    """

    def __init__(self, jacobian: Floats, velocity: Floats) -> None:
        self._jacobian, self._velocity = jacobian, velocity
        size = np.abs(jacobian).sum(axis=2).max(axis=1)
        time = (FIRST / size)[:, None]
        turn, term = jacobian * time[..., None], velocity * time
        # e^{Jt} and the way by their series; the next terms are below 1e-10 of the first.
        power = np.broadcast_to(np.eye(velocity.shape[1]), jacobian.shape)
        growth, way = power.copy(), np.zeros_like(term)
        for order in range(1, 6):
            way = way + term / order
            power, term = power @ turn / order, times(turn, term) / order
            growth += power
        self._ways, self._growths = [way], [growth]

    def velocity(self, way: Floats) -> Floats:
        """Return the velocities once they have gone some ways."""
        found: Floats = self._velocity + times(self._jacobian, way)
        return found

    def first(self, happens: Callable[[Floats, Floats], Flags]) -> tuple[Floats, Flags, Flags]:
        """Return the ways up to where something first happens, on the far side.

        Parameters
        ----------
        happens : callable
            Whether it does, from ways and velocities of shape ``(..., systems, n)``.

        Returns
        -------
        ways, happened, died : ndarray
            Whether it did, and whether the motion has died away before.
        """
        count = len(self._velocity)
        enough = DIED * np.abs(self._velocity).max(axis=1)
        at = np.full(count, -1)
        died = np.zeros(count, bool)
        for start in range(0, DOUBLINGS, BLOCK):
            with np.errstate(all='ignore'):  # what grows may overflow
                self._double(start + BLOCK)
                ways = np.array(self._ways[start:])
                velocities = self.velocity(ways)
                dead = np.abs(velocities).max(axis=2) <= enough
                dead = died | np.logical_or.accumulate(dead, axis=0)
                there = ~dead & happens(ways, velocities)
            now = (at < 0) & there.any(axis=0)
            at = np.where(now, start + there.argmax(axis=0), at)
            died = dead[-1] & (at < 0)
            if ((at >= 0) | died).all():
                break
        happened = at >= 0
        ways = self._way_at(np.maximum(at, 0), happens) if happened.any() else self._ways[-1]
        return ways, happened, died

    def _double(self, count: int) -> None:
        """Go on with doublings until there are so many."""
        while len(self._ways) < count:
            way, growth = self._ways[-1], self._growths[-1]
            self._ways.append(way + times(growth, way))
            self._growths.append(growth @ growth)

    def _way_at(self, at: NDArray[np.intp], happens: Callable[[Floats, Floats], Flags]) -> Floats:
        """Return the ways up to where it first happens between times of `first`."""
        every = np.arange(len(at))
        ways, growths = np.array(self._ways), np.array(self._growths)
        found = ways[at, every]
        before = np.maximum(at - 1, 0)
        way = np.where((at > 0)[:, None], ways[before, every], 0.0)
        identity = np.eye(way.shape[1])
        growth = np.where((at > 0)[:, None, None], growths[before, every], identity)
        for back in range(2, 2 + REFINEMENTS):
            index = np.maximum(at - back, 0)
            middle = way + times(growth, ways[index, every])
            there = happens(middle, self.velocity(middle))
            inside = at >= back
            found = np.where((inside & there)[:, None], middle, found)
            on = inside & ~there
            way = np.where(on[:, None], middle, way)
            growth = np.where(on[:, None, None], growth @ growths[index, every], growth)
        return found
