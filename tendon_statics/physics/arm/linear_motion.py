"""The motion x' = f + J x + (t/h)² d from x = 0 in closed form; no physics."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MOST_GROWTH = 300.0
"""Exponent of what grows beyond which it is no more followed"""

SMALL_PHASE = 0.05
"""Size of λ t below which φ₃ is taken from its series, where the closed form cancels"""

DOUBLINGS = 2.0 ** np.arange(-6, 12)
"""Of the time in which a way would be gone at the velocity at first"""

NO_RATE = 1e-300
"""In the place of a rate of zero, which everything here is the limit of"""

UNSOUND = 1e-6
"""Share of f by which it may not be the sum of its modes"""

COUPLING = 1e-3
"""Share of J by which it is changed where it has too few eigenvectors"""


class Path(NamedTuple):
    """Where a motion is at some times: a column for each."""

    times: Floats
    ways: Floats
    velocities: Floats
    accelerations: Floats


class LinearMotion:
    """A motion of several coordinates, linear but for a remainder that grows with t².

    Parameters
    ----------
    jacobian : array
        J.
    velocity : array
        f.

    Attributes
    ----------
    growth : float
        The fastest rate at which it grows; below zero where it dies away.
    to_rest : array
        Way to where it comes to rest, if it dies away and stays linear.

    Raises
    ------
    numpy.linalg.LinAlgError
        If J is not finite.
    """

    def __init__(self, jacobian: Floats, velocity: Floats) -> None:
        self.velocity = velocity
        try:
            rates, of_modes = self._decompose(jacobian)
        except np.linalg.LinAlgError:
            # Any small coupling gives it all eigenvectors; what that is amiss is remainder.
            ends = np.eye(len(jacobian))[::-1]
            rates, of_modes = self._decompose(jacobian + COUPLING * abs(jacobian).max() * ends)
        self._rates = np.where(rates == 0.0, NO_RATE, rates)
        self._ways = of_modes / self._rates
        self.growth = float(rates.real.max())
        self.to_rest: Floats = -(self._modes @ self._ways).real
        # Where nothing grows or dies away, time is measured by the way: in that of a radian.
        self._fast = float(max(abs(self._rates).max(), abs(velocity).max()))
        self._slow = float(abs(self._rates.real).min())

    def _decompose(self, jacobian: Floats) -> tuple[Any, Any]:
        """Return the rates of the modes, and f in modes.

        Raises
        ------
        numpy.linalg.LinAlgError
            If the matrix has not as many eigenvectors as rows, or nearly so.
        """
        self._jacobian = jacobian
        rates, self._modes = np.linalg.eig(jacobian)
        self._inverse = np.linalg.inv(self._modes)
        of_modes = self._inverse @ self.velocity
        left = abs(self._modes @ of_modes - self.velocity).max()
        if not left <= UNSOUND * abs(self.velocity).max():
            raise np.linalg.LinAlgError('too few eigenvectors')
        return rates, of_modes

    def times(self, most: float, ratio: float) -> Floats:
        """Return times at a ratio to one another, from almost at once to where it has died away.

        Parameters
        ----------
        most : float
            Of the last to the first at the most.
        """
        span = min(64.0 * self._fast / self._slow, most)
        count = int(math.log(span) / math.log(ratio)) + 2
        return np.asarray(0.125 / self._fast * ratio ** np.arange(count), np.float64)

    @property
    def lifetime(self) -> float:
        """The time after which a tenth is left of what dies away slowest."""
        return 2.3 / self._slow

    def ways(self, times: Floats) -> Floats:
        """Return the ways up to some times, a column for each, were it linear."""
        of_modes = np.expm1(self._phases(times)) * self._ways[:, None]
        return np.asarray((self._modes @ of_modes).real, np.float64)

    def at(self, time: float) -> tuple[Floats, Floats]:
        """Return way and velocity at a time, were it linear."""
        of_modes = np.expm1(self._phases(time)) * self._ways
        way: Floats = (self._modes @ of_modes).real
        return way, self.velocity + self._jacobian @ way

    def bend(self, time: float, remainder: Floats) -> tuple[Floats, Floats]:
        """Return what a remainder adds to way and velocity at a time, if it is d·(t/h)² there."""
        gains = 2.0 * time * _phi_3(self._phases(time))
        way: Floats = (self._modes @ (gains * (self._inverse @ remainder))).real
        return way, remainder + self._jacobian @ way

    def far(self, way: float) -> float:
        """Return about when it would be as far as a way, were it linear; infinite if never."""
        times = np.asarray(way / abs(self.velocity).max() * DOUBLINGS, np.float64)
        gone = abs(self.ways(times)).max(axis=0)
        there = np.flatnonzero(gone > way)
        if not len(there):
            return math.inf
        place = int(there[0])
        if place == 0:
            return float(times[0])
        share = (way - gone[place - 1]) / (gone[place] - gone[place - 1])
        return float(times[place - 1] + share * (times[place] - times[place - 1]))

    def path(self, times: Floats, remainder: Floats | None = None, end: float = 1.0) -> Path:
        """Return where it is at some times.

        Parameters
        ----------
        remainder : array, optional
            d; None: zero.
        end : float
            h.
        """
        if remainder is None:
            ways = self.ways(times)
            velocities = self.velocity[:, None] + self._jacobian @ ways
            return Path(times, ways, velocities, self._jacobian @ velocities)
        shares = times / end
        squares = shares * shares
        phases = self._phases(times)
        of_modes = np.expm1(phases) * self._ways[:, None]
        of_modes += 2.0 * times * squares * _phi_3(phases) * (self._inverse @ remainder)[:, None]
        ways = (self._modes @ of_modes).real
        velocities = self.velocity[:, None] + self._jacobian @ ways + squares * remainder[:, None]
        accelerations = self._jacobian @ velocities + (2.0 / end) * shares * remainder[:, None]
        return Path(times, ways, velocities, accelerations)

    def _phases(self, times: Any) -> Any:
        """λ t of all modes, at a time or, a column for each, at some."""
        phases = self._rates * times if np.ndim(times) == 0 else np.outer(self._rates, times)
        if self.growth > 0.0:
            phases = np.where(phases.real > MOST_GROWTH, MOST_GROWTH, phases)
        return phases


def _phi_3(phases: Any) -> Any:
    """φ₃(z) = (e^z − 1 − z − z²/2) / z³."""
    small = abs(phases) < SMALL_PHASE
    if not small.any():
        return (np.expm1(phases) - phases - 0.5 * phases * phases) / phases**3
    z = np.where(small, 1.0, phases)
    found = (np.expm1(z) - z - 0.5 * z * z) / z**3
    z = phases
    series = (1.0 + 0.25 * z * (1.0 + 0.2 * z * (1.0 + z / 6.0 * (1.0 + z / 7.0)))) / 6.0
    return np.where(small, series, found)
