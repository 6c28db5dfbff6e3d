"""The services of the estimator of an arm, beside those that every estimator has."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

from ..estimation.arm_estimate import ArmEstimate
from ..physics import ArmError, BendAngleError, LoadError, TensionError
from ..physics.arm import Arm, ArmTracker
from .outputs import arm_messages, messages
from .services import offer, say_interfaces_are_missing

if TYPE_CHECKING:
    from .arm_estimator import ArmEstimator


def offer_arm_services(node: ArmEstimator) -> None:
    """Offer them, as far as the interfaces are there."""
    if arm_messages.ARM_INTERFACES_MISSING:
        say_interfaces_are_missing(
            node,
            '~/solve_arm',
            '~/arm_estimate',
            '~/regimes',
            '~/admissible_angles',
            why=arm_messages.ARM_INTERFACES_MISSING,
        )
        return
    if arm_messages.ADMISSIBLE_ANGLES_MISSING:
        say_interfaces_are_missing(
            node, '~/admissible_angles', why=arm_messages.ADMISSIBLE_ANGLES_MISSING
        )
    offer(
        node,
        arm_messages.SolveArm,
        'solve_arm',
        functools.partial(_solve, node),
        arm_messages.refuse_solve_arm,
    )


def _solve(
    node: ArmEstimator,
    request: arm_messages.SolveArm.Request,
    response: arm_messages.SolveArm.Response,
) -> arm_messages.SolveArm.Response:
    arm = node.arm
    try:
        known = messages.asked_load(request, node.known_load())
        tensions = asked_tensions(arm, request)
        if request.bend_angles:
            state = ArmTracker(arm, request.bend_angles).update(tensions, known.load)
            estimate = ArmEstimate(state, known, node.core.settings)
        else:
            estimate = node.core.imagine(tuple(arm.check_tensions(tensions)), known)
    except (ArmError, BendAngleError, LoadError, TensionError) as error:
        return arm_messages.refuse_solve_arm(response, str(error))
    return arm_messages.fill_solve_arm(response, estimate)


def asked_tensions(arm: Arm, request: Any) -> dict[str, float]:
    """Return the tensions of a request in N by the cable.

    Raises
    ------
    TensionError
        If there is not one for each cable that is named, or one is named twice.
    """
    names = list(request.cable_names) or list(arm.cable_names)
    if len(names) != len(request.tensions):
        raise TensionError(
            f'{len(request.tensions)} tensions came for {len(names)} cables, '
            f'{", ".join(names)}: one is needed for each'
        )
    if len(set(names)) != len(names):
        raise TensionError(f'cable_names is {names!r}: each cable stands in it once')
    return dict(zip(names, map(float, request.tensions), strict=True))
