"""What there is to say of a unit after one pair of tensions, topic by topic."""

from __future__ import annotations

from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray, String

from ...physics import Regime
from . import messages
from .publishers import Fill, Finding, Topics

# One function for each topic. It fills the message, or returns False where nothing is determined.


def _fill_regime(message: String, finding: Finding) -> bool:
    message.data = finding.estimate.regime.value
    return True


def _fill_bend_angle(message: Float64, finding: Finding) -> bool:
    return _fill_number(message, finding.estimate.bend_angle)


def _fill_joint_pressure(message: Float64, finding: Finding) -> bool:
    return _fill_number(message, finding.estimate.pressure)


def _fill_slip_margin(message: Float64, finding: Finding) -> bool:
    return _fill_number(message, finding.estimate.slip_margin)


def _fill_number(message: Float64, number: float | None) -> bool:
    if number is None:
        return False
    message.data = number
    return True


def _fill_joint_state(message: JointState, finding: Finding) -> bool:
    angle = finding.estimate.bend_angle
    if angle is None:
        return False
    message.header = finding.header
    message.position = [angle]
    return True


def _fill_unit_pose(message: PoseWithCovarianceStamped, finding: Finding) -> bool:
    angle = finding.estimate.bend_angle
    stddev = finding.estimate.bend_angle_stddev
    if angle is None or stddev is None:
        return False
    messages.fill_unit_pose(message, finding.estimate.design, angle, stddev, finding.header)
    return True


def _fill_admissible_angles(message: Float64MultiArray, finding: Finding) -> bool:
    if finding.estimate.regime is Regime.SLACK:
        return False
    messages.fill_intervals(message, finding.estimate.admissible_angles)
    return True


def _fill_estimate(message: messages.Estimate, finding: Finding) -> bool:
    messages.fill_estimate(message, finding.estimate, finding.header)
    return True


FILLS: dict[str, tuple[type, Fill]] = {
    '~/regime': (String, _fill_regime),
    '~/bend_angle': (Float64, _fill_bend_angle),
    '~/joint_pressure': (Float64, _fill_joint_pressure),
    '~/slip_margin': (Float64, _fill_slip_margin),
    '~/joint_state': (JointState, _fill_joint_state),
    '~/unit_pose': (PoseWithCovarianceStamped, _fill_unit_pose),
    '~/admissible_angles': (Float64MultiArray, _fill_admissible_angles),
}
"""Topic → type of its messages and what fills one"""

if not messages.INTERFACES_MISSING:
    FILLS['~/estimate'] = (messages.Estimate, _fill_estimate)


def unit_topics(joint_name: str) -> Topics:
    """Return what the estimator of a unit says of it."""
    return Topics(
        FILLS,
        (joint_name,),
        '~/regime',
        lambda estimate: estimate.regime,
        lambda regime, _header: String(data=regime),
    )
