"""What there is to say of one pair of tensions, topic by topic."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray, Header, String

from ...estimation.settings import Settings
from ...physics import Equilibrium, Regime
from . import messages


class Finding:
    """What there is to say of one pair of tensions, worked out when it is asked for."""

    def __init__(
        self,
        result: Equilibrium,
        settings: Settings,
        header: Header,
        stamp: Callable[[], Time],
        *,
        load_assured: bool,
    ) -> None:
        self.result = result
        self.load_assured = load_assured
        self.design = settings.design
        self.tension_stddev = settings.tension_stddev
        self._header = header
        self._stamp = stamp

    @cached_property
    def header(self) -> Header:
        """Header of all messages that have one, stamped when it is first asked for."""
        self._header.stamp = self._stamp()
        return self._header

    @cached_property
    def slip_margin(self) -> float | None:
        """M / K at the bend angle; None where that is not determined."""
        return self.result.slip_margin

    @cached_property
    def admissible_angles(self) -> list[tuple[float, float]]:
        """Intervals in which friction can hold the unit; none while a cable is slack."""
        return self.result.admissible_angles


Fill = Callable[[Any, Finding], bool]

# One function for each topic. It fills the message, or returns False where nothing is determined.


def _fill_regime(message: String, finding: Finding) -> bool:
    message.data = finding.result.regime.value
    return True


def _fill_bend_angle(message: Float64, finding: Finding) -> bool:
    return _fill_number(message, finding.result.bend_angle)


def _fill_joint_pressure(message: Float64, finding: Finding) -> bool:
    return _fill_number(message, finding.result.pressure)


def _fill_slip_margin(message: Float64, finding: Finding) -> bool:
    return _fill_number(message, finding.slip_margin)


def _fill_number(message: Float64, number: float | None) -> bool:
    if number is None:
        return False
    message.data = number
    return True


def _fill_joint_state(message: JointState, finding: Finding) -> bool:
    angle = finding.result.bend_angle
    if angle is None:
        return False
    message.header = finding.header
    message.position = [angle]
    return True


def _fill_unit_pose(message: PoseWithCovarianceStamped, finding: Finding) -> bool:
    angle = finding.result.bend_angle
    stddev = finding.result.bend_angle_stddev(finding.tension_stddev)
    if angle is None or stddev is None:
        return False
    messages.fill_unit_pose(message, finding.design, angle, stddev, finding.header)
    return True


def _fill_admissible_angles(message: Float64MultiArray, finding: Finding) -> bool:
    if finding.result.regime is Regime.SLACK:
        return False
    messages.fill_intervals(message, finding.admissible_angles)
    return True


def _fill_estimate(message: messages.Estimate, finding: Finding) -> bool:
    messages.fill_estimate(
        message,
        finding.result,
        finding.slip_margin,
        finding.admissible_angles,
        finding.tension_stddev,
        finding.header,
        load_assured=finding.load_assured,
    )
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
