"""The motion x' = f + J x + (t/h)² d from x = 0 in closed form; no physics."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MOST_GROWTH = 300.0
"""Exponent of what grows beyond which it is no more followed"""

SMALL_PHASE = 1e-4
"""Size of λ t below which φ₃ is taken to be as there, since the closed form cancels"""

RATIO, MOST_SPAN = 1.2, 1e9
"""Of one time that is looked at to that before it, and of the last to the first at the most"""

TIMES = np.append(0.0, RATIO ** np.arange(int(math.log(MOST_SPAN) / math.log(RATIO)) + 2))

DOUBLINGS = 2.0 ** np.arange(-6, 12)
"""Of the time in which a way would be gone at the velocity at first"""

NO_RATE = 1e-300
"""In the place of a rate of zero, which everything here is the limit of"""

UNSOUND = 1e-6
"""Share of f by which it may not be the sum of its modes"""

COUPLING = 1e-3
"""Share of J by which it is changed where it has too few eigenvectors"""


PARTS = np.arange(0, 23) / 20.0
"""Of the time of a course, that are looked at, and a little beyond"""

NODE, END = 15, 20
"""Which of them is where the remainder is looked at, and which is the end"""

SQUARES, CUBES = PARTS**2, PARTS**3


def largest(values: Any) -> float:
    """Return the largest size in a small array, for which this is fast."""
    found: float = max(map(abs, values.tolist()))
    return found


class Path(NamedTuple):
    """Where a motion is at some times: a column for each."""

    times: Floats
    ways: Floats
    velocities: Floats

    def way(self, time: float, place: int) -> Floats:
        """Return the way up to a time between that of a column and of the one before it.

        By the cubic that has the ways and velocities of both.
        """
        before = self.times[place - 1]
        span = self.times[place] - before
        share = (time - before) / span
        rest = 1.0 - share
        ways, velocities = self.ways, self.velocities * span
        found: Floats = rest * rest * (
            (1.0 + 2.0 * share) * ways[:, place - 1] + share * velocities[:, place - 1]
        ) + share * share * ((1.0 + 2.0 * rest) * ways[:, place] - rest * velocities[:, place])
        return found


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
    rates, modes, inverse : array
        Eigenvalues of J, its right eigenvectors as columns, and the inverse of these; complex if
        it swings.
    growth : float
        The fastest rate at which it grows; below zero where it dies away.
    decay : float
        The fastest rate at which some of it dies away; zero if none does.
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
        self.rates = rates if rates.all() else np.where(rates == 0.0, NO_RATE, rates)
        self._ways = of_modes / self.rates
        real = self.rates.real.tolist()
        self.growth: float = max(real)
        self.decay: float = max(-min(real), 0.0)
        self.to_rest: Floats = -(self.modes @ self._ways).real
        self._slow: float = min(map(abs, real)) or NO_RATE

    def _decompose(self, jacobian: Floats) -> tuple[Any, Any]:
        """Return the rates of the modes, and f in modes.

        Raises
        ------
        numpy.linalg.LinAlgError
            If the matrix has not as many eigenvectors as rows, or nearly so.
        """
        self._jacobian = jacobian
        rates, self.modes = np.linalg.eig(jacobian)
        self.inverse = np.linalg.inv(self.modes)
        of_modes = self.inverse @ self.velocity
        if not largest(self.modes @ of_modes - self.velocity) <= UNSOUND * largest(self.velocity):
            raise np.linalg.LinAlgError('too few eigenvectors')
        return rates, of_modes

    def times(self) -> Floats:
        """Return the start and times from almost at once to where it has died away."""
        # Where nothing grows or dies away, time is measured by the way: in that of a radian.
        fast = max(largest(self.rates), largest(self.velocity))
        span = 64.0 * fast / self._slow
        count = int(math.log(span) / math.log(RATIO)) + 3 if span < MOST_SPAN else len(TIMES)
        return np.asarray(0.125 / fast * TIMES[:count], np.float64)

    @property
    def lifetime(self) -> float:
        """The time after which a tenth is left of what dies away slowest."""
        return 2.3 / self._slow

    def ways(self, times: Floats) -> Floats:
        """Return the ways up to some times, a column for each, were it linear."""
        of_modes = np.expm1(self._phases(times)) * self._ways[:, None]
        return np.asarray((self.modes @ of_modes).real, np.float64)

    def way(self, time: float) -> Floats:
        """Return the way up to a time, were it linear."""
        return self.ways(np.array([time]))[:, 0]

    def course(self, end: float) -> Course:
        """Return the motion up to a time, were it linear, and what a remainder makes of it."""
        return Course(self, end)

    def far(self, way: float) -> float:
        """Return about when it would be as far as a way, were it linear; infinite if never."""
        times = np.asarray(way / largest(self.velocity) * DOUBLINGS, np.float64)
        gone = abs(self.ways(times)).max(axis=0)
        there = np.flatnonzero(gone > way)
        if not len(there):
            return math.inf
        place = int(there[0])
        if place == 0:
            return float(times[0])
        share = (way - gone[place - 1]) / (gone[place] - gone[place - 1])
        return float(times[place - 1] + share * (times[place] - times[place - 1]))

    def velocity_at(self, way: Floats) -> Floats:
        """Return the velocity at a way, were it linear."""
        found: Floats = self.velocity + self._jacobian @ way
        return found

    def bend(self, time: float, remainder: Floats) -> Floats:
        """Return what a remainder of the velocity makes of the way, if it came with t²."""
        gains = (2.0 * time) * _phi_3(self.rates * time)
        return np.asarray((self.modes @ (gains * (self.inverse @ remainder))).real, np.float64)

    def path(self, times: Floats) -> Path:
        """Return where it is at some times, were it linear."""
        ways = self.ways(times)
        velocities = self.velocity[:, None] + self._jacobian @ ways
        return Path(times, ways, velocities)

    def _phases(self, times: Floats) -> Any:
        """λ t of all modes, a column for each time."""
        phases = self.rates[:, None] * times
        if self.growth > 0.0 and self.growth * times[-1] > MOST_GROWTH:
            phases = np.where(phases.real > MOST_GROWTH, MOST_GROWTH, phases)
        return phases


class Course:
    """A `LinearMotion` up to a time h, at all `PARTS` of it.

    Attributes
    ----------
    node : array
        Way to the `NODE`, were it linear.
    """

    def __init__(self, linear: LinearMotion, end: float) -> None:
        self._linear, self._end = linear, end
        self._times: Floats = end * PARTS
        self._phases = linear._phases(self._times)
        of_modes = np.expm1(self._phases) * linear._ways[:, None]
        self._ways: Floats = (linear.modes @ of_modes).real
        self.node = self._ways[:, NODE]

    def bent(self, remainder: Floats) -> Path:
        """Return where it is if there is a remainder d·(t/h)²; `remainder` is d."""
        linear = self._linear
        gains = (2.0 * self._end) * CUBES * _phi_3(self._phases)
        of_modes = gains * (linear.inverse @ remainder)[:, None]
        ways = self._ways + (linear.modes @ of_modes).real
        velocities = linear.velocity[:, None] + linear._jacobian @ ways
        velocities += SQUARES * remainder[:, None]
        return Path(self._times, ways, velocities)


def _phi_3(phases: Any) -> Any:
    """φ₃(z) = (e^z − 1 − z − z²/2) / z³, to a ten-thousandth."""
    z = np.where(abs(phases) < SMALL_PHASE, SMALL_PHASE, phases)
    squares = z * z
    return (np.expm1(z) - z - 0.5 * squares) / (squares * z)
