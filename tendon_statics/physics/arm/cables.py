"""The cables of an arm: their tension at each joint, and the pair that they are for it.

A cable bends by |θ| at a joint, so with friction μ_c on its guides the tension T' beyond the joint
lies within T e^(−μ_c|θ|) and T e^(μ_c|θ|) of the tension T before it. It stays what it was until
the band pushes it: it remembers.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..tensions import Tensions
from .arm import Arm

AtJoints = list[list[float]]
"""Tension in N of each cable at each joint: ``at[joint][cable]``, beyond that joint's guides; of a
cable that ends before the joint the last that it had"""


class Crossing(NamedTuple):
    """What crosses one joint."""

    left: tuple[int, ...]
    right: tuple[int, ...]
    """Cables l and s by their index"""
    leverage: tuple[tuple[int, float], ...]
    """Every cable's index, and its lever to s as a share of the joint's own; empty if all cables
    have that"""


def crossings(arm: Arm) -> list[Crossing]:
    """Return what crosses each joint."""
    found = []
    for number, design in enumerate(arm.designs, start=1):
        there = [i for i, cable in enumerate(arm.cables) if cable.last_unit >= number]
        levers = {
            index: float(arm.cable_levers[number - 1, index]) / design.cable_lever
            for index in there
        }
        alike = all(abs(lever) == 1.0 for lever in levers.values())
        left, right = (
            tuple(i for i in there if arm.cables[i].sign == sign) for sign in (-1.0, 1.0)
        )
        found.append(Crossing(left, right, () if alike else tuple(levers.items())))
    return found


def slack_joint(crossing: list[Crossing], at_joints: AtJoints) -> int | None:
    """Return the first joint at which a side has no tension at all, None if there is none."""
    for index, (left, right, _) in enumerate(crossing):
        at = at_joints[index]
        if not (any(at[i] for i in left) and any(at[i] for i in right)):
            return index
    return None


def pair_at(crossing: Crossing, at: list[float]) -> Tensions:
    """Return the pair of tensions in N that pulls and turns one joint as its cables do.

    With cables at the design's own offset these are the sums of the two sides.
    """
    left, right, leverage = crossing
    pulls = sum([at[i] for i in left]), sum([at[i] for i in right])
    if not leverage:
        return Tensions(*pulls)
    total, difference = sum(pulls), sum([lever * at[i] for i, lever in leverage])
    return Tensions(0.5 * (total - difference), 0.5 * (total + difference))


def transmitted(
    arm: Arm,
    tensions: list[float],
    angles: list[float],
    before: AtJoints | None,
    start: list[float] | None = None,
) -> AtJoints:
    """Return the tensions at the joints, from those at the base.

    Parameters
    ----------
    tensions : list of float
        In N, in the arm's order.
    angles : list of float
        Bend angles in rad.
    before : list of list of float, optional
        What the tensions at the joints were; None: as at the base, no friction being used. What
        stays as it was at a joint is the same list.
    start : list of float, optional
        Bend angles at which they were that, under the same tensions at the base. It saves time: a
        band that widens pushes nothing.
    """
    friction = arm.cable_friction_coefficient
    if friction == 0.0:
        return [tensions] * len(angles)
    at_joints, reaching, is_same = [], tensions, start is not None
    for number, angle in enumerate(angles, start=1):
        was = reaching if before is None else before[number - 1]
        if is_same and start and abs(angle) >= abs(start[number - 1]):
            at_joints.append(was)
            reaching = was
            continue
        band = math.exp(friction * abs(angle))
        here = [
            tension
            if end < number
            else tension / band
            if old < tension / band
            else tension * band
            if old > tension * band
            else old
            for old, tension, end in zip(was, reaching, arm.cable_ends, strict=True)
        ]
        is_same = is_same and here == was
        reaching = was if is_same else here
        at_joints.append(reaching)
    return at_joints


def transmitted_after(
    arm: Arm, tensions: list[float], way: tuple[list[float], list[float]], before: AtJoints
) -> AtJoints:
    """Return the tensions at the joints after a way that all of them go evenly.

    A joint that passes the straight on it has no band there, and forgets.

    Parameters
    ----------
    way : pair of list of float
        Bend angles in rad at its start, of which `before` is, and at its end.
    """
    start, end = way
    straight = {old / (old - new) for old, new in zip(start, end, strict=True) if old * new < 0.0}
    for share in sorted(straight):
        there = [old + share * (new - old) for old, new in zip(start, end, strict=True)]
        before = transmitted(arm, tensions, there, before, start)
        start = there
    return transmitted(arm, tensions, end, before, start)


def by_angles(
    arm: Arm, tensions: list[float], angles: list[float], at_joints: AtJoints
) -> NDArray[np.float64]:
    """Return ∂T'/∂θ in N/rad of the cables that cross a joint: shape (joints, cables, joints).

    Parameters
    ----------
    at_joints : list of list of float
        As `transmitted` has them at these angles.
    """
    friction, at = arm.cable_friction_coefficient, np.array(at_joints)
    bands = np.array([math.exp(friction * abs(angle)) for angle in angles])[:, None]
    reaching = np.concatenate(([tensions], at[:-1]))
    up, down = at == reaching * bands, at == reaching / bands
    # ∂ ln T'/∂θ by the joint's own angle; none from where it is straight, as the band then widens
    own = np.copysign(friction, angles)[:, None] * np.subtract(up, down, dtype=np.float64)
    joints = np.arange(len(angles))
    # What is not pushed at a joint does not feel those before it, either there or beyond.
    unfelt = np.maximum.accumulate(np.where(up | down, -1, joints[:, None]), axis=0)[:, :, None]
    feels = (joints > unfelt) & (joints <= joints[:, None, None])
    found: NDArray[np.float64] = at[:, :, None] * own.T * feels
    return found
