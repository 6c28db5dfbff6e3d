"""Many arms that slip until all their joints are at rest: `flow` in arrays.

By the same rule as one arm: each member goes its own steps, which end where other joints move, but
all members take one at the same time. That costs a fortieth of following them one by one.

A step is one of RODAS3 of Sandu, Verwer, Blom, Spee, Carmichael and Potra, "Benchmarking stiff ODE
solvers for atmospheric chemistry problems II: Rosenbrock solvers", Atmospheric Environment 31
(1997): four stages, order 3 with an embedded order 2, stable for any step.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..motion import NOTHING, ROUNDING, TOLERANCE
from .glide import Moving, discs_bound, glide
from .linear_motions import times
from .look import Look

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]

STEP_ERROR = 1e-3
"""Error of one step in rad that is accepted, as estimated; where joints come to rest is exact"""

FIRST_WAY = 1e-2
"""Way in rad of the fastest joint in the first step that is tried"""

STRAIGHT = 1e-4
"""How exactly in rad a step ends where a joint with friction of the cables comes to be straight,
where its guides let no tension be but the one before them"""

JUST_BEYOND = 0.01
"""Share of a step by which it is to go beyond where other joints move, so that they do"""

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


def settle_many(look: Look) -> Settled:
    """Let arms slip from where they are until they are at rest."""
    motion = _Motions(look)
    for _ in range(MOST_STEPS):
        which = np.flatnonzero(motion.moving.any(axis=1))
        if not len(which):
            break
        motion.go_on(which)
    at_rest: Flags = ~np.asarray(motion.moving.any(axis=1))
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

    def __init__(self, look: Look) -> None:
        self._pulled, angles = look.pulled, look.angles
        self.angles, self.begun = angles.copy(), angles.copy()
        self.at_joints = None if look.drawn.at is None else look.drawn.at.copy()
        self.moving, self.sides = look.beyond(), look.sides.copy()
        # With friction the tensions at the joints have to be remembered first.
        self._at_first = look if self.at_joints is None else None
        self._share = np.full(angles.shape, ROUNDING)  # of K, by which M may exceed it
        self._step = np.full(len(angles), np.nan)

    def go_on(self, which: Indices) -> None:
        """Let some arms go on: to rest, if it is near, else by one step."""
        moving = self.moving[which]
        look, self._at_first = self._at_first, None
        if look is None or len(which) < len(self.angles):
            pulled = self._pulled.part(which, self.at_joints)
            look = pulled.look(self.angles[which], np.where(moving, self.sides[which], 0.0))
        arms = Moving(look.pulled, look, moving, self.begun[which])
        glided = glide(arms)
        rested = which[glided.at_rest]
        self._take(rested, glided.look, glided.at_rest)
        self.moving[rested] = False
        if glided.behind.any():
            self._let_rest(which, glided.behind)
        if glided.leg is not None and glided.on_leg.any():
            self._come_to(which, arms, glided.leg, glided.on_leg)
        rest = ~(glided.at_rest | glided.behind.any(axis=1) | glided.on_leg)
        if rest.any():
            self._step_on(which, arms, rest)

    def _take(self, which: Indices, look: Look, rows: Flags) -> None:
        self.angles[which] = look.angles[rows]
        if self.at_joints is not None:
            assert look.drawn.at is not None
            self.at_joints[which] = look.drawn.at[rows]

    def _let_rest(self, which: Indices, behind: Flags) -> None:
        """Let rest where they began what is beyond its limit by rounding alone."""
        rows, joints = np.nonzero(behind)
        rows = which[rows]
        self.angles[rows, joints] = self.begun[rows, joints]
        self.moving[rows, joints] = False
        self._share[rows, joints] = NOTHING
        self._free(which[behind.any(axis=1)])

    def _step_on(self, which: Indices, arms: Moving, rows: Flags) -> None:
        """Let some arms go one step of a Rosenbrock method."""
        if not rows.all():
            which, pulled = which[rows], arms.pulled.part(np.flatnonzero(rows))
            moving = arms.moving[rows]
            sides = np.where(moving, arms.look.sides[rows], 0.0)
            look = pulled.look(arms.look.angles[rows], sides)
            arms = Moving(pulled, look, moving, arms.begun[rows])
        jacobian, velocity = arms.jacobian(arms.look), arms.velocity(arms.look)
        step = self._step[which]
        with np.errstate(all='ignore'):
            step = np.where(np.isnan(step), FIRST_WAY / np.abs(velocity).max(axis=1), step)
            growth = _growth(jacobian)
            step = np.where(growth > 0.0, np.minimum(step, 1.0 / growth), step)
        way, error = _rosenbrock(arms, velocity, jacobian, step)
        with np.errstate(all='ignore'):
            worst = np.abs(error).max(axis=1) / STEP_ERROR
            good = worst <= 1.0
            factor = 0.9 * np.maximum(worst, 1e-6) ** (-1.0 / 3.0)
            factor = np.where(good, np.minimum(6.0, factor), np.maximum(0.2, factor))
        self._step[which] = step * np.where(np.isfinite(worst), factor, 0.1)
        way = np.where(good[:, None], way, 0.0)
        there = arms.after(way)
        until = _Until(arms, velocity, jacobian)
        share = np.where(good, until.share(there, step), 1.0)
        if (share < 1.0).any():
            start, end = velocity * step[:, None], arms.velocity(there) * step[:, None]
            most = np.maximum(np.abs(start).max(axis=1), np.abs(end).max(axis=1))
            rushed = (share < 1.0) & (most > 3.0 * np.abs(way).max(axis=1))
            self._step[which[rushed]] = (step * np.maximum(share, 1e-3))[rushed]
            good &= ~rushed
            whole, part = way, np.ones(len(way))
            for _ in range(MOST_CUTS):
                cut = good & (share < 1.0)
                if not cut.any():
                    break
                shorter = np.minimum(share + JUST_BEYOND, 1.0 - JUST_BEYOND)
                part = np.where(cut, part * shorter, part)
                way = np.where(cut[:, None], _cubic(whole, start, end, part[:, None]), way)
                there = arms.after(way)
                share = np.where(cut, until.share(there, part * step), 1.0)
        self._come_to(which, arms, there, good)

    def _come_to(self, which: Indices, arms: Moving, look: Look, rows: Flags) -> None:
        """Go there with some arms; stop what meets its stop or falls below its limit there."""
        which = which[rows]
        self._take(which, look, rows)
        moving, sides = arms.moving, look.sides
        stops = look.arms.stops
        falls = moving & (look.excess < 0.0)
        if falls.any():
            joints = arms.joints
            bends = times(arms.jacobian(look), arms.velocity(look))
            falls[:, joints] &= sides[:, joints] * bends < 0.0
        back = moving & (sides * (look.angles - arms.begun) < 0.0)
        at_stop = moving & ~back & (sides * look.angles >= stops - TOLERANCE)
        angles = np.where(back, arms.begun, np.where(at_stop, sides * stops, look.angles))
        self.angles[which] = angles[rows]
        self.moving[which] = (moving & ~(back | at_stop | falls))[rows]
        self._free(which)

    def _free(self, which: Indices) -> None:
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
    """After which share of a step the joints that move are no longer the same."""

    def __init__(self, arms: Moving, velocity: Floats, jacobian: Floats) -> None:
        look, joints = arms.look, arms.joints
        self._look, self._moving, self._rubs = look, arms.moving, look.arms.friction > 0.0
        self._was, self._slope = np.zeros(look.angles.shape), np.zeros(look.angles.shape)
        self._was[:, joints] = look.sides[:, joints] * velocity
        self._slope[:, joints] = np.abs(np.diagonal(jacobian, axis1=1, axis2=2))

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


def _growth(jacobian: Floats) -> Floats:
    """The fastest rate at which each motion grows; below zero, or zero, where none does."""
    bound = discs_bound(jacobian)
    grows = np.flatnonzero(bound > 0.0)
    if jacobian.shape[1] > 1 and len(grows):
        bound[grows] = np.linalg.eigvals(jacobian[grows]).real.max(axis=1)
    return bound


def _rosenbrock(
    arms: Moving, velocity: Floats, jacobian: Floats, step: Floats
) -> tuple[Floats, Floats]:
    """Return the way of one step, and an estimate of its error."""
    size = step[:, None]
    with np.errstate(all='ignore'):
        identity = np.eye(velocity.shape[1])
        matrix = identity * (2.0 / size)[..., None] - jacobian
        good: Any = np.isfinite(matrix).all(axis=(1, 2))
        matrix = np.where(good[:, None, None], matrix, identity)
        try:
            inverse = np.asarray(np.linalg.inv(matrix), np.float64)
        except np.linalg.LinAlgError:
            inverse = np.full(matrix.shape, np.nan)
        first = times(inverse, velocity)
        second = times(inverse, velocity + (4.0 / size) * first)
        way = 2.0 * first
        third = times(inverse, arms.velocity(arms.after(way)) + (first - second) / size)
        way = way + third
        change = first - second - (8.0 / 3.0) * third
        last = times(inverse, arms.velocity(arms.after(way)) + change / size)
        return way + last, np.where(good[:, None], last, np.nan)


def _cubic(way: Floats, at_start: Floats, at_end: Floats, part: Floats) -> Floats:
    """Return the way up to a part of a step, by a cubic."""
    rest = 1.0 - part
    ahead: Floats = part * part * (3.0 - 2.0 * part) * way
    return ahead + part * rest * (rest * at_start - part * at_end)
