"""What the estimator publishes."""

from __future__ import annotations

import time

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped
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


class Outputs:
    """The publishers of the estimator, one for each topic."""

    def __init__(self, node: Node, wiring: Wiring) -> None:
        self._node = node
        self._wiring = wiring
        self._regime = self._publisher(String, '~/regime')
        self._bend_angle = self._publisher(Float64, '~/bend_angle')
        self._joint_pressure = self._publisher(Float64, '~/joint_pressure')
        self._unit_pose = self._publisher(PoseWithCovarianceStamped, '~/unit_pose')
        self._joint_state = self._publisher(JointState, '~/joint_state')
        self._slip_margin = self._publisher(Float64, '~/slip_margin')
        self._admissible_angles = self._publisher(Float64MultiArray, '~/admissible_angles')
        self._diagnostics = self._publisher(DiagnosticArray, '/diagnostics')
        self._estimate = self._markers = None
        if not messages.INTERFACES_MISSING:
            self._estimate = self._publisher(messages.Estimate, '~/estimate')
        if wiring.markers:
            self._markers = self._publisher(MarkerArray, '~/markers')
        self._next_drawing = 0.0

    def _publisher(self, message_type: type, topic: str) -> Publisher:
        return self._node.create_publisher(
            message_type,
            topic,
            QoSProfile(depth=OUTPUT_DEPTH),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def publish(self, result: Equilibrium | TrackedState, settings: Settings, stamp: Time) -> None:
        """Publish all of a result that is determined, and nothing else."""
        design, stddev = settings.design, settings.tension_stddev
        header = self._header(stamp)
        self._regime.publish(String(data=result.regime.value))
        margin = None
        if result.bend_angle is not None:
            margin = slip_margin(design, result.tension_l, result.tension_s, result.bend_angle)
            self._bend_angle.publish(Float64(data=result.bend_angle))
            self._slip_margin.publish(Float64(data=margin))
            self._joint_state.publish(
                JointState(
                    header=header, name=[self._wiring.joint_name], position=[result.bend_angle]
                )
            )
            angle_stddev = result.bend_angle_stddev(stddev)
            if angle_stddev is not None:
                pose = messages.unit_pose(design, result.bend_angle, angle_stddev, header)
                self._unit_pose.publish(pose)
        if result.pressure is not None:
            self._joint_pressure.publish(Float64(data=result.pressure))
        intervals = []
        if result.regime is not Regime.SLACK:
            intervals = admissible_angles(design, result.tension_l, result.tension_s)
            self._admissible_angles.publish(messages.intervals_array(intervals))
        if self._estimate is not None:
            self._estimate.publish(messages.estimate(result, margin, intervals, stddev, header))
        if self._markers is not None and time.monotonic() >= self._next_drawing:
            self._next_drawing = time.monotonic() + MARKER_PERIOD
            self._markers.publish(unit_markers(design, result, intervals, header))

    def say_regime(self, regime: str) -> None:
        """Publish a regime that comes with no result: `INVALID` or `STALE`."""
        self._regime.publish(String(data=regime))

    def clear_drawing(self) -> None:
        """Take away what is drawn in RViz."""
        if self._markers is not None:
            self._markers.publish(no_markers(self._header(self._now())))
            self._next_drawing = 0.0

    def report(self, status: DiagnosticStatus) -> None:
        """Publish a status on ``/diagnostics``."""
        self._diagnostics.publish(
            DiagnosticArray(header=Header(stamp=self._now()), status=[status])
        )

    def _header(self, stamp: Time) -> Header:
        return Header(stamp=stamp, frame_id=self._wiring.frame_id)

    def _now(self) -> Time:
        return self._node.get_clock().now().to_msg()
