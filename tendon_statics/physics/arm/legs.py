"""A motion leg by leg: each as far as the same joints move, or as its curvature lets.

The velocities f of the joints that move are nearly linear in their angles. A leg follows the
linear motion from where it begins, in closed form; what f is at its end beside that, is taken to
have come with the square of time, and corrects it. That is the exponential Rosenbrock method of
order 3 with its estimate of the error of order 2: Hochbruck, Ostermann and Schweitzer,
"Exponential Rosenbrock-type methods", SIAM J. Numer. Anal. 47 (2009). No stiffness shortens it,
and since the way is known at all times, so is when another joint comes to its limit, one falls
below it, or one meets its stop.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .excess import Look
from .linear_motion import LinearMotion, Path
from .motion import TOLERANCE, Motion
from .rest import NEAR

Floats = NDArray[np.float64]

FAR = 0.3
"""Way in rad of a leg at the most"""

LEG_ERROR = 1e-4
"""Error of one leg in rad that is accepted, as estimated: of an order less, so far too large"""

ALONG = 0.3
"""Share of the way by which a leg may be too long or too short, since how fast it goes is of no
account"""

SMALL = 1e-3
"""Share of the fastest joint's velocity by which another may seem to fall below its limit"""

JUST_BEYOND = 0.02
"""Share of an interval of time by which a leg goes beyond where other joints move, so that they
do"""

RATIO = 1.2
"""Of one time that is looked at to that before it"""

MOST_SPAN = 1e9
"""Of the last time that is looked at to the first"""

MOST_TRIALS = 40

PARTS = np.arange(0, 23) / 20.0
"""Of a leg, that are looked at once it is known how it bends, and a little beyond"""


class Leg:
    """A leg of a motion that is about to be gone.

    Parameters
    ----------
    motion : Motion
        Where it is.
    far : float
        Way in rad that it may be long at the most.

    Attributes
    ----------
    linear : LinearMotion
        The motion, as it is where the leg begins.
    may_rest : bool
        Whether a place of rest is near, were the motion linear.
    time : float
        When other joints move then, before; else when it is far. Infinite if it never is.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the numbers of the motion are not finite.
    """

    def __init__(self, motion: Motion, far: float) -> None:
        self._motion = motion
        rows = motion.jacobian_rows()
        self.jacobian: Floats = rows[list(motion.moving)]
        self.linear = LinearMotion(self.jacobian, motion.velocity(motion.look))
        self._changes = _Changes(motion, rows)
        reach = abs(self.linear.to_rest).max()
        self.may_rest = bool(self.linear.growth < 0.0 and reach <= NEAR)
        if self.may_rest:
            times = np.concatenate(([0.0], self.linear.times(MOST_SPAN, RATIO)))
            self.time = self._changes.first(self.linear.path(times))
        else:
            self.time = self.linear.far(far)

    def go(self) -> float:
        """Go the leg; return how far in rad the next may be tried, 0 if this was not gone."""
        motion, linear = self._motion, self.linear
        end = min(self.time, linear.lifetime)
        for _ in range(MOST_TRIALS):
            way, velocity = linear.at(end)
            if not abs(way).max() <= 2.0 * FAR:
                end *= 0.1
                continue
            look = motion.after(way)
            remainder = motion.velocity(look) - velocity
            bend, faster = linear.bend(end, remainder)
            error = _amiss(bend, way, velocity + faster)
            if error <= 1.0:
                break
            end *= max(0.1, 0.9 * error ** (-1.0 / 3.0)) if error < math.inf else 0.1
        else:
            return 0.0
        far: float = float(abs(way).max()) * 0.9 * max(error, 1e-12) ** (-1.0 / 3.0)
        if abs(bend).max() > TOLERANCE:
            resting = self._changes.remainder(look, way)
            path = linear.path(end * PARTS, remainder, end)
            time = self._changes.first(path, resting, end)
            time = end if time == math.inf else time
            bend, _ = linear.bend(time, (time / end) ** 2 * remainder)
            look = motion.after(linear.at(time)[0] + bend)
        motion.take(look)
        motion.change()
        return min(FAR, far)


def _amiss(bend: Floats, way: Floats, velocity: Floats) -> float:
    """Return the error of the linear motion, as a share of what is accepted.

    Along the motion it counts less: how fast it goes is of no account.
    """
    square = float(velocity @ velocity)
    along = (float(bend @ velocity) / square if square > 0.0 else 0.0) * velocity
    aside = float(abs(bend - along).max()) / LEG_ERROR
    return max(aside, float(abs(along).max() / (ALONG * abs(way + bend).max())))


class _Changes:
    """What tells where on a path other joints move than at its start."""

    def __init__(self, motion: Motion, rows: Floats) -> None:
        moving = list(motion.moving)
        sides = np.array(list(motion.moving.values()))
        angles = np.array([motion.look.angles[joint] for joint in moving])
        to_go = np.array([motion.stops[joint] for joint in moving]) - sides * angles
        if motion.rubs:  # to where it is straight, if it has that before it
            to_go = np.where(sides * angles < 0.0, -sides * angles, to_go)
        self._sides, self._to_go = sides[:, None], to_go[:, None]
        self._resting = resting = motion.resting()
        ahead = np.array([side for side, _ in resting.values()]).reshape(-1, 1)
        self._rows = ahead * rows[list(resting)]
        self._excess = np.array([excess for _, excess in resting.values()])

    def remainder(self, look: Look, way: Floats) -> Floats:
        """Return by how much the excess of joints at rest is more than linear."""
        found = np.array(
            [side * look.velocity(joint, side) for joint, (side, _) in self._resting.items()]
        )
        return np.asarray(found - self._excess - self._rows @ way, np.float64)

    def first(
        self,
        path: Path,
        remainder: Floats | None = None,
        end: float = 1.0,
    ) -> float:
        """Return the first time at which other joints move, just on the far side.

        Infinite if there is none.

        Parameters
        ----------
        remainder, end : array, float
            What `remainder` says of the end of the leg, and when that is.
        """
        times, ways, velocities, accelerations = path
        fastest = abs(velocities).max(axis=0)
        sides = self._sides
        ahead = sides * ways
        falls = -sides * velocities - SMALL * fastest
        back = (np.maximum.accumulate(ahead, axis=1) - ahead).max(axis=1, keepdims=True)
        falls = np.where((sides * accelerations < 0.0) & (back > TOLERANCE), falls, -fastest)
        parts = [falls, ahead - self._to_go]
        if len(self._excess):
            excess = self._rows @ ways + self._excess[:, None]
            if remainder is not None:
                excess += remainder[:, None] * (times / end) ** 2
            parts.append(excess)
        signals = np.concatenate(parts)
        there = np.flatnonzero((signals[:, 1:] > 0.0).any(axis=0))
        if not len(there):
            return math.inf
        place = int(there[0]) + 1
        happens = signals[:, place] > 0.0
        was, now = signals[happens, place - 1], signals[happens, place]
        shares = np.where(was < 0.0, was / (was - now), 1.0)
        share = min(float(shares.min()) + JUST_BEYOND, 1.0)
        before = times[place - 1]
        return float(before + share * (times[place] - before))
