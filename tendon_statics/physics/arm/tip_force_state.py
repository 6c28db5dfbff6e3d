"""The tip force of an arm that is followed: its regimes say which joints are at their limit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ..design_uncertainty import DesignUncertainty
from ..errors import BendAngleError
from ..regime import Regime
from ..tip_force import may_be_at_stop
from ..tip_force_state import SAME_ANGLE, agree
from .filter import ArmFilterState
from .force_doubt import ArmNoise, joint_scores
from .joints import check_joint, check_joint_angle
from .pushed_arm import PushedArm
from .state import ArmState
from .tip_force import ArmTipForce, arm_tip_force

NONE_MEASURED: Mapping[int, float] = {}

FULL_MARGIN = 1.0 - 1e-9
"""|M| / K from which on a joint that has slipped is still at its limit: others that slipped after
it may have taken it back from there"""

NOT_AT_LIMIT = -2.0
"""Deviations of g from its limit, as noisy tensions have it, from which on it is not at it"""


def arm_tip_force_of_state(
    state: ArmState | ArmFilterState,
    *,
    direction: Sequence[float],
    bend_angles: Mapping[int, float] = NONE_MEASURED,
    bend_angle_stddev: float = 0.0,
    slipping: Mapping[int, str] | None = None,
    tension_stddev: float = 0.0,
    design_covariance: DesignUncertainty | Sequence[DesignUncertainty | None] | None = None,
    level: float = 0.95,
) -> ArmTipForce:
    """Return what an arm that is followed tells of the force at its tip.

    As `arm_tip_force`, for the load of the state and its tensions at all joints. A joint that was
    measured is where it was measured; of the others the state has to do, with its deviations.
    Where a tracker or a filter has a joint slipping, still at the limit of its friction, and its
    measured angle agrees, it is taken to be there. Next to a stop the stop is taken to carry what
    friction does not.

    The load of the state is part of how it was followed, so that only measured angles tell of a
    force: of an arm of which none is measured zero is always in the set, and is the number while
    it slips. Where some are measured, the others are not taken to be at their limit.

    Parameters
    ----------
    state : ArmState or ArmFilterState
        Of a tracker or a filter.
    direction, tension_stddev, design_covariance, level
        As of `arm_tip_force`.
    bend_angles : mapping of int to float
        Measured θ in rad of joints, counted from 1 at the base.
    bend_angle_stddev : float
        Standard deviation of each measured angle in rad.
    slipping : mapping of int to str, optional
        Joint → the cables, ``s`` or ``l``, towards which it is known to be slipping, whatever the
        state has of it; all others may be at rest. By default the state says.

    Raises
    ------
    BendAngleError
        If a measured angle is not allowed, or the state has none that is assured of a joint that
        was not measured.
    TensionError, LoadError, ArmError, ValueError
        As `arm_tip_force` does.
    """
    arm = state.arm
    measured = {
        check_joint(arm, joint): check_joint_angle(arm, joint, angle)
        for joint, angle in bend_angles.items()
    }
    of_state = state.bend_angles or (0.0,) * len(arm.units)
    own_stddevs = _stddevs_of_angles(state, tension_stddev)
    angles, stddevs, at_stop = [], [], []
    slips = dict(slipping or {})
    limits = _at_limit(state, tension_stddev) if slipping is None else {}
    for index, (design, own, is_assured) in enumerate(
        zip(arm.designs, of_state, state.angles_assured, strict=True)
    ):
        number, own_stddev = index + 1, own_stddevs[index]
        angle, stddev = measured.get(index), bend_angle_stddev
        is_slipping = index in limits
        if angle is None:
            is_known = is_assured and not (own_stddev is None and tension_stddev)
            if not (is_known or state.is_slack):
                raise BendAngleError(
                    f'the bend angle of joint {number} is not assured, and none was measured'
                )
            angle, stddev = own, own_stddev or 0.0
            is_slipping = is_slipping and not measured
        elif is_slipping:
            is_slipping = agree(angle, stddev, own, own_stddev or 0.0, level)
        angles.append(angle)
        stddevs.append(stddev)
        if angle and may_be_at_stop(design, angle, stddev + SAME_ANGLE):
            at_stop.append(number)
        elif is_slipping:
            slips[number] = limits[index]
    return arm_tip_force(
        *(arm, state.cable_tensions or state.tensions),
        bend_angles=angles,
        direction=direction,
        load=state.load,
        at_stop=at_stop,
        slipping=slips,
        tension_stddev=tension_stddev,
        bend_angle_stddev=stddevs,
        design_covariance=design_covariance,
        level=level,
    )


def _at_limit(state: ArmState | ArmFilterState, tension_stddev: float) -> dict[int, str]:
    """Return the joints that slip and are at their limit, by index, and towards which cables."""
    slipping = {
        index: margin
        for index, (regime, margin) in enumerate(
            zip(state.regimes, state.slip_margins, strict=True)
        )
        if regime is Regime.SLIPPING and margin
    }
    if isinstance(state, ArmState):
        at_limit = [index for index, margin in slipping.items() if abs(margin) >= FULL_MARGIN]
    elif slipping:
        angles, stddevs = list(state.bend_angles or ()), _stddevs_of_angles(state, tension_stddev)
        known = [stddev or 0.0 for stddev in stddevs]
        pushed = PushedArm.of(state.arm, state.cable_tensions, angles, (1.0, 0.0), state.load)
        scores = joint_scores(pushed, ArmNoise(tension_stddev, known, [None] * len(known)))
        at_limit = [
            index
            for index, margin in slipping.items()
            if scores[index].towards(0.0, math.copysign(1.0, margin)) > NOT_AT_LIMIT
        ]
    else:
        at_limit = []
    return {index: 's' if slipping[index] > 0.0 else 'l' for index in at_limit}


def _stddevs_of_angles(
    state: ArmState | ArmFilterState, tension_stddev: float
) -> tuple[float | None, ...]:
    """Return the deviation in rad of each of a state's own angles, None where it is not known."""
    if isinstance(state, ArmState):
        return state.bend_angle_stddevs(tension_stddev)
    return state.bend_angle_stddevs
