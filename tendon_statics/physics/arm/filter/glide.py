"""Joints of many arms that move a little, at once: `legs` and `rest` in arrays.

Where noise or a ramp moves joints that slip already, what is left to go is as good as linear, and
all members of a filter go it at once: up to where other joints move, or to rest.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..legs import SMALL
from ..motion import ROUNDING
from ..rest import TINY
from .linear_motions import LinearMotions, times
from .look import Look, Pulled

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]

NEAR = 0.1
"""Way in rad from the place of rest, were the motion linear, within which this is tried"""

STRAIGHT = 0.1
"""Share of the way by which the place of rest may be elsewhere than if the motion were linear"""

LEG_ERROR = 1e-3
"""How exactly in rad a leg ends where other joints move"""

NEWTON_STEPS = 8


class Glided(NamedTuple):
    """Where arms have come that move a little; nothing of those that are in none of the three."""

    look: Look
    """Where they are that have come to rest"""
    at_rest: Flags
    behind: Flags
    """Joints that would end behind where they began to move, shape ``(arms, joints)``"""
    leg: Look | None
    """Where they are that have come to where other joints move"""
    on_leg: Flags


class Moving(NamedTuple):
    """Arms of which joints move.

    Attributes
    ----------
    look : Look
        Where they are.
    moving : ndarray
        Which joints move, to the sides of `look`; one at least of each arm.
    begun : ndarray
        Where each was when it began to, in rad.
    """

    pulled: Pulled
    look: Look
    moving: Flags
    begun: Floats

    @property
    def joints(self) -> Indices:
        """Those that move in any arm."""
        return np.flatnonzero(self.moving.any(axis=0))

    def after(self, ways: Floats) -> Look:
        """Look at the arms with these joints moved on, by ways in rad."""
        angles = self.look.angles.copy()
        angles[:, self.joints] += ways
        return self.pulled.look(angles, np.where(self.moving, self.look.sides, 0.0))

    def velocity(self, look: Look) -> Floats:
        """M − side K in N m of these joints there; 0 of those that rest."""
        joints = self.joints
        found = (look.sides * look.excess)[:, joints]
        return np.where(self.moving[:, joints], found, 0.0)

    def jacobian(self, look: Look, other: float = 0.0) -> Floats:
        """Return its derivatives by their angles; with a number for those that rest."""
        joints = self.joints
        which = self.moving[:, joints]
        found = look.jacobian(joints)[:, joints]
        found = np.where(which[:, :, None] & which[:, None, :], found, 0.0)
        found += np.where(which, 0.0, other)[:, :, None] * np.eye(len(joints))
        return found


def glide(arms: Moving) -> Glided:
    """Let arms go on to rest, or to where other joints move, that have only a little way to go."""
    jacobian = arms.jacobian(arms.look, -1.0)
    velocity = arms.velocity(arms.look)
    rest, solved = _solved(jacobian, velocity)
    reach = np.abs(rest).max(axis=1)
    fine = solved & (reach <= NEAR)
    nowhere = np.zeros(len(fine), bool)
    if not fine.any():
        return Glided(arms.look, nowhere, np.zeros(arms.moving.shape, bool), None, nowhere)
    happens = _changes(arms, jacobian)
    straight_on = jacobian.shape[1] == 1
    rests = (
        fine
        & (discs_bound(jacobian) < 0.0)
        & ((reach <= TINY) | (straight_on & ~happens(rest, 0.0 * rest)))
    )
    leg = None
    if (fine & ~rests).any():
        linear = LinearMotions(jacobian, velocity)
        ways, happened, died = linear.first(happens)
        on_leg = fine & ~rests & happened
        rests |= fine & died & ~happened
        if on_leg.any():
            leg = arms.after(np.where(on_leg[:, None], ways, 0.0))
            found = arms.velocity(leg)
            with np.errstate(all='ignore'):
                fastest = np.maximum(np.abs(velocity).max(axis=1), np.abs(found).max(axis=1))
                amiss = np.abs(found - linear.velocity(ways)).max(axis=1) / fastest
                nowhere = on_leg & (amiss * np.abs(ways).max(axis=1) <= LEG_ERROR)
    if not rests.any():
        return Glided(arms.look, rests, np.zeros(arms.moving.shape, bool), leg, nowhere)
    return _end(arms, rests, jacobian, rest, leg, nowhere)


def discs_bound(jacobian: Floats) -> Floats:
    """Return what no eigenvalue is to the right of, by the discs about the diagonal."""
    diagonal = np.diagonal(jacobian, axis1=1, axis2=2)
    found: Floats = (diagonal + np.abs(jacobian).sum(axis=2) - np.abs(diagonal)).max(axis=1)
    return found


def _solved(jacobian: Floats, velocity: Floats) -> tuple[Floats, Flags]:
    """Solve J x = −f for each arm; say which could be."""
    good: Any = np.isfinite(jacobian).all(axis=(1, 2)) & np.isfinite(velocity).all(axis=1)
    if jacobian.shape[1] == 1:
        with np.errstate(all='ignore'):
            found = -velocity / jacobian[:, 0]
        return found, good & np.isfinite(found).all(axis=1)
    safe = np.where(good[:, None, None], jacobian, -np.eye(jacobian.shape[1]))
    try:
        found = np.asarray(np.linalg.solve(safe, -velocity[..., None])[..., 0], np.float64)
    except np.linalg.LinAlgError:
        found = np.full(velocity.shape, np.inf)
    return found, good & np.isfinite(found).all(axis=1)


def _changes(arms: Moving, jacobian: Floats) -> Callable[[Floats, Floats], Flags]:
    """Return what tells whether other joints move than at the start, from ways and velocities."""
    look, joints = arms.look, arms.joints
    which = arms.moving[:, joints]
    sides, angles = look.sides[:, joints], look.angles[:, joints]
    to_go = np.where(which, look.arms.stops[joints] - sides * angles, np.inf)
    if look.arms.friction:  # to where it is straight, if it has that before it
        to_go = np.where(which & (sides * angles < 0.0), -sides * angles, to_go)
    resting = ~arms.moving & ~look.leans
    lacking = np.where(resting, look.excess, -np.inf)
    rows = look.sides[:, :, None] * np.where(which[:, None], look.jacobian(joints), 0.0)

    def happens(way: Floats, velocity: Floats) -> Flags:
        falls = sides * velocity < -SMALL * np.abs(velocity).max(axis=-1, keepdims=True)
        falls &= sides * times(jacobian, velocity) < 0.0
        found = (which & (falls | (sides * way >= to_go))).any(axis=-1)
        found |= np.abs(way).max(axis=-1) > 2.0 * NEAR
        found |= (lacking + times(rows, way) > 0.0).any(axis=-1)
        return np.asarray(found)

    return happens


def _end(
    arms: Moving, fine: Flags, jacobian: Floats, way: Floats, leg: Look | None, on_leg: Flags
) -> Glided:
    """Go to where M = K for all that move, by Newton's method.

    Parameters
    ----------
    fine : ndarray
        Which arms may.
    way : ndarray
        Its first step, shape ``(arms, joints)``.
    """
    joints, moving, begun = arms.joints, arms.moving, arms.begun
    which = moving[:, joints]
    total, reach = np.where(fine[:, None], way, 0.0), np.abs(way).max(axis=1)
    done: Any = np.zeros(len(total), bool)
    for index in range(NEWTON_STEPS):
        look = arms.after(total)
        allowed = np.maximum(0.01 * ROUNDING * look.capacity, 0.5 * look.rounding)[:, joints]
        excess = np.where(which, look.excess[:, joints], 0.0)
        done = (np.abs(excess) <= allowed).all(axis=1)
        if (done | ~fine).all():
            break
        if index:
            jacobian = arms.jacobian(look, -1.0)
        way, solved = _solved(jacobian, arms.velocity(look))
        step = np.abs(way).max(axis=1)
        fine = fine & (done | (solved & (step <= (STRAIGHT if index == 0 else 1.0) * reach)))
        total = np.where((fine & ~done)[:, None], total + way, total)
    at_rest = fine & done
    at_rest &= np.asarray((np.abs(look.angles) <= look.arms.stops).all(axis=1))
    behind = moving & (look.sides * (look.angles - begun) < 0.0) & at_rest[:, None]
    # Of the joints at rest none may have come to its limit.
    at_rest &= ~(behind | (look.beyond() & ~moving)).any(axis=1)
    return Glided(look, at_rest, behind, leg, on_leg)
