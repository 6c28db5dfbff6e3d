"""The cables of an arm: their tension at each joint, and the pair that they are for it.

A cable bends by |θ| at a joint, so with friction μ_c on its guides the tension T' beyond the joint
lies within T e^(−μ_c|θ|) and T e^(μ_c|θ|) of the tension T before it. It stays what it was until
the band pushes it: it remembers.
"""

from __future__ import annotations

import math
from typing import NamedTuple

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
        levers = {}
        for index in there:
            cable = arm.cables[index]
            offset = design.cable_offset if cable.offset is None else cable.offset
            levers[index] = cable.sign * (design.ball_radius + offset) / design.cable_lever
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
    arm: Arm, tensions: list[float], angles: list[float], before: AtJoints | None
) -> AtJoints:
    """Return the tensions at the joints, from those at the base.

    Parameters
    ----------
    tensions : list of float
        In N, in the arm's order.
    angles : list of float
        Bend angles in rad.
    before : list of list of float, optional
        What the tensions at the joints were; None: as at the base, no friction being used.
    """
    friction = arm.cable_friction_coefficient
    if friction == 0.0:
        return [tensions] * len(angles)
    at_joints, reaching = [], tensions
    ends = [cable.last_unit for cable in arm.cables]
    for number, angle in enumerate(angles, start=1):
        was = reaching if before is None else before[number - 1]
        band = math.exp(friction * abs(angle))
        here = [
            min(max(old, tension / band), tension * band) if end >= number else tension
            for old, tension, end in zip(was, reaching, ends, strict=True)
        ]
        at_joints.append(here)
        reaching = here
    return at_joints


def by_angles(
    arm: Arm, tensions: list[float], angles: list[float], at_joints: AtJoints
) -> list[list[dict[int, float]]]:
    """Return ∂T'/∂θ in N/rad, for each joint and cable, by the joints whose guides push it.

    Parameters
    ----------
    at_joints : list of list of float
        As `transmitted` has them at these angles.
    """
    friction = arm.cable_friction_coefficient
    found: list[list[dict[int, float]]] = []
    pushed: list[dict[int, float]] = [{} for _ in tensions]  # ∂ ln T'/∂θ
    reaching = tensions
    for joint, angle in enumerate(angles):
        here, band = at_joints[joint], math.exp(friction * abs(angle))
        for i, (tension, at) in enumerate(zip(reaching, here, strict=True)):
            if arm.cables[i].last_unit <= joint:
                continue
            by_angle = math.copysign(friction, angle) if angle else friction
            if at == tension * band:
                pushed[i] = {**pushed[i], joint: by_angle}
            elif at == tension / band:
                pushed[i] = {**pushed[i], joint: -by_angle}
            else:
                pushed[i] = {}
        found.append(
            [{k: at * slope for k, slope in pushed[i].items()} for i, at in enumerate(here)]
        )
        reaching = here
    return found
