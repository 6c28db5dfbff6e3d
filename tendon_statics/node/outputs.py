"""What the estimator publishes."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import cached_property
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray, Header, String
from visualization_msgs.msg import MarkerArray

from ..physics import Equilibrium, Regime, admissible_angles, slip_margin
from . import messages
from .markers import no_markers, unit_markers
from .settings import Settings
from .wiring import Wiring

INVALID = 'invalid'
"""What ``~/regime`` says of a message that holds no pair of tensions."""

STALE = 'stale'
"""What ``~/regime`` says once when no more valid tensions come."""

OUTPUT_DEPTH = 100
"""Messages kept for a subscriber that is slow"""

MARKER_PERIOD = 0.05
"""Least time in s between two drawings of the unit"""


class Finding:
    """What there is to say of one pair of tensions, worked out when it is asked for."""

    def __init__(
        self,
        result: Equilibrium,
        settings: Settings,
        header: Header,
        stamp: Callable[[], Time],
    ) -> None:
        self.result = result
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
        """`slip_margin` at the bend angle; None where that is not determined."""
        result = self.result
        if result.bend_angle is None:
            return None
        return slip_margin(self.design, result.tension_l, result.tension_s, result.bend_angle)

    @cached_property
    def admissible_angles(self) -> list[tuple[float, float]]:
        """Intervals in which friction can hold the unit; none while a cable is slack."""
        result = self.result
        if result.regime is Regime.SLACK:
            return []
        return admissible_angles(self.design, result.tension_l, result.tension_s)


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
    )
    return True


class Output(NamedTuple):
    """A topic on which findings are published."""

    publisher: Publisher
    message: Any
    """Filled anew each time: rclpy has made a copy of it for the middleware when it returns"""
    fill: Callable[[Any, Finding], bool]


class Outputs:
    """The publishers of the estimator, one for each topic."""

    def __init__(self, node: Node, wiring: Wiring) -> None:
        self._node = node
        self._wiring = wiring
        self._header = Header(frame_id=wiring.frame_id)
        joint_state = JointState(name=[wiring.joint_name])
        self._of_findings = [
            self._output('~/regime', String(), _fill_regime),
            self._output('~/bend_angle', Float64(), _fill_bend_angle),
            self._output('~/joint_pressure', Float64(), _fill_joint_pressure),
            self._output('~/slip_margin', Float64(), _fill_slip_margin),
            self._output('~/joint_state', joint_state, _fill_joint_state),
            self._output('~/unit_pose', PoseWithCovarianceStamped(), _fill_unit_pose),
            self._output('~/admissible_angles', Float64MultiArray(), _fill_admissible_angles),
        ]
        if not messages.INTERFACES_MISSING:
            self._of_findings.append(
                self._output('~/estimate', messages.Estimate(), _fill_estimate)
            )
        self._regime = self._of_findings[0].publisher
        self._markers = self._publisher(MarkerArray, '~/markers') if wiring.markers else None
        self._next_drawing = 0.0
        self._diagnostics = self._publisher(DiagnosticArray, '/diagnostics')

    def _output(self, topic: str, message: Any, fill: Callable[[Any, Finding], bool]) -> Output:
        return Output(self._publisher(type(message), topic), message, fill)

    def _publisher(self, message_type: type, topic: str) -> Publisher:
        return self._node.create_publisher(
            message_type,
            topic,
            QoSProfile(depth=OUTPUT_DEPTH),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
            # Its events would be waited for with every message, at more than the cost of a solve.
            # A subscriber whose QoS does not fit is warned of it by its own node.
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
        )

    def publish(
        self,
        result: Equilibrium,
        settings: Settings,
        stamp: Callable[[], Time],
    ) -> None:
        """Publish all of a result that is determined and that somebody listens to."""
        finding = Finding(result, settings, self._header, stamp)
        for publisher, message, fill in self._of_findings:
            # Of the handle itself, for a fifth of the time, since all are asked each time.
            if publisher.handle.get_subscription_count() > 0 and fill(message, finding):
                publisher.publish(message)
        if (
            self._markers is not None
            and self._markers.handle.get_subscription_count() > 0
            and time.monotonic() >= self._next_drawing
        ):
            self._next_drawing = time.monotonic() + MARKER_PERIOD
            self._markers.publish(
                unit_markers(settings.design, result, finding.admissible_angles, finding.header)
            )

    def say_regime(self, regime: str) -> None:
        """Publish a regime that comes with no result: `INVALID` or `STALE`."""
        self._regime.publish(String(data=regime))

    def clear_drawing(self) -> None:
        """Take away what is drawn in RViz."""
        if self._markers is not None:
            header = Header(stamp=self._now(), frame_id=self._wiring.frame_id)
            self._markers.publish(no_markers(header))
            self._next_drawing = 0.0

    def report(self, status: DiagnosticStatus) -> None:
        """Publish a status on ``/diagnostics``."""
        self._diagnostics.publish(
            DiagnosticArray(header=Header(stamp=self._now()), status=[status])
        )

    def _now(self) -> Time:
        return self._node.get_clock().now().to_msg()
