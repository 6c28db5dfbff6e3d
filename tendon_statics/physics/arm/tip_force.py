"""What pushes at the tip of an arm: the forces along a known line that all joints explain.

With all others frozen a joint is a single unit, which tells the force as a set; see `tip_force` of
the single unit. The force acts on every joint, so it is in the sets of all: their intersection.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence, Sized
from typing import Any, NamedTuple

from ..admissible import Interval
from ..errors import TensionError
from ..force_ends import forces_within
from ..force_scores import Doubt
from ..load import UPRIGHT, Load, push_along
from ..pushed_unit import BOTH_SIDES, PushedUnit
from ..tip_force import checked_noise
from .arm import Arm
from .cables import AtJoints, crossings, transmitted
from .carried import Carried, frozen_loads
from .force_doubt import ArmDoubt, JointScores, gains_at
from .joints import check_bend_angles, check_joint, taut_pairs

EXACT = 1e-9
"""N, or share of a force above 1 N: how exact an end is"""

End = tuple[float, int | None]
"""A force in N, and the joint that bounds the set there"""


class ArmTipForce(NamedTuple):
    """What is known of the force at the tip of an arm, in N along its direction."""

    intervals: list[Interval]
    """Forces with which friction can hold all joints: closed intervals, ascending and disjoint,
    rays with an infinite end"""
    bounding_joints: list[tuple[int | None, int | None]]
    """For each interval the joints, counted from 1 at the base, that bound its lower and its upper
    end; None for an infinite end"""
    joint_intervals: list[list[Interval]]
    """Forces with which friction can hold each joint by itself, from the base on; exact, for
    readings as they are"""
    level: float = 0.95
    """Probability with which the intervals hold the true force, where there is noise"""
    probability_free: float = math.nan
    """Probability that nothing at the tip explains the state"""


def arm_tip_force(
    arm: Arm,
    tensions: Mapping[str, float | Sequence[float]],
    *,
    bend_angles: Sequence[float],
    direction: Sequence[float],
    load: Load = UPRIGHT,
    at_stop: Collection[int] = (),
    tension_stddev: float = 0.0,
    bend_angle_stddev: float = 0.0,
    level: float = 0.95,
) -> ArmTipForce:
    """Return the forces at the tip with which friction can hold an arm where it is.

    Each end is a force at which a joint is about to slip, or the limit of those that leave it
    seated; which joint that is comes along. Without noise exact, in closed form. With noise the
    ends are widened so that the true force is inside at the rate `level` if it is at an end of the
    true set, else more often; see `force_doubt`. For an arm of one unit it is `tip_force` at the
    distance of the unit's length.

    Parameters
    ----------
    tensions : mapping
        Tension in N of each cable by its name, at the base; friction of the cables on their guides
        is then taken as not used, as by `arm_margins`. Or its tensions at all joints that it
        crosses, from the base on, as `ArmState.cable_tensions` has them.
    bend_angles : sequence of float
        Measured θ of each joint in rad, from the base on.
    direction : sequence of float
        Unit vector ``(x, z)``, or ``(x, y, z)`` with y of 0, along which the force acts on the end
        of the last unit, fixed in the base's frame. Forces against it are negative.
    load : Load
        What else acts, in the base's frame. A tip force of its own is a known one, to which the
        one asked for adds.
    at_stop : collection of int
        Joints, counted from 1 at the base, that may lean on their stop, each to the side of its
        angle. The stop carries what friction does not.
    tension_stddev : float
        Standard deviation of each cable's tension in N, all independent.
    bend_angle_stddev : float
        Standard deviation of each angle in rad, all independent.
    level : float
        Probability with which the intervals hold the true force, from 0.5 to below 1.

    Raises
    ------
    TensionError
        If a tension is missing or not allowed, or a joint has no tension on one side.
    BendAngleError
        If an angle is missing, not a number, or beyond its joint's stop.
    LoadError
        If the direction is no unit vector in the plane of bending, or the load's own force is said
        to act elsewhere than at the tip.
    ArmError
        If the arm has no such joint.
    ValueError
        If a deviation or the level is not allowed.
    """
    angles = check_bend_angles(arm, bend_angles)
    noise = checked_noise(tension_stddev, bend_angle_stddev, level)
    at_joints = _at_joints(arm, tensions, angles)
    pairs = taut_pairs(arm, at_joints)
    # What each unit carries, and what a newton at the tip adds to it.
    dead = Carried(arm, load).dead
    push = [push_along(direction, unit.length) for unit in arm.units]
    pairings = zip(
        *(arm.designs, pairs, angles, frozen_loads(dead, angles), frozen_loads(push, angles)),
        strict=True,
    )
    units = [PushedUnit(*of_joint) for of_joint in pairings]
    leaning = {check_joint(arm, joint) for joint in at_stop}
    sides = [
        (-math.copysign(1.0, angle),) if index in leaning else BOTH_SIDES
        for index, angle in enumerate(angles)
    ]
    of_joints = [unit.forces_held(to) for unit, to in zip(units, sides, strict=True)]
    common = _common(of_joints)
    exact = [(low, high) for (low, _), (high, _) in common]
    if noise.is_none:
        return ArmTipForce(
            exact,
            [(before, after) for (_, before), (_, after) in common],
            of_joints,
            level,
            float(any(low <= 0.0 <= high for low, high in exact)),
        )
    crossing = crossings(arm)
    doubts = []
    for index, to in enumerate(sides):
        gains = gains_at(arm, crossing[index], at_joints, index)
        scores = JointScores(units, index, dead, push, gains, load, noise)
        doubts.append(Doubt(scores, to))
    doubt = ArmDoubt(doubts)
    cuts = {end for intervals in (exact, *of_joints) for pair in intervals for end in pair}
    for unit, to in zip(units, sides, strict=True):
        cuts |= {force for side in to for force in unit.forces_at_limit(side)}
    found = forces_within(
        doubt, [cut for cut in cuts if math.isfinite(cut)], max(u.total for u in units), level
    )
    bounding = [(doubt.bounding(low), doubt.bounding(high)) for low, high in found]
    return ArmTipForce(found, bounding, of_joints, level, doubt.probability(0.0))


def _common(of_joints: list[list[Interval]]) -> list[tuple[End, End]]:
    """Intersect the sets of all joints."""
    found: list[tuple[End, End]] = [((-math.inf, None), (math.inf, None))]
    for joint, intervals in enumerate(of_joints, start=1):
        # Where two joints bound it at the same force, the one nearer to the base is named.
        both = [
            (
                low if low[0] >= own_low else (own_low, joint),
                high if high[0] <= own_high else (own_high, joint),
            )
            for low, high in found
            for own_low, own_high in intervals
        ]
        found = [_in_order(*ends) for ends in both if _is_interval(*ends)]
    return found


def _is_interval(low: End, high: End) -> bool:
    """Return whether there is a force between two ends, or one that is both but for rounding."""
    return low[0] <= high[0] + EXACT * max(1.0, abs(high[0]))


def _in_order(low: End, high: End) -> tuple[End, End]:
    """Return two ends of which the lower is not above the other, by rounding alone."""
    if low[0] <= high[0]:
        return low, high
    middle = 0.5 * (low[0] + high[0])
    return (middle, low[1]), (middle, high[1])


def _at_joints(arm: Arm, tensions: Mapping[str, Any], angles: list[float]) -> AtJoints:
    """Return the tensions at the joints: as `transmitted` has them, or as they are given."""
    known = {
        cable.name: _of_cable(cable.name, tensions[cable.name], cable.last_unit)
        for cable in arm.cables
        if isinstance(tensions.get(cable.name), Sized)
    }
    at_base = {**tensions, **{name: values[0] for name, values in known.items()}}
    at_joints = transmitted(arm, arm.check_tensions(at_base), angles, None)
    if not known:
        return at_joints
    found = []
    for joint, here in enumerate(at_joints):
        derived = dict(zip(arm.cable_names, here, strict=True))
        given = {name: values[min(joint, len(values) - 1)] for name, values in known.items()}
        found.append(arm.check_tensions({**derived, **given}))
    return found


def _of_cable(name: str, values: Sequence[float], count: int) -> Sequence[float]:
    """Return the tensions of one cable, as they are given, if there is one for each joint."""
    if isinstance(values, str):
        raise TensionError(f'the tension of cable {name} is {values!r}, which is not a number')
    if len(values) != count:
        raise TensionError(
            f'cable {name} has {len(values)} tensions, but crosses {count} joints: one in N is '
            'needed for each, or one alone, at the base'
        )
    return values
