"""How the joints of an arm slip, together, until all are at rest.

The rule for several joints at once: equal viscosity in every joint, taken to zero. A joint beyond
its limit moves with

    θ' = f = ±(|M| − K),

to the side to which it is driven, all others rest. How fast is of no account, only where it ends.
The cables and the dead load do the work ∫ M dθ, of which friction takes up at least K all along,
so the way of all joints together is bounded, and the arm comes to rest.

The motion is smooth while it is the same joints that move. It is followed so, step by step, and
each step ends where another joint comes to its limit, one falls below it, or one meets its stop.
Where what is left to go is as good as linear, it is gone in one go: up to the next such event, or
if there is none, to rest, where M = K of those that move is solved by Newton's method.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .excess import Excess, Look
from .linear_motion import LinearMotion
from .rosenbrock import cubic_path, rosenbrock_step

Floats = NDArray[np.float64]

ROUNDING = 1e-11
"""Share of K by which M may exceed it at rest"""

NOTHING = 1e-9
"""Share of K by which M may exceed it where rounding would decide"""

STEP_ERROR = 1e-4
"""Error of one step in rad that is accepted, as estimated: of an order less, so far too large"""

TOLERANCE = 1e-5
"""How exactly in rad a step ends where it has to"""

STRAIGHT = 1e-4
"""How exactly in rad a step ends where a joint with friction of the cables comes to be straight,
where its guides let no tension be but the one before them"""

JUST_BEYOND = 0.01
"""Share of a step by which it is to go beyond where other joints move, so that they do"""

NEAR = 0.02
"""Way in rad from the place of rest, were the motion linear, within which this is tried"""

BARELY = 1e-4
"""Way in rad from a place of rest that is left, where a joint is so slow at first that this is
tried too"""

TINY = 1e-6
"""Way in rad that is left to Newton's method in any case"""

SMALL = 1e-3
"""Share of the fastest joint's velocity by which another may seem to fall below its limit"""

FIRST_WAY = 1e-2
"""Way in rad of the fastest joint in the first step that is tried"""

MOST_STEPS = 5000


def _solved(matrix: Floats, values: Floats) -> Floats:
    """Solve a linear equation; infinite where it cannot be."""
    try:
        return np.asarray(np.linalg.solve(matrix, values), np.float64)
    except np.linalg.LinAlgError:
        return np.full(len(values), math.inf)


def _growth(jacobian: Floats) -> float:
    """The fastest rate at which the motion grows; below zero where it dies away."""
    # No eigenvalue is to the right of the discs about the diagonal.
    diagonal = np.asarray(np.diagonal(jacobian))
    bound = float((diagonal + abs(jacobian).sum(axis=1) - abs(diagonal)).max())
    if bound < 0.0 or len(jacobian) == 1:
        return bound
    return float(np.linalg.eigvals(jacobian).real.max())


@dataclass
class Settled:
    """Where an arm has come to rest."""

    look: Look
    at_limit: dict[int, float] = field(default_factory=dict)
    """Joints that came to rest with M = K → the side to which they were driven"""
    moved: set[int] = field(default_factory=set)
    """All joints that have slipped"""


def settle(excess: Excess, angles: list[float]) -> Settled:
    """Let an arm slip from bend angles in rad until it is at rest.

    Raises
    ------
    ArithmeticError
        If it does not come to rest, which would contradict the model.
    """
    return _Flow(excess, angles).run()


class _Flow:
    def __init__(self, excess: Excess, angles: list[float]) -> None:
        self._excess, self._stops = excess, excess.arm.stops
        self._rubs = excess.arm.cable_friction_coefficient > 0.0
        self._look = excess.at(angles)
        self._start = self._look.angles
        self._moving: dict[int, float] = {}
        self._at_limit: dict[int, float] = {}
        self._from: dict[int, float] = {}
        """Where each of those that move was when it began to"""
        self._undecided: set[int] = set()
        """Joints that rounding alone would move"""
        self._free()

    def run(self) -> Settled:
        step = 0.0
        for _ in range(MOST_STEPS):
            if not self._moving:
                pairs = zip(self._start, self._look.angles, strict=True)
                moved = {joint for joint, (old, new) in enumerate(pairs) if old != new}
                return Settled(self._look, self._at_limit, moved)
            velocity = self._velocity(self._look)
            jacobian = self._excess.jacobian(self._look, self._moving, list(self._moving))
            growth = _growth(jacobian)
            if growth and self._go_on(velocity, jacobian, growth):
                continue
            fastest = float(abs(velocity).max())
            step = step or FIRST_WAY / fastest
            if growth > 0.0:  # a longer one would take what grows for what has died away
                step = min(step, 1.0 / growth)
            step = self._advance(velocity, jacobian, step)
        raise ArithmeticError('the arm does not come to rest')

    def _velocity(self, look: Look) -> Floats:
        return np.array([look.velocity(i, side) for i, side in self._moving.items()])

    def _after(self, way: Floats) -> Look:
        """Look at the arm with the moving joints moved on."""
        angles = list(self._look.angles)
        for joint, by in zip(self._moving, way.tolist(), strict=True):
            angles[joint] += by
        return self._excess.at(angles)

    def _take(self, look: Look) -> None:
        self._excess.remember(look)
        self._look = look

    def _free(self) -> bool:
        """Set moving what is beyond its limit and not before its stop; whether there is any."""
        found = False
        for joint in range(len(self._stops)):
            if joint in self._moving:
                continue
            side, excess, capacity = self._look.drive(joint)
            angle = self._look.angles[joint]
            too_much = NOTHING if joint in self._undecided else ROUNDING
            if excess > too_much * capacity and not side * angle >= self._stops[joint]:
                self._moving[joint] = side
                self._from[joint] = angle
                found = True
        return found

    # Step by step

    def _advance(self, velocity: Floats, jacobian: Floats, step: float) -> float:
        """Go one step on, as long as is right; return what the next may be."""
        tried = step
        while True:
            try:
                way, error = rosenbrock_step(
                    lambda way: self._velocity(self._after(way)), velocity, jacobian, step
                )
                worst = float(abs(error).max()) / STEP_ERROR
            except np.linalg.LinAlgError:
                worst = math.inf
            if not worst <= 1.0:
                step *= max(0.2, 0.9 * worst ** (-1.0 / 3.0)) if math.isfinite(worst) else 0.1
                tried = step
                continue
            after = self._after(way)
            share = self._until(after, velocity, jacobian, step)
            if share < 1.0:
                path = cubic_path(way, step * velocity, step * self._velocity(after))
                if path is None:  # rushed through, so that only a shorter step tells
                    step *= max(share, 1e-3)
                    continue
                part = 1.0
                while share < 1.0:
                    part *= min(share + JUST_BEYOND, 1.0 - JUST_BEYOND)
                    after = self._after(path(part))
                    share = self._until(after, velocity, jacobian, part * step)
            self._take(after)
            self._change()
            growth: float = 0.9 * max(worst, 1e-6) ** (-1.0 / 3.0)
            return tried * min(6.0, growth)

    def _until(self, after: Look, velocity: Floats, jacobian: Floats, step: float) -> float:
        """Return the share of a step after which the joints that move are no longer the same.

        It is 1 where they are to its end, or nearly.
        """
        found = 1.0
        for place, (joint, side) in enumerate(self._moving.items()):
            start, end, stop = self._look.angles[joint], after.angles[joint], self._stops[joint]
            beyond = side * end - stop
            if beyond > TOLERANCE:
                found = min(found, (stop - side * start) / (side * (end - start)))
            if self._rubs and min(-side * start, side * end) > STRAIGHT:
                found = min(found, start / (start - end))
            left = side * after.velocity(joint, side)
            if self._counts(-left, step, jacobian[place, place]):
                was = side * float(velocity[place])
                found = min(found, was / (was - left) if was > 0.0 else 0.0)
        for joint in range(len(self._stops)):
            if joint in self._moving:
                continue
            side, excess, capacity = after.drive(joint)
            if side * after.angles[joint] >= self._stops[joint]:
                continue
            if excess > ROUNDING * capacity and self._counts(excess, step, 0.0):
                _, was, _ = self._look.drive(joint)
                found = min(found, -was / (excess - was) if was < 0.0 else 1.0)
        return found

    def _counts(self, excess: float, step: float, slope: float) -> bool:
        """Whether a joint would go somewhere in a step with an excess that it should not have."""
        rate = max(1.0 / step, abs(slope))
        return excess > TOLERANCE * rate

    def _change(self) -> None:
        """Stop what has met its stop or falls below its limit, and free what has come to it."""
        sides = np.array(list(self._moving.values()))
        velocity = self._velocity(self._look)
        falls = sides * velocity < 0.0
        if falls.any():
            # Not what has only overshot the place at which it comes to rest.
            jacobian = self._excess.jacobian(self._look, self._moving, list(self._moving))
            falls &= sides * (jacobian @ velocity) < 0.0
        angles, stopped = list(self._look.angles), False
        for (joint, side), is_falling in zip(list(self._moving.items()), falls, strict=True):
            if side * angles[joint] >= self._stops[joint] - TOLERANCE:
                angles[joint] = side * self._stops[joint]
                stopped = True
                del self._moving[joint]
            elif is_falling:
                del self._moving[joint]
        if stopped:
            self._take(self._excess.at(angles))
        self._at_limit = {}
        self._free()

    # In one go

    def _go_on(self, velocity: Floats, jacobian: Floats, growth: float) -> bool:
        """Go as far as the same joints move, if the motion is as good as linear; whether it was.

        If they come to rest, none is left moving but those at their limit.
        """
        rest = -_solved(jacobian, velocity)
        reach = abs(rest).max()
        if not reach <= (NEAR if growth < 0.0 else BARELY):
            return False
        if reach > TINY or growth > 0.0:
            try:
                motion = LinearMotion(jacobian, velocity)
            except np.linalg.LinAlgError:
                return False
            time = motion.first(self._changes(motion, jacobian))
            if not math.isinf(time):
                return self._leg(motion, time)
        return self._end(rest, jacobian)

    def _leg(self, motion: LinearMotion, time: float) -> bool:
        """Go on to where the joints that move are no longer the same."""
        ways, velocities = motion.at(np.array([time]))
        after = self._after(ways[:, 0])
        found = self._velocity(after)
        fastest = max(abs(motion.velocity).max(), abs(found).max())
        amiss = abs(found - velocities[:, 0]).max() / fastest * abs(ways).max()
        if not amiss <= TOLERANCE:
            return False
        self._take(after)
        self._change()
        return True

    def _end(self, way: Floats, jacobian: Floats) -> bool:
        """Go to where M = K for all that move."""
        total = np.zeros(len(way))
        for index in range(12):
            total = total + way
            if not abs(total).max() <= 2.0 * NEAR:
                return False
            look = self._after(total)
            if any(abs(look.angles[i]) > self._stops[i] for i in self._moving):
                return False
            velocity = self._velocity(look)
            if self._is_small(velocity, look):
                if self._goes_back(look):
                    return True
                self._take(look)
                self._at_limit = dict(self._moving)
                self._moving.clear()
                self._free()
                if self._moving:
                    self._moving |= self._at_limit
                return True
            if index:
                jacobian = self._excess.jacobian(look, self._moving, list(self._moving))
            way = -_solved(jacobian, velocity)
            if index == 0 and not abs(way).max() <= TOLERANCE:
                return False
        return False

    def _goes_back(self, look: Look) -> bool:
        """Let rest what would end behind where it began to move; whether there is any.

        That is a joint which is beyond its limit by rounding alone while another moves.
        """
        behind = [
            joint
            for joint, side in self._moving.items()
            if side * (look.angles[joint] - self._from[joint]) < 0.0
        ]
        if not behind:
            return False
        angles = list(self._look.angles)
        for joint in behind:
            angles[joint] = self._from[joint]
            del self._moving[joint]
        self._undecided |= set(behind)
        self._take(self._excess.at(angles))
        return True

    def _changes(
        self, motion: LinearMotion, jacobian: Floats
    ) -> Callable[[Floats], NDArray[np.bool_]]:
        """Return whether, at some times of a motion, other joints move than at its start."""
        moving, look = list(self._moving), self._look
        sides = np.array([self._moving[joint] for joint in moving])[:, None]
        to_go = np.array(
            [self._stops[joint] - self._moving[joint] * look.angles[joint] for joint in moving]
        )[:, None]
        if self._rubs:
            to_straight = np.array([-self._moving[joint] * look.angles[joint] for joint in moving])
            to_go = np.where(to_straight > 0.0, to_straight, to_go[:, 0])[:, None]
        resting, lacking = {}, []
        for joint in range(len(self._stops)):
            if joint not in self._moving:
                side, excess, _ = look.drive(joint)
                if side * look.angles[joint] < self._stops[joint]:
                    resting[joint] = side
                    lacking.append(excess)
        signs = np.array(list(resting.values()))[:, None]
        rows = signs * self._excess.jacobian(look, resting, moving) if resting else None

        def changes(times: Floats) -> NDArray[np.bool_]:
            ways, velocities = motion.at(times)
            falls = sides * velocities < -SMALL * abs(velocities).max(axis=0)
            falls &= sides * (jacobian @ velocities) < 0.0
            found: NDArray[np.bool_] = (falls | (sides * ways >= to_go)).any(axis=0)
            found |= abs(ways).max(axis=0) > 2.0 * NEAR
            if rows is not None:
                found |= (np.array(lacking)[:, None] + rows @ ways > 0.0).any(axis=0)
            return found

        return changes

    def _is_small(self, velocity: Floats, look: Look) -> bool:
        return all(
            abs(excess) <= 0.01 * ROUNDING * look.capacity(joint, side)[0]
            for (joint, side), excess in zip(self._moving.items(), velocity.tolist(), strict=True)
        )
