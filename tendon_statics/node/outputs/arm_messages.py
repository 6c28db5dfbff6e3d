"""Between ROS messages and the physics of an arm."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import Header

from ...estimation.arm_estimate import ArmEstimate as ArmAnswer
from ...physics import Regime
from ...physics.arm import TipPose
from . import messages

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = [
    'ADMISSIBLE_ANGLES_MISSING',
    'ARM_INTERFACES_MISSING',
    'AdmissibleAngles',
    'ArmEstimate',
    'JointRegimes',
    'SolveArm',
    'fill_admissible_angles',
    'fill_arm_estimate',
    'fill_regimes',
    'fill_solve_arm',
    'fill_tip_pose',
    'refuse_solve_arm',
]

# The node works without the package nested in interfaces/, but offers less.
try:
    from tendon_statics_interfaces.msg import ArmEstimate, JointRegimes
    from tendon_statics_interfaces.srv import SolveArm
except ImportError as _error:
    ArmEstimate = JointRegimes = SolveArm = None
    ARM_INTERFACES_MISSING = str(_error)
else:
    ARM_INTERFACES_MISSING = ''

try:
    from tendon_statics_interfaces.msg import AdmissibleAngles
except ImportError as _error:  # also of interfaces that have all but this
    AdmissibleAngles = None
    ADMISSIBLE_ANGLES_MISSING = str(_error)
else:
    ADMISSIBLE_ANGLES_MISSING = ''

_NOWHERE = TipPose(math.nan, math.nan, math.nan)

_PROBABLE = (Regime.HELD, Regime.SLIPPING, Regime.DRIVEN_TO_STOP, Regime.SLACK)
"""Regimes that a joint of an arm can be in"""

_IN_POSE = (0, 2, 4)
"""Of position x, y, z and rotation about x, y, z those that an arm in its plane has"""


def fill_arm_estimate(message: ArmEstimate, estimate: ArmAnswer, header: Header) -> ArmEstimate:
    """Put all that is known from one set of tensions into a message.

    It is NaN or False where it is not known, whatever was in the message before.
    """
    settings, load = estimate.settings, estimate.known.load
    count = len(settings.joint_names)
    message.header = header
    message.joint_names = list(settings.joint_names)
    message.regimes = [regime.value for regime in estimate.regimes]
    message.bend_angles = _angles(estimate)
    message.bend_angle_stddevs = _numbers(estimate.bend_angle_stddevs)
    intervals = [of or (math.nan, math.nan) for of in estimate.intervals or [None] * count]
    message.bend_angle_lows = [low for low, _ in intervals]
    message.bend_angle_highs = [high for _, high in intervals]
    message.angles_assured = list(estimate.angles_assured)
    message.provisional = estimate.is_provisional
    probabilities = estimate.regime_probabilities or [{}] * count
    (
        message.probabilities_held,
        message.probabilities_slipping,
        message.probabilities_driven_to_stop,
        message.probabilities_slack,
    ) = ([of.get(regime, math.nan) for of in probabilities] for regime in _PROBABLE)
    message.slip_margins = _numbers(estimate.slip_margins)
    message.pressures = _numbers(estimate.pressures)
    _fill_tip(message, estimate)
    message.cable_names = list(settings.arm.cable_names)
    message.tensions = list(estimate.state.tensions.values())
    (
        message.gravity_direction_x,
        message.gravity_direction_y,
        message.gravity_direction_z,
    ) = load.gravity_direction
    message.tip_force_x, message.tip_force_z = load.tip_force
    message.load_assured = estimate.known.is_assured
    return message


def _fill_tip(message: ArmEstimate, estimate: ArmAnswer) -> None:
    message.tip_x, message.tip_z, message.tip_tilt = estimate.tip or _NOWHERE
    covariance = estimate.tip_covariance
    deviations: Iterable[float] = _NOWHERE
    if covariance is not None:
        deviations = (math.sqrt(max(float(of), 0.0)) for of in covariance.diagonal())
    message.tip_x_stddev, message.tip_z_stddev, message.tip_tilt_stddev = deviations
    low, high = estimate.tip_interval or (_NOWHERE, _NOWHERE)
    message.tip_x_low, message.tip_z_low, message.tip_tilt_low = low
    message.tip_x_high, message.tip_z_high, message.tip_tilt_high = high


def fill_tip_pose(
    message: PoseWithCovarianceStamped,
    tip: TipPose,
    covariance: NDArray[np.float64],
    header: Header,
) -> PoseWithCovarianceStamped:
    """Put the pose of the end of the last unit in the base's frame into a message.

    Its Z is along that unit. What leaves the plane of bending has no covariance.

    Parameters
    ----------
    covariance : array
        Of x, z and the tilt.
    """
    message.header = header
    pose = message.pose.pose
    pose.position.x, pose.position.z = tip.x, tip.z
    pose.orientation.y = math.sin(0.5 * tip.tilt)
    pose.orientation.w = math.cos(0.5 * tip.tilt)
    found = [0.0] * 36
    for row, of_row in zip(_IN_POSE, covariance.tolist(), strict=True):
        for column, value in zip(_IN_POSE, of_row, strict=True):
            found[6 * row + column] = value
    message.pose.covariance = found
    return message


def fill_admissible_angles(
    message: AdmissibleAngles, estimate: ArmAnswer, header: Header
) -> AdmissibleAngles:
    """Put the angles at which friction can hold each joint into a message."""
    found = [
        (joint, *interval)
        for joint, intervals in enumerate([] if estimate.state.is_slack else estimate.bands, 1)
        for interval in intervals
    ]
    message.header = header
    message.joint_names = list(estimate.settings.joint_names)
    message.joints = [joint for joint, _, _ in found]
    message.lows = [low for _, low, _ in found]
    message.highs = [high for _, _, high in found]
    return message


def fill_regimes(
    message: JointRegimes, joint_names: Sequence[str], regimes: Sequence[str], header: Header
) -> JointRegimes:
    """Put the regimes of all joints into a message."""
    message.header = header
    message.joint_names = list(joint_names)
    message.regimes = list(regimes)
    return message


def fill_solve_arm(response: SolveArm.Response, estimate: ArmAnswer) -> SolveArm.Response:
    """Put an answer into a response of ``~/solve_arm``."""
    response.success = True
    response.joint_names = list(estimate.settings.joint_names)
    response.regimes = [regime.value for regime in estimate.regimes]
    response.bend_angles = _angles(estimate)
    response.slip_margins = _numbers(estimate.slip_margins)
    response.pressures = _numbers(estimate.pressures)
    response.tip_x, response.tip_z, response.tip_tilt = estimate.tip or _NOWHERE
    response.load_assured = estimate.known.is_assured
    return response


def refuse_solve_arm(response: Any, reason: str) -> Any:
    """Put the reason for no answer into a response of ``~/solve_arm``."""
    messages.refuse(response, reason)
    response.tip_x, response.tip_z, response.tip_tilt = _NOWHERE
    return response


def _angles(estimate: ArmAnswer) -> list[float]:
    return _numbers(estimate.bend_angles or (None,) * len(estimate.regimes))


def _numbers(values: Iterable[float | None]) -> list[float]:
    return [math.nan if value is None else value for value in values]
