"""What the estimator publishes."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import cached_property
from typing import Any

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

from ..physics import Equilibrium, Regime, TrackedState, admissible_angles, slip_margin
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
        result: Equilibrium | TrackedState,
        settings: Settings,
        wiring: Wiring,
        stamp: Callable[[], Time],
    ) -> None:
        self.result = result
        self.design = settings.design
        self.tension_stddev = settings.tension_stddev
        self._wiring = wiring
        self._stamp = stamp

    @property
    def joint_name(self) -> str:
        """Name of the joint."""
        return self._wiring.joint_name

    @cached_property
    def header(self) -> Header:
        """Header of all messages that have one."""
        return Header(stamp=self._stamp(), frame_id=self._wiring.frame_id)

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


# One function for each topic, which returns its message, or None where nothing is determined.


def _regime(finding: Finding) -> String:
    return String(data=finding.result.regime.value)


def _bend_angle(finding: Finding) -> Float64 | None:
    angle = finding.result.bend_angle
    return None if angle is None else Float64(data=angle)


def _joint_pressure(finding: Finding) -> Float64 | None:
    pressure = finding.result.pressure
    return None if pressure is None else Float64(data=pressure)


def _slip_margin(finding: Finding) -> Float64 | None:
    margin = finding.slip_margin
    return None if margin is None else Float64(data=margin)


def _joint_state(finding: Finding) -> JointState | None:
    angle = finding.result.bend_angle
    if angle is None:
        return None
    return JointState(header=finding.header, name=[finding.joint_name], position=[angle])


def _unit_pose(finding: Finding) -> PoseWithCovarianceStamped | None:
    angle = finding.result.bend_angle
    stddev = finding.result.bend_angle_stddev(finding.tension_stddev)
    if angle is None or stddev is None:
        return None
    return messages.unit_pose(finding.design, angle, stddev, finding.header)


def _admissible_angles(finding: Finding) -> Float64MultiArray | None:
    if finding.result.regime is Regime.SLACK:
        return None
    return messages.intervals_array(finding.admissible_angles)


def _estimate(finding: Finding) -> messages.Estimate:
    return messages.estimate(
        finding.result,
        finding.slip_margin,
        finding.admissible_angles,
        finding.tension_stddev,
        finding.header,
    )


class Outputs:
    """The publishers of the estimator, one for each topic."""

    def __init__(self, node: Node, wiring: Wiring) -> None:
        self._node = node
        self._wiring = wiring
        self._regime = self._publisher(String, '~/regime')
        self._of_findings: list[tuple[Publisher, Callable[[Finding], Any]]] = [
            (self._regime, _regime),
            (self._publisher(Float64, '~/bend_angle'), _bend_angle),
            (self._publisher(Float64, '~/joint_pressure'), _joint_pressure),
            (self._publisher(Float64, '~/slip_margin'), _slip_margin),
            (self._publisher(JointState, '~/joint_state'), _joint_state),
            (self._publisher(PoseWithCovarianceStamped, '~/unit_pose'), _unit_pose),
            (self._publisher(Float64MultiArray, '~/admissible_angles'), _admissible_angles),
        ]
        if not messages.INTERFACES_MISSING:
            estimate = self._publisher(messages.Estimate, '~/estimate')
            self._of_findings.append((estimate, _estimate))
        self._markers = self._publisher(MarkerArray, '~/markers') if wiring.markers else None
        self._next_drawing = 0.0
        self._diagnostics = self._publisher(DiagnosticArray, '/diagnostics')

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
        result: Equilibrium | TrackedState,
        settings: Settings,
        stamp: Callable[[], Time],
    ) -> None:
        """Publish all of a result that is determined and that somebody listens to."""
        finding = Finding(result, settings, self._wiring, stamp)
        for publisher, make in self._of_findings:
            # Of the handle itself, for a fifth of the time, since all are asked each time.
            if publisher.handle.get_subscription_count() > 0:
                message = make(finding)
                if message is not None:
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
