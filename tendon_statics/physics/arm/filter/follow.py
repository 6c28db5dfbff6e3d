"""Many arms alike, each followed exactly through tensions of its own."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ArmError, TensionError
from ..excess import Excess
from ..flow import settle
from .look import Pulled
from .many import Dead, ManyArms
from .settle_many import settle_many

Floats = NDArray[np.float64]


class Place(NamedTuple):
    """Where many arms are, and what the friction of their cables remembers."""

    angles: Floats
    """In rad, shape ``(arms, joints)``"""
    at_joints: Floats | None = None
    """Tensions in N, shape ``(arms, joints, cables)``; None where nothing is remembered"""


def follow(arms: ManyArms, dead: list[Dead], paths: Floats, start: Place) -> list[Place]:
    """Follow arms through the samples of a path, one after another.

    Parameters
    ----------
    dead : list of Dead
        What the arms carry at each sample.
    paths : ndarray
        Tensions at the base in N, shape ``(cables, samples, arms)``.

    Returns
    -------
    list of Place
        Where they are at first and after each sample.
    """
    tensions = np.ascontiguousarray(np.moveaxis(paths, 0, 2))  # samples, arms, cables
    found = [start]
    held = _held(arms, dead, tensions, start)
    found += [start] * held
    for row in range(held, len(tensions)):
        found.append(_after(arms, dead[row], tensions[row], found[-1]))
    return found


def _held(arms: ManyArms, dead: list[Dead], tensions: Floats, start: Place) -> int:
    """Return through how many samples all arms stay where they are, if that is easy to see."""
    if arms.friction or any(one is not dead[0] for one in dead):
        return 0
    samples, cables = len(tensions), tensions.shape[2]
    pulled = Pulled(arms, dead[0], tensions.reshape(-1, cables))
    look = pulled.look(np.tile(start.angles, (samples, 1)))
    moving = look.beyond().reshape(samples, -1).any(axis=1)
    return int(moving.argmax()) if moving.any() else samples


def _after(arms: ManyArms, dead: Dead, tensions: Floats, place: Place) -> Place:
    """Return where arms are after one sample."""
    pulled = Pulled(arms, dead, tensions, place.at_joints)
    look = pulled.look(place.angles)
    moving = look.beyond()
    which = np.flatnonzero(moving.any(axis=1))
    if not len(which):
        return Place(place.angles, look.drawn.at)
    angles = place.angles.copy()
    at_joints = look.drawn.at
    if len(which) < len(angles):
        look = pulled.part(which).look(place.angles[which])
    many = settle_many(look)
    rested = which[many.at_rest]
    angles[rested] = many.angles[many.at_rest]
    if at_joints is not None:
        assert many.at_joints is not None
        at_joints[rested] = many.at_joints[many.at_rest]
    for index in which[~many.at_rest].tolist():
        memory = None if at_joints is None else at_joints[index]
        settled = _settled(arms, dead, tensions[index], angles[index], memory)
        if settled is None:
            continue
        angles[index], there = settled
        if at_joints is not None:
            at_joints[index] = there
    return Place(angles, at_joints)


def _settled(
    arms: ManyArms, dead: Dead, tensions: Floats, angles: Floats, at_joints: Floats | None
) -> tuple[list[float], list[list[float]]] | None:
    """Let one arm slip until it is at rest; None if its joints are not all seated."""
    at_base = tensions.tolist()
    memory = [at_base] * arms.count if at_joints is None else at_joints.tolist()
    try:
        excess = Excess(arms.arm, arms.crossing, dead.carried, at_base, memory)
        look = settle(excess, angles.tolist()).look
    except (TensionError, ArmError):
        return None
    return look.angles, look.at_joints
