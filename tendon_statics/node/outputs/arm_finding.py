"""What there is to say of an arm after one set of tensions, topic by topic."""

from __future__ import annotations

from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from . import arm_messages
from .publishers import Fill, Finding, Topics

# One function for each topic. It fills the message, or returns False where nothing is determined.


def _fill_regimes(message: arm_messages.JointRegimes, finding: Finding) -> bool:
    estimate = finding.estimate
    arm_messages.fill_regimes(
        message,
        estimate.settings.joint_names,
        [regime.value for regime in estimate.regimes],
        finding.header,
    )
    return True


def _fill_joint_states(message: JointState, finding: Finding) -> bool:
    angles = finding.estimate.bend_angles
    if angles is None:
        return False
    message.header = finding.header
    message.position = angles
    return True


def _fill_tip_pose(message: PoseWithCovarianceStamped, finding: Finding) -> bool:
    tip, covariance = finding.estimate.tip, finding.estimate.tip_covariance
    if tip is None or covariance is None:
        return False
    arm_messages.fill_tip_pose(message, tip, covariance, finding.header)
    return True


def _fill_arm_estimate(message: arm_messages.ArmEstimate, finding: Finding) -> bool:
    arm_messages.fill_arm_estimate(message, finding.estimate, finding.header)
    return True


def _fill_admissible_angles(message: arm_messages.AdmissibleAngles, finding: Finding) -> bool:
    arm_messages.fill_admissible_angles(message, finding.estimate, finding.header)
    return True


ARM_FILLS: dict[str, tuple[type, Fill]] = {
    '~/joint_states': (JointState, _fill_joint_states),
    '~/tip_pose': (PoseWithCovarianceStamped, _fill_tip_pose),
}
"""Topic → type of its messages and what fills one"""

if not arm_messages.ARM_INTERFACES_MISSING:
    ARM_FILLS = {
        '~/regimes': (arm_messages.JointRegimes, _fill_regimes),
        **ARM_FILLS,
        '~/arm_estimate': (arm_messages.ArmEstimate, _fill_arm_estimate),
    }


SLOW_ARM_FILLS: dict[str, tuple[type, Fill]] = {}
"""The same of what takes a tenth of a millisecond for each joint"""

if not arm_messages.ADMISSIBLE_ANGLES_MISSING:
    SLOW_ARM_FILLS['~/admissible_angles'] = (
        arm_messages.AdmissibleAngles,
        _fill_admissible_angles,
    )


def arm_topics(joint_names: tuple[str, ...]) -> Topics:
    """Return what the estimator of an arm whose joints have these names says of it."""

    def said(word: str, header: Header) -> arm_messages.JointRegimes:
        words = [word] * len(joint_names)
        return arm_messages.fill_regimes(arm_messages.JointRegimes(), joint_names, words, header)

    return Topics(
        ARM_FILLS,
        joint_names,
        '~/regimes',
        lambda estimate: estimate.regimes,
        said,
        SLOW_ARM_FILLS,
    )
