"""Joints of many arms that move a little, at once: `one_go` in arrays.

Where noise or a ramp moves joints that slip already, what is left to go is as good as linear, and
all members of a filter go it at once. One that does not, since a joint jumps, meets its stop, or
comes to its limit on the way, is left to `flow`, which is the rule.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..motion import ROUNDING
from ..one_go import SMALL, TINY
from .many import Look, Pulled

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

NEAR = 0.1
"""Way in rad from the place of rest, were the motion linear, within which this is tried"""

STRAIGHT = 0.1
"""Share of the way by which the place of rest may be elsewhere than if the motion were linear"""

NEWTON_STEPS = 8

DOUBLINGS = 30
"""Of the time up to which a linear motion is looked at"""

DIED = 3e-4
"""Share of its velocity at first below which a motion has died away"""


class Glided(NamedTuple):
    """Where arms have come that moved a little."""

    look: Look
    at_rest: Flags
    """Which of them are there; of the others it says nothing"""
    behind: Flags
    """Joints that would end behind where they began to move, shape ``(arms, joints)``"""


def glide(pulled: Pulled, look: Look, moving: Flags, begun: Floats) -> Glided:
    """Let arms go on to rest that have only a little way to go.

    Parameters
    ----------
    look : Look
        Where they are.
    moving : ndarray
        Which joints move; one at least of each arm.
    begun : ndarray
        Where each was when it began to, in rad.
    """
    joints = np.flatnonzero(moving.any(axis=0))
    which = moving[:, joints]
    sides = look.sides
    everything = look.jacobian(joints)
    jacobian = of_moving(everything[:, joints], which)
    velocity = np.where(which, (sides * look.excess)[:, joints], 0.0)
    rest, solved = _solved(jacobian, velocity)
    reach = np.abs(rest).max(axis=1)
    fine = solved & (reach <= NEAR)
    if fine.any():
        tiny = reach <= TINY
        fine &= _undisturbed(look, which, joints, everything, jacobian, velocity, rest) | (
            tiny & _dies(jacobian)
        )
    if not fine.any():
        return Glided(look, fine, np.zeros(moving.shape, bool))
    return _end(pulled, look, fine, moving, begun, jacobian, rest)


def of_moving(jacobian: Floats, which: Flags, other: float = -1.0) -> Floats:
    """Return the derivatives of those that move by those that move, and a number for others."""
    found = np.where(which[:, :, None] & which[:, None, :], jacobian, 0.0)
    found += np.where(which, 0.0, other)[:, :, None] * np.eye(which.shape[1])
    return found


def _solved(jacobian: Floats, velocity: Floats) -> tuple[Floats, Flags]:
    """Solve J x = −f for each arm; say which could be."""
    good: Flags = np.isfinite(jacobian).all(axis=(1, 2)) & np.isfinite(velocity).all(axis=1)
    if jacobian.shape[1] == 1:
        with np.errstate(all='ignore'):
            found = -velocity / jacobian[:, 0]
        return found, good & np.isfinite(found).all(axis=1)
    safe = np.where(good[:, None, None], jacobian, -np.eye(jacobian.shape[1]))
    try:
        found = np.linalg.solve(safe, -velocity[..., None])[..., 0]
    except np.linalg.LinAlgError:
        found = np.full(velocity.shape, np.inf)
    return found, good & np.isfinite(found).all(axis=1)


def _dies(jacobian: Floats) -> Flags:
    """Whether the motion dies away, as far as the discs about the diagonal can say."""
    diagonal = np.diagonal(jacobian, axis1=1, axis2=2)
    bound = (diagonal + np.abs(jacobian).sum(axis=2) - np.abs(diagonal)).max(axis=1)
    found: Flags = bound < 0.0
    return found


def _undisturbed(
    look: Look,
    which: Flags,
    joints: NDArray[np.intp],
    everything: Floats,
    jacobian: Floats,
    velocity: Floats,
    rest: Floats,
) -> Flags:
    """Whether the same joints move all along a linear motion, and it dies away.

    Looked at as `linear_motion` does: at times each of which is twice the one before.
    """
    sides, angles = look.sides[:, joints], look.angles[:, joints]
    to_go = np.where(which, look.arms.stops[joints] - sides * angles, np.inf)
    if look.arms.friction:
        to_go = np.where(which & (sides * angles < 0.0), -sides * angles, to_go)
    resting = ~look.leans
    resting[:, joints] &= ~which
    lacking = np.where(resting, look.excess, -np.inf)
    rows = look.sides[:, :, None] * np.where(which[:, None], everything, 0.0)

    def happens(way: Floats, now: Floats) -> Flags:
        falls = sides * now < -SMALL * np.abs(now).max(axis=1, keepdims=True)
        falls &= sides * times(jacobian, now) < 0.0
        found = (which & (falls | (sides * way >= to_go))).any(axis=1)
        found |= np.abs(way).max(axis=1) > 2.0 * NEAR
        found |= (lacking + times(rows, way) > 0.0).any(axis=1)
        return np.asarray(found)

    if len(joints) == 1:  # straight on
        return ~happens(rest, 0.0 * rest) & (jacobian[:, 0, 0] < 0.0)
    size = np.abs(jacobian).sum(axis=2).max(axis=1)
    time = 1.0 / (8.0 * size)
    turn = jacobian * time[:, None, None]
    # e^J and the way by their series, to the seventh order of an eighth
    power, term = np.eye(len(joints)), velocity * time[:, None]
    growth, way = power + 0.0 * turn, 0.0 * term
    for order in range(1, 8):
        way = way + term / order
        power, term = power @ turn / order, times(turn, term) / order
        growth = growth + power
    fine = np.ones(len(way), bool)
    fastest = np.abs(velocity).max(axis=1)
    died = np.zeros(len(way), bool)
    for _ in range(DOUBLINGS):
        now = velocity + times(jacobian, way)
        died |= np.abs(now).max(axis=1) <= DIED * fastest
        fine &= died | ~happens(way, now)
        if (died | ~fine).all():
            break
        way = way + times(growth, way)
        growth = growth @ growth
    return fine & died & ~happens(rest, 0.0 * rest)


def times(matrix: Floats, vector: Floats) -> Floats:
    """Return the products of many matrices and vectors."""
    found: Floats = (matrix @ vector[..., None])[..., 0]
    return found


def _end(
    pulled: Pulled,
    look: Look,
    fine: Flags,
    moving: Flags,
    begun: Floats,
    jacobian: Floats,
    way: Floats,
) -> Glided:
    """Go to where M = K for all that move, by Newton's method.

    Parameters
    ----------
    fine : ndarray
        Which arms may.
    way : ndarray
        Its first step, shape ``(arms, joints)``.
    """
    joints = np.flatnonzero(moving.any(axis=0))
    which = moving[:, joints]
    start, sides = look.angles, np.where(moving, look.sides, 0.0)
    stops = look.arms.stops
    total, reach = np.where(fine[:, None], way, 0.0), np.abs(way).max(axis=1)
    done = np.zeros(len(start), bool)
    for index in range(NEWTON_STEPS):
        angles = start.copy()
        angles[:, joints] += total
        look = pulled.look(angles, sides)
        allowed = np.maximum(0.01 * ROUNDING * look.capacity, 0.5 * look.rounding)[:, joints]
        excess = np.where(which, look.excess[:, joints], 0.0)
        done = (np.abs(excess) <= allowed).all(axis=1)
        if (done | ~fine).all():
            break
        if index:
            jacobian = of_moving(look.jacobian(joints)[:, joints], which)
        way, solved = _solved(jacobian, sides[:, joints] * excess)
        step = np.abs(way).max(axis=1)
        fine &= done | (solved & (step <= (STRAIGHT if index == 0 else 1.0) * reach))
        total = np.where((fine & ~done)[:, None], total + way, total)
    at_rest = fine & done
    at_rest &= (np.abs(angles) <= stops).all(axis=1)
    behind = moving & (sides * (angles - begun) < 0.0)
    behind &= at_rest[:, None]
    # Of the joints at rest none may have come to its limit.
    at_rest &= ~(behind | (look.beyond() & ~moving)).any(axis=1)
    return Glided(look, at_rest, behind)
