"""A motion leg by leg: each as far as the same joints move, or as its curvature lets.

The velocities f of the joints that move are nearly linear in their angles. A leg follows the
linear motion from where it begins, in closed form. If what f is at its end beside that counts at
all, f is looked at on three quarters of the way, its remainder there is taken to have come with
the square of time, and corrects the way; the remainder that is then left at the end tells the
error. That is an exponential Rosenbrock method of order 4, with an estimate of the error of order
3: Luan, "Fourth-order two-stage explicit exponential integrators for time-dependent PDEs", Appl.
Numer. Math. 112 (2017), and Hochbruck, Ostermann and Schweitzer, "Exponential Rosenbrock-type
methods", SIAM J. Numer. Anal. 47 (2009). No stiffness shortens it, and since the way is known at
all times, so is when another joint comes to its limit, one falls below it, or one meets its stop.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .linear_motion import END, NODE, SQUARES, LinearMotion, Path, largest
from .look import Look
from .motion import TOLERANCE, Motion
from .rest import NEAR

Floats = NDArray[np.float64]

FAR = 0.3
"""Way in rad of a leg at the most"""

LEG_ERROR = 1e-4
"""Error of one leg in rad that is accepted, as estimated: of an order less, so too large"""

ALONG = 0.3
"""Share of the way by which a leg may be too long or too short, since how fast it goes is of no
account"""

SMALL = 1e-3
"""Share of the fastest joint's velocity by which another may seem to fall below its limit"""

JUST_BEYOND = 0.1
"""Share of an interval of time by which a leg goes beyond where other joints move, so that they
do"""

EARLY = 0.2
"""Share of a leg in which the path tells too roughly when other joints move"""

MOST_CLOSER = 4
"""How often that is looked at more closely: what moves at once is always early"""

MOST_TRIALS = 40


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
    rest_time : float
        When other joints move then, before that; infinite if none does, or it may not.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the numbers of the motion are not finite.
    """

    def __init__(self, motion: Motion, far: float) -> None:
        self._motion, self._far = motion, far
        self._sides = motion.sides()
        self._rows = motion.slopes(self._sides).take(list(motion.moving), 1)
        self.jacobian: Floats = self._rows.take(list(motion.moving), 0)
        self.linear = LinearMotion(self.jacobian, motion.velocity(motion.look))
        reach = largest(self.linear.to_rest)
        self.may_rest = self.linear.growth < 0.0 and reach <= NEAR
        self.rest_time = math.inf
        if self.may_rest:
            self.rest_time = self._changes.first(self.linear.path(self.linear.times()))

    @cached_property
    def _changes(self) -> _Changes:
        return _Changes(self._motion, self._sides, self._rows)

    def go(self) -> float:
        """Go the leg; return how far in rad the next may be tried, 0 if this was not gone."""
        motion, linear = self._motion, self.linear
        time = self.rest_time if self.may_rest else linear.far(self._far)
        end, error = min(time, linear.lifetime), 0.0
        for trial in range(MOST_TRIALS):
            way = linear.way(end)
            if not largest(way) <= 2.0 * FAR:
                end *= 0.1
                continue
            if self.may_rest:  # so that nothing changes before the end, were the motion linear
                look = motion.after(way)
                bend = linear.bend(end, motion.velocity(look) - linear.velocity_at(way))
                if largest(bend) <= LEG_ERROR:
                    break
            course = linear.course(end)
            node = motion.after(course.node)
            remainder = motion.velocity(node) - linear.velocity_at(course.node)
            remainder /= SQUARES[NODE]
            time, way = self._changes.first_way(course.bent(remainder), course.node, node)
            if time < EARLY * end and trial < MOST_CLOSER:
                end = 2.0 * time
                continue
            look = motion.after(way)
            velocity = linear.velocity_at(way) + (time / end) ** 2 * remainder
            error = self._amiss(time, way, velocity, motion.velocity(look) - velocity)
            if error <= 1.0:
                break
            end = time * (max(0.1, 0.9 * error**-0.25) if error < math.inf else 0.1)
        else:
            return 0.0
        motion.take(look)
        motion.change()
        far: float = 0.9 * largest(way) * max(error, 1e-4) ** -0.25
        return min(FAR, far)

    def _amiss(self, time: float, way: Floats, velocity: Floats, defect: Floats) -> float:
        """Return the error of a way, as a share of what is accepted, from that of its velocity."""
        bend = self.linear.bend(time, defect)
        aside, along = aside_and_along(bend.tolist(), velocity.tolist())
        return max(aside / LEG_ERROR, along / (ALONG * largest(way)))


def aside_and_along(error: list[float], velocity: list[float]) -> tuple[float, float]:
    """Return how large in rad an error is across the motion, and along it.

    Along it counts less: how fast it goes is of no account.
    """
    square = sum([v * v for v in velocity])
    share = sum([e * v for e, v in zip(error, velocity, strict=True)]) / square if square else 0.0
    aside = [abs(e - share * v) for e, v in zip(error, velocity, strict=True)]
    return max(aside), abs(share) * max(map(abs, velocity))


class _Changes:
    """What tells where on a path other joints move than at its start."""

    def __init__(self, motion: Motion, sides: dict[int, float], rows: Floats) -> None:
        look, moving = motion.look, motion.moving
        self._resting: dict[int, float] = {}
        # Of every joint what is above zero once it has happened: the excess of one at rest, the
        # way beyond its stop of one that moves. How that is at first, and how it goes by the way.
        at_first = []
        for joint, side in sides.items():
            ahead = side * look.angles[joint]
            if joint in moving:
                # With friction of cables to where it is straight, if it has that before its stop.
                straight = motion.rubs and ahead < 0.0
                at_first.append(ahead if straight else ahead - motion.stops[joint])
            elif motion.lean_on_stop(joint, side):
                at_first.append(-math.inf)
            else:
                self._resting[joint] = side
                at_first.append(look.drive(joint)[1])
        self._at_first: Floats = np.array(at_first)[:, None]
        self._by_way: Floats = np.array(list(sides.values()))[:, None] * rows
        self._by_way[list(moving)] = 0.0
        self._by_way[list(moving), range(len(moving))] = list(moving.values())
        self._sides: Floats = np.array(list(moving.values()))[:, None]

    def first(self, path: Path) -> float:
        """Return the first time at which other joints move, were the motion linear.

        Just on the far side; infinite if there is none.
        """
        found = self._first(path, self._at_first + self._by_way @ path.ways)
        return math.inf if found is None else found[0]

    def first_way(self, path: Path, way: Floats, look: Look) -> tuple[float, Floats]:
        """Return time and way to where other joints move first, just on the far side.

        To the end if there is none.

        Parameters
        ----------
        path : Path
            Of a whole leg, at its `PARTS`.
        way, look : array, Look
            At its `NODE`, were the motion linear.
        """
        signals = self._at_first + self._by_way @ path.ways
        resting = list(self._resting)
        if resting:  # what is not linear in their excess is taken to come with the square of time
            sides = np.array(list(self._resting.values()))
            linear = self._at_first[resting, 0] + self._by_way[resting] @ way
            remainder = sides * look.velocities(self._resting) - linear
            signals[resting] += remainder[:, None] * (SQUARES / SQUARES[NODE])
        found = self._first(path, signals)
        if found is None:
            return float(path.times[END]), path.ways[:, END]
        return found[0], path.way(*found)

    def _first(self, path: Path, signals: Floats) -> tuple[float, int] | None:
        """Return when the first change is, and the place in the path's times after it."""
        times, ways, velocities = path
        happened = signals[:, 1:] > 0.0
        there = happened.any(axis=0)
        forwards = self._sides * velocities
        if forwards.min() < 0.0:
            below = -SMALL * abs(velocities).max(axis=0) - forwards
            ahead = self._sides * ways
            back = (np.maximum.accumulate(ahead, axis=1) - ahead).max(axis=1, keepdims=True)
            falls = (below[:, 1:] > 0.0) & (below[:, 1:] > below[:, :-1]) & (back > TOLERANCE)
            there |= falls.any(axis=0)
        if not there.any():
            return None
        place, share = int(there.argmax()) + 1, 1.0
        happens = happened[:, place - 1]
        if happens.any():
            was, now = signals[happens, place - 1], signals[happens, place]
            shares = np.ones_like(was)
            np.divide(was, was - now, out=shares, where=was < 0.0)
            share = min(float(shares.min()) + JUST_BEYOND, 1.0)
        before = times[place - 1]
        return float(before + share * (times[place] - before)), place
