"""What pushes at the tip of an arm: the forces along a known line that all joints explain.

With all others frozen a joint is a single unit, which tells the force as a set; see `tip_force` of
the single unit. The force acts on every joint, so it is in the sets of all: their intersection. A
joint that slips tells it as a number, which the others can only confirm or contradict.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from ..admissible import Interval
from ..design_uncertainty import DesignUncertainty
from ..errors import ArmError
from ..force_ends import forces_within
from ..force_scores import Doubt
from ..load import UPRIGHT, Load
from ..pushed_unit import BOTH_SIDES
from ..tip_force import SIDES, checked_noise, stddev_at_limit
from .arm import Arm
from .common_forces import common_forces
from .force_doubt import ArmDoubt, ArmNoise, joint_scores
from .joints import check_bend_angles, check_joint
from .pushed_arm import PushedArm

NONE_SLIPS: Mapping[int, str] = {}


class ArmTipForce(NamedTuple):
    """What is known of the force at the tip of an arm, in N along its direction."""

    intervals: list[Interval]
    """Forces that explain all joints, with the probability `level`: closed intervals, ascending
    and disjoint, rays with an infinite end"""
    bounding_joints: list[tuple[int | None, int | None]]
    """For each interval the joints, counted from 1 at the base, that bound its lower and its upper
    end; None for an infinite end"""
    joint_intervals: list[list[Interval]]
    """Forces that explain each joint by itself, from the base on; exact, for readings as they
    are"""
    level: float = 0.95
    """Probability with which the intervals hold the true force, where there is noise"""
    probability_free: float = math.nan
    """Probability that nothing at the tip explains the state; at the limit, that of a reading as
    far from nothing"""
    at_limit: bool = False
    """Whether a joint slips, so that friction is at its limit there"""
    force: float | None = None
    """The one force that there is at the limit, of the joint that tells it best; None where there
    are several or none, and where the joints contradict one another"""
    force_stddev: float | None = None
    """Its standard deviation to first order"""


def arm_tip_force(
    arm: Arm,
    tensions: Mapping[str, float | Sequence[float]],
    *,
    bend_angles: Sequence[float],
    direction: Sequence[float],
    load: Load = UPRIGHT,
    at_stop: Collection[int] = (),
    slipping: Mapping[int, str] = NONE_SLIPS,
    tension_stddev: float = 0.0,
    bend_angle_stddev: float | Sequence[float] = 0.0,
    design_covariance: DesignUncertainty | Sequence[DesignUncertainty | None] | None = None,
    level: float = 0.95,
) -> ArmTipForce:
    """Return the forces at the tip with which friction can hold an arm where it is.

    Each end is a force at which a joint is about to slip, or the limit of those that leave it
    seated; which joint that is comes along. Without noise exact, in closed form. With noise the
    ends are widened so that the true force is inside at the rate `level` if it is at an end of the
    true set, else more often; see `force_doubt`. Of a joint that slips the set is one of its ends.
    For an arm of one unit it is `tip_force` at the distance of the unit's length.

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
    slipping : mapping of int to str
        Joint, counted likewise → the cables, ``s`` or ``l``, towards which it is known to be
        slipping. All others may be at rest.
    tension_stddev : float
        Standard deviation of each cable's tension in N, all independent.
    bend_angle_stddev : float or sequence of float
        Standard deviation of each angle in rad, or of all, independent of one another.
    design_covariance : DesignUncertainty, or sequence of them or None, optional
        Of parameters of each unit's design, from the base on, or of all; the units are independent
        of one another. Without it the designs are exact.
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
        If the arm has no such joint, or there are not as many deviations of the angles, or
        uncertainties of the designs, as units.
    ValueError
        If a deviation, the level or a side in `slipping` is not allowed.
    """
    angles = check_bend_angles(arm, bend_angles)
    noise = _checked_noise(arm, tension_stddev, bend_angle_stddev, design_covariance, level)
    leaning = {check_joint(arm, joint) for joint in at_stop}
    slips = {check_joint(arm, joint): _side(joint, to) for joint, to in slipping.items()}
    pushed = PushedArm.of(arm, tensions, angles, direction, load)
    units = pushed.units
    sides = [
        (-math.copysign(1.0, angle),) if index in leaning else BOTH_SIDES
        for index, angle in enumerate(angles)
    ]
    of_joints = [
        [(force, force) for force in sorted(unit.forces_at_limit(slips[index]))]
        if index in slips
        else unit.forces_held(to)
        for index, (unit, to) in enumerate(zip(units, sides, strict=True))
    ]
    common = common_forces(of_joints)
    exact = [(low, high) for (low, _), (high, _) in common]
    if noise.is_none:
        one = exact[0][0] if slips and len(exact) == 1 else None
        return ArmTipForce(
            exact,
            [(before, after) for (_, before), (_, after) in common],
            of_joints,
            level,
            float(any(low <= 0.0 <= high for low, high in exact)),
            bool(slips),
            one,
            None if one is None else 0.0,
        )
    scores = joint_scores(pushed, noise)
    doubts = [
        Doubt(of_joint, to, slips.get(index, 0.0))
        for index, (of_joint, to) in enumerate(zip(scores, sides, strict=True))
    ]
    cuts = []
    for index, (unit, intervals, doubted) in enumerate(zip(units, of_joints, doubts, strict=True)):
        ends = {end for interval in intervals for end in interval if math.isfinite(end)}
        if index not in slips:
            ends |= {force for side in sides[index] for force in unit.forces_at_limit(side)}
        cuts += [(end, doubted) for end in ends]
    doubt = ArmDoubt(doubts)
    found = forces_within(doubt, cuts, max(unit.total for unit in units), level)
    told = []
    for index, side in slips.items():
        forces = units[index].forces_at_limit(side)
        stddev = (
            stddev_at_limit(scores[index], forces[0], side, units[index].total)
            if len(forces) == 1
            else None
        )
        if stddev is not None and any(low <= forces[0] <= high for low, high in found):
            told.append((stddev, forces[0]))
    stddev, force = min(told, default=(None, None))
    return ArmTipForce(
        found,
        [(doubt.bounding(low), doubt.bounding(high)) for low, high in found],
        of_joints,
        level,
        doubt.probability(0.0),
        bool(slips),
        force,
        stddev,
    )


def _side(joint: int, cables: str) -> float:
    if cables not in SIDES:
        raise ValueError(f"slipping of joint {joint} is {cables!r}, allowed is 's' or 'l'")
    return SIDES[cables]


def _checked_noise(
    arm: Arm,
    tension_stddev: float,
    bend_angle_stddev: float | Sequence[float],
    design_covariance: DesignUncertainty | Sequence[DesignUncertainty | None] | None,
    level: float,
) -> ArmNoise:
    """Return how well all is known, unit by unit.

    Raises
    ------
    ArmError
        If something is not said of as many units as the arm has.
    ValueError
        If a deviation or the level is not allowed.
    """
    stddevs = _of_each(arm, 'bend_angle_stddev', bend_angle_stddev)
    for stddev in stddevs:
        checked_noise(tension_stddev, stddev, level)
    designs = _of_each(arm, 'design_covariance', design_covariance)
    return ArmNoise(tension_stddev, stddevs, designs)


def _of_each(arm: Arm, name: str, given: Any) -> list[Any]:
    """Return what is said of each unit, or of all."""
    count = len(arm.units)
    if not isinstance(given, Iterable):
        return [given] * count
    found = list(given)
    if len(found) != count:
        raise ArmError(
            f'{name} has {len(found)} values, but the arm has {count} units: one is needed for '
            'each, or one alone, for all'
        )
    return found
