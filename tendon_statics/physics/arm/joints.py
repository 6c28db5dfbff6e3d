"""Each joint of an arm as a single one, all others being frozen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..admissible import check_bend_angle
from ..errors import ArmError, BendAngleError, TensionError
from ..load import UPRIGHT, Load
from ..loaded_joint import LoadedJoint
from ..slip import Probe, Slip
from ..tensions import Tensions
from .arm import Arm
from .cables import AtJoints, crossings, pair_at, slack_joint, transmitted
from .carried import Carried

Driven = tuple[Slip, Probe]
"""The slip function of a joint towards the side to which it is driven, probed where it is"""


def arm_margins(
    arm: Arm, bend_angles: Sequence[float], tensions: Mapping[str, float], load: Load = UPRIGHT
) -> tuple[float, ...]:
    """Return the signed share of its friction limit that each joint needs to stay where it is.

    M / K, as `slip_margin` has it of a single unit; where one is beyond ±1 the arm slips.

    Parameters
    ----------
    bend_angles : sequence of float
        θ of each joint in rad, from the base on.
    tensions : mapping
        Tension in N of each cable by its name, at the base. Friction of the cables on their guides
        is taken as not used: a tracker knows how much is.
    load : Load
        On the base: gravity's direction and the force at the end of the last unit, both in the
        base's frame.

    Raises
    ------
    TensionError
        If a tension is missing or not allowed, a joint has no tension on one side, or is not
        seated.
    BendAngleError
        If an angle is missing, not a number, or beyond its joint's stop.
    LoadError
        If the force at the tip is said to act elsewhere.
    """
    angles = check_bend_angles(arm, bend_angles)
    at_base = arm.check_tensions(tensions)
    carried = Carried(arm, load)
    pairs = taut_pairs(arm, transmitted(arm, at_base, angles, None))
    driven = drive(carried, carried.frozen(angles), angles, pairs, [1.0] * len(angles))
    return tuple(slip.margin_at(probe) for slip, probe in driven)


def taut_pairs(arm: Arm, at_joints: AtJoints) -> list[Tensions]:
    """Return the pair of tensions in N that pulls and turns each joint.

    Parameters
    ----------
    at_joints : list of list of float
        As `transmitted` has them.

    Raises
    ------
    TensionError
        If a joint has no tension on one side.
    """
    crossing = crossings(arm)
    slack = slack_joint(crossing, at_joints)
    if slack is not None:
        raise TensionError(
            f'joint {slack + 1} is slack: no cable that crosses it has any tension on one side, '
            'which is outside the model'
        )
    return [pair_at(*both) for both in zip(crossing, at_joints, strict=True)]


def drive(
    carried: Carried,
    joints: list[LoadedJoint],
    angles: list[float],
    pairs: list[Tensions],
    sides: list[float],
) -> list[Driven]:
    """Return the slip function of every joint towards the side to which it is driven.

    Parameters
    ----------
    joints : list of LoadedJoint
        As `Carried.frozen` has them.
    sides : list of float
        Sides to try first; the right ones save half of the time.

    Raises
    ------
    TensionError
        If a joint is not seated.
    """
    found = []
    for index, (left, right) in enumerate(pairs):
        joint, side = joints[index], sides[index]
        excess = left + right - joint.size
        if excess <= 0.01 * joint.size:
            excess = carried.excess(index, pairs[index])
        slip = Slip(joint, excess, left, right, side)
        found.append(slip.driving(side * angles[index]))
    return found


def check_bend_angles(arm: Arm, bend_angles: object) -> list[float]:
    """Return the bend angles of all joints as floats within their stops.

    Raises
    ------
    BendAngleError
        If one is missing, not a number, or beyond its joint's stop.
    """
    try:
        given = list(bend_angles)  # type: ignore[call-overload]
    except TypeError:
        given = []
    if len(given) != len(arm.units):
        raise BendAngleError(
            f'bend_angles is {bend_angles!r}, but the arm has {len(arm.units)} joints; '
            'an angle in rad is needed for each'
        )
    return [check_joint_angle(arm, number, angle) for number, angle in enumerate(given, start=1)]


def check_joint_angle(arm: Arm, joint: int, bend_angle: float) -> float:
    """Return the bend angle of one joint as a float within its stops; joints count from 1.

    Raises
    ------
    BendAngleError
        If it is not a number, or beyond the stop.
    """
    try:
        return check_bend_angle(arm.designs[joint - 1], bend_angle)
    except BendAngleError as error:
        raise BendAngleError(f'joint {joint}: {error}') from None


def check_joint(arm: Arm, joint: object) -> int:
    """Return the index of a joint that is counted from 1 at the base.

    Raises
    ------
    ArmError
        If the arm has no such joint.
    """
    count = len(arm.units)
    if isinstance(joint, bool) or not isinstance(joint, int) or not 1 <= joint <= count:
        raise ArmError(f'joint is {joint!r}, the arm has joints 1 to {count}, from the base on')
    return joint - 1
