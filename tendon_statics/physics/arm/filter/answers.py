"""From the members of an arm's filter to what it says."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...filter import FilterState
from ...filter.recent import Sample
from ...load import Load
from ..arm import Arm
from ..cables import Crossing, pair_at
from .ensemble import ArmEnsemble, JointSlips
from .follow import Place
from .state import ArmFilterState

Floats = NDArray[np.float64]


def state_at(
    ensemble: ArmEnsemble,
    sample: Sample,
    tensions: Sequence[float],
    path: Sequence[Place],
    member_tensions: Floats,
    tension_errors: Floats,
    *,
    provisional: bool,
    assured: Sequence[bool],
) -> ArmFilterState:
    """Return the state at a sample.

    Parameters
    ----------
    tensions : sequence of float
        At the base in N, as given or smoothed.
    path : sequence of Place
        Where the members were before it, and are then.
    member_tensions : ndarray
        Of the members at the base in N, shape ``(cables, members)``.
    tension_errors : ndarray
        Standard errors of smoothed tensions in N, shape ``(cables,)``.
    assured : sequence of bool
        Of each joint.
    """
    before, place = path
    arms = ensemble.arms
    arm = arms.arm
    drawn = ensemble.drawn(member_tensions, place, sample.load)
    turning = drawn.moment / arms.levers
    pairs = 0.5 * np.array([drawn.total - turning, drawn.total + turning])
    at_joints = [list(tensions)] * arms.count
    if drawn.at is not None:
        at_joints = np.median(drawn.at, axis=0).tolist()
    moved = place.angles != before.angles
    joints = tuple(
        FilterState(
            *(design, sample.load, sample.time, pair_at(arms.crossing[joint], at_joints[joint])),
            angles=place.angles[:, joint],
            moved=moved[:, joint],
            slips=JointSlips(
                *(ensemble, joint, sample.load, pairs[..., joint], place.angles),
                tension_errors[arms.adds[:, joint] > 0.0],
            ),
            provisional=provisional,
            assured=assured[joint],
        )
        for joint, design in enumerate(arm.designs)
    )
    return ArmFilterState(
        *(arm, sample.load, sample.time, dict(zip(arm.cable_names, tensions, strict=True))),
        joints=joints,
        cable_tensions={
            cable.name: tuple([at[index] for at in at_joints[: cable.last_unit]])
            for index, cable in enumerate(arm.cables)
        },
        members=place.angles,
        provisional=provisional,
    )


def slack_state(
    arm: Arm, crossing: list[Crossing], at_base: list[float], time: float, load: Load
) -> ArmFilterState:
    """Say nothing of an arm of which some joint is loose: the others carry it."""
    return ArmFilterState(
        *(arm, load, time, dict(zip(arm.cable_names, at_base, strict=True))),
        joints=tuple(
            FilterState.slack(design, load, time, pair_at(of_joint, at_base))
            for design, of_joint in zip(arm.designs, crossing, strict=True)
        ),
        cable_tensions={
            cable.name: (tension,) * cable.last_unit
            for cable, tension in zip(arm.cables, at_base, strict=True)
        },
        members=np.empty((0, len(arm.units))),
        provisional=True,
    )


def single_state(arm: Arm, state: FilterState) -> ArmFilterState:
    """Say of an arm of one unit what the filter of that says."""
    by_side = {'l': state.tension_l, 's': state.tension_s}
    tensions = {cable.name: by_side[cable.side] for cable in arm.cables}
    return ArmFilterState(
        *(arm, state.load, state.time, tensions),
        joints=(state,),
        cable_tensions={name: (tension,) for name, tension in tensions.items()},
        members=state.members[:, None],
        provisional=state.provisional,
    )
