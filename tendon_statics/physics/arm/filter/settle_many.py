"""Many arms that slip until all their joints are at rest: `flow` in arrays.

By the same rule and the same method as one arm: each member goes its own steps, which end where
other joints move, but all members take one at the same time. That costs a fortieth of following
them one by one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..flow import FIRST_WAY
from ..motion import NOTHING, ROUNDING, TOLERANCE
from ..steps import JUST_BEYOND, STEP_ERROR, STRAIGHT
from .glide import glide, of_moving, times
from .many import Look, Pulled

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

MOST_STEPS = 100
"""After which what is not at rest is followed by `flow` itself"""

MOST_CUTS = 8
"""Of one step, to where other joints move"""


class Settled(NamedTuple):
    """Where arms have come to rest."""

    angles: Floats
    """In rad, shape ``(arms, joints)``"""
    at_joints: Floats | None
    """Tensions in N there, of cables with friction"""
    at_rest: Flags
    """Which arms are; of the others it says nothing"""


def settle_many(pulled: Pulled, angles: Floats) -> Settled:
    """Let arms slip from bend angles in rad until they are at rest."""
    motion = _Motions(pulled, angles)
    for _ in range(MOST_STEPS):
        which = np.flatnonzero(motion.moving.any(axis=1))
        if not len(which):
            break
        motion.go_on(which)
    at_rest = ~motion.moving.any(axis=1)
    return Settled(motion.angles, motion.at_joints, at_rest)


class _Motions:
    """Arms on their way to rest, as `Motion` has one.

    Attributes
    ----------
    angles : ndarray
        Where they are, shape ``(arms, joints)``; so is all else.
    at_joints : ndarray
        What the friction of the cables remembers.
    moving : ndarray
        Which joints move, to `sides`, since they were at `begun`.
    """

    def __init__(self, pulled: Pulled, angles: Floats) -> None:
        self._pulled = pulled
        look = pulled.look(angles)
        self.angles, self.at_joints = angles.copy(), look.drawn.at
        self.moving, self.sides, self.begun = look.beyond(), look.sides, angles.copy()
        self._share = np.full(angles.shape, ROUNDING)  # of K, by which M may exceed it
        self._step = np.full(len(angles), np.nan)

    def go_on(self, which: NDArray[np.intp]) -> None:
        """Let some arms go on: to rest, if it is near, else by one step."""
        pulled = self._pulled.part(which, self.at_joints)
        moving = self.moving[which]
        look = pulled.look(self.angles[which], np.where(moving, self.sides[which], 0.0))
        glided = glide(pulled, look, moving, self.begun[which])
        rested = which[glided.at_rest]
        self._take(rested, glided.look, glided.at_rest)
        self.moving[rested] = False
        if glided.behind.any():
            self._let_rest(which, glided.behind)
        rest = ~glided.at_rest & ~glided.behind.any(axis=1)
        if rest.any():
            self._step_on(which[rest], pulled, look, rest)

    def _take(self, which: NDArray[np.intp], look: Look, rows: Flags) -> None:
        self.angles[which] = look.angles[rows]
        if self.at_joints is not None:
            assert look.drawn.at is not None
            self.at_joints[which] = look.drawn.at[rows]

    def _let_rest(self, which: NDArray[np.intp], behind: Flags) -> None:
        """Let rest where they began what is beyond its limit by rounding alone."""
        rows, joints = np.nonzero(behind)
        rows = which[rows]
        self.angles[rows, joints] = self.begun[rows, joints]
        self.moving[rows, joints] = False
        self._share[rows, joints] = NOTHING
        self._free(which[behind.any(axis=1)])

    def _step_on(self, which: NDArray[np.intp], pulled: Pulled, look: Look, rows: Flags) -> None:
        """Let some arms go one step of a Rosenbrock method, as `rosenbrock` and `steps` do."""
        if not rows.all():
            pulled = pulled.part(rows)
            look = pulled.look(
                look.angles[rows], np.where(self.moving[which], look.sides[rows], 0.0)
            )
        moving = self.moving[which]
        joints = np.flatnonzero(moving.any(axis=0))
        moves = moving[:, joints]
        sides, angles = np.where(moving, look.sides, 0.0), look.angles
        jacobian = of_moving(look.jacobian(joints)[:, joints], moves, 0.0)
        velocity = _velocity(look, joints, moves)
        step = self._step[which]
        with np.errstate(all='ignore'):
            step = np.where(np.isnan(step), FIRST_WAY / np.abs(velocity).max(axis=1), step)
            diagonal = np.diagonal(jacobian, axis1=1, axis2=2)
            growth = (diagonal + np.abs(jacobian).sum(axis=2) - np.abs(diagonal)).max(axis=1)
            step = np.where(growth > 0.0, np.minimum(step, 1.0 / growth), step)

        def after(way: Floats) -> Look:
            there = angles.copy()
            there[:, joints] += way
            return pulled.look(there, sides)

        way, error = _rosenbrock(after, joints, moves, velocity, jacobian, step)
        worst = np.abs(error).max(axis=1) / STEP_ERROR
        good = worst <= 1.0
        with np.errstate(all='ignore'):
            shorter = np.where(
                np.isfinite(worst), np.maximum(0.2, 0.9 * worst ** (-1.0 / 3.0)), 0.1
            )
            longer = np.minimum(6.0, 0.9 * np.maximum(worst, 1e-6) ** (-1.0 / 3.0))
        self._step[which] = step * np.where(good, longer, shorter)
        way = np.where(good[:, None], way, 0.0)
        there = after(way)
        slope = np.where(moves, np.diagonal(jacobian, axis1=1, axis2=2), 0.0)
        until = _Until(look, moving, joints, velocity, slope)
        share = np.where(good, until.share(there, step), 1.0)
        if (share < 1.0).any():
            start, end = velocity * step[:, None], _velocity(there, joints, moves) * step[:, None]
            most = np.maximum(np.abs(start).max(axis=1), np.abs(end).max(axis=1))
            rushed = (share < 1.0) & (most > 3.0 * np.abs(way).max(axis=1))
            self._step[which[rushed]] = (step * np.maximum(share, 1e-3))[rushed]
            good &= ~rushed
            whole, part = way, np.ones(len(way))
            for _ in range(MOST_CUTS):
                cut = good & (share < 1.0)
                if not cut.any():
                    break
                part = np.where(
                    cut, part * np.minimum(share + JUST_BEYOND, 1.0 - JUST_BEYOND), part
                )
                way = np.where(cut[:, None], _cubic(whole, start, end, part[:, None]), way)
                there = after(np.where(good[:, None], way, 0.0))
                share = np.where(cut, until.share(there, part * step), 1.0)
        taken = which[good]
        self._take(taken, there, good)
        self._change(taken, there, joints, good)

    def _change(
        self, which: NDArray[np.intp], look: Look, joints: NDArray[np.intp], rows: Flags
    ) -> None:
        """Stop what has met its stop or falls below its limit, and free what has come to it."""
        moving, sides = self.moving[which], look.sides[rows]
        angles, begun = look.angles[rows], self.begun[which]
        stops = np.broadcast_to(look.arms.stops, angles.shape)
        falls = moving & (look.excess[rows] < 0.0)
        if falls.any():
            moves = moving[:, joints]
            jacobian = of_moving(look.jacobian(joints)[:, joints][rows], moves, 0.0)
            velocity = np.where(moves, (sides * look.excess[rows])[:, joints], 0.0)
            falls[:, joints] &= sides[:, joints] * times(jacobian, velocity) < 0.0
        back = moving & (sides * (angles - begun) < 0.0)
        at_stop = moving & ~back & (sides * angles >= stops - TOLERANCE)
        self.angles[which] = np.where(back, begun, np.where(at_stop, sides * stops, angles))
        self.moving[which] = moving & ~(back | at_stop | falls)
        self._free(which)

    def _free(self, which: NDArray[np.intp]) -> None:
        """Set moving what is beyond its limit and not before its stop."""
        look = self._pulled.part(which, self.at_joints).look(self.angles[which])
        if self.at_joints is not None:
            assert look.drawn.at is not None
            self.at_joints[which] = look.drawn.at
        moving = self.moving[which]
        freed = look.beyond(self._share[which]) & ~moving
        self.moving[which] = moving | freed
        self.sides[which] = np.where(moving, self.sides[which], look.sides)
        self.begun[which] = np.where(freed, look.angles, self.begun[which])


class _Until:
    """After which share of a step the joints that move are no longer the same, as in `steps`."""

    def __init__(
        self, look: Look, moving: Flags, joints: NDArray[np.intp], velocity: Floats, slope: Floats
    ) -> None:
        self._look, self._moving, self._rubs = look, moving, look.arms.friction > 0.0
        self._was = np.zeros(moving.shape)
        self._was[:, joints] = look.sides[:, joints] * velocity
        self._slope = np.zeros(moving.shape)
        self._slope[:, joints] = np.abs(slope)

    def share(self, after: Look, step: Floats) -> Floats:
        """Return the share; 1 where they are the same to the end of a step, or nearly."""
        look, moving = self._look, self._moving
        sides, start, end = look.sides, look.angles, after.angles
        stops, was = look.arms.stops, self._was
        found = np.ones(moving.shape)
        with np.errstate(all='ignore'):
            arrives = moving & (sides * end - stops > TOLERANCE)
            if arrives.any():
                met = (stops - sides * start) / (sides * (end - start))
                found = np.where(arrives, np.minimum(found, met), found)
            if self._rubs:
                straight = moving & (np.minimum(-sides * start, sides * end) > STRAIGHT)
                found = np.where(straight, np.minimum(found, start / (start - end)), found)
            rate = np.maximum(1.0 / step[:, None], self._slope)
            falls = moving & (-after.excess > TOLERANCE * rate)
            if falls.any():
                fallen = np.where(was > 0.0, was / (was - after.excess), 0.0)
                found = np.where(falls, np.minimum(found, fallen), found)
            freed = ~moving & after.beyond() & (after.excess > TOLERANCE / step[:, None])
            if freed.any():
                before = look.excess
                come = np.where(before < 0.0, before / (before - after.excess), 1.0)
                found = np.where(freed, np.minimum(found, come), found)
        least: Floats = found.min(axis=1)
        return np.where(np.isnan(least), 0.0, least)


def _velocity(look: Look, joints: NDArray[np.intp], moves: Flags) -> Floats:
    """M − side K of the joints that move, in N m."""
    found: Floats = np.where(moves, (look.sides * look.excess)[:, joints], 0.0)
    return found


def _rosenbrock(
    after: Callable[[Floats], Look],
    joints: NDArray[np.intp],
    moves: Flags,
    velocity: Floats,
    jacobian: Floats,
    step: Floats,
) -> tuple[Floats, Floats]:
    """Return the way of one step and its error, as `rosenbrock_step` does."""
    size = step[:, None]
    with np.errstate(all='ignore'):
        matrix = np.eye(len(joints)) * (2.0 / size)[:, :, None] - jacobian
        good = np.isfinite(matrix).all(axis=(1, 2))
        matrix = np.where(good[:, None, None], matrix, np.eye(len(joints)))
        try:
            inverse = np.linalg.inv(matrix)
        except np.linalg.LinAlgError:
            inverse = np.full(matrix.shape, np.nan)
        first = times(inverse, velocity)
        second = times(inverse, velocity + (4.0 / size) * first)
        way = 2.0 * first
        there = _velocity(after(way), joints, moves)
        third = times(inverse, there + (first - second) / size)
        way = way + third
        there = _velocity(after(way), joints, moves)
        last = times(inverse, there + (first - second - (8.0 / 3.0) * third) / size)
    return way + last, np.where(good[:, None], last, np.nan)


def _cubic(way: Floats, at_start: Floats, at_end: Floats, part: Floats) -> Floats:
    """Return the way up to a part of a step, as `cubic_path` does."""
    rest = 1.0 - part
    ahead: Floats = part * part * (3.0 - 2.0 * part) * way
    return ahead + part * rest * (rest * at_start - part * at_end)
