"""What the estimator publishes."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import Header, String
from visualization_msgs.msg import MarkerArray

from ...estimation.estimate import Estimate
from ..overridable_qos import OVERRIDABLE
from ..parameters.estimator import Wiring
from . import messages
from .committed import CommittedOutput
from .finding import FILLS, Fill, Finding
from .markers import no_markers, unit_markers

OUTPUT_DEPTH = 100
"""Messages kept for a subscriber that is slow"""

STATES = ('~/regime', '~/markers')
"""Topics that say a state, which holds until they say another"""

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""So that who joins later hears the state; volatile subscribers fit as well"""

MARKER_PERIOD = 0.05
"""Least time in s between two drawings of the unit"""


class Output(NamedTuple):
    """A topic on which findings are published."""

    publisher: Publisher
    message: Any
    """Filled anew each time: rclpy has made a copy of it for the middleware when it returns"""
    fill: Fill


class Outputs:
    """The publishers of the estimator, one for each topic."""

    def __init__(self, node: Node, wiring: Wiring) -> None:
        self._node = node
        self._wiring = wiring
        self._header = Header(frame_id=wiring.frame_id)
        self._of_findings = [
            Output(self._publisher(message_type, topic), message_type(), fill)
            for topic, (message_type, fill) in FILLS.items()
        ]
        for output in self._of_findings:
            if isinstance(output.message, JointState):
                output.message.name = [wiring.joint_name]
        self._regime = self._of_findings[0].publisher
        self._latched_regime = ''
        self.committed: CommittedOutput | None = None
        if wiring.estimation == 'filtering' and not messages.INTERFACES_MISSING:
            publisher = self._publisher(messages.Estimate, '~/committed_estimate')
            self.committed = CommittedOutput(publisher, wiring.frame_id)
        self._markers = self._publisher(MarkerArray, '~/markers') if wiring.markers else None
        self._next_drawing = 0.0
        self._diagnostics = self._publisher(DiagnosticArray, '/diagnostics')

    def _publisher(self, message_type: type, topic: str) -> Publisher:
        return self._node.create_publisher(
            message_type,
            topic,
            LATCHED if topic in STATES else QoSProfile(depth=OUTPUT_DEPTH),
            qos_overriding_options=QoSOverridingOptions(OVERRIDABLE),
            # Its events would be waited for with every message, at more than the cost of a solve.
            # A subscriber whose QoS does not fit is warned of it by its own node.
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
        )

    def publish(self, estimate: Estimate, stamp: Callable[[], Time]) -> None:
        """Publish all of an estimate that is determined and that somebody listens to."""
        finding = Finding(estimate, self._header, stamp)
        for publisher, message, fill in self._of_findings:
            # Of the handle itself, for a fifth of the time, since all are asked each time.
            if publisher.handle.get_subscription_count() > 0 and fill(message, finding):
                publisher.publish(message)
        self._latch_regime(estimate.regime.value)
        if (
            self._markers is not None
            and self._markers.handle.get_subscription_count() > 0
            and time.monotonic() >= self._next_drawing
        ):
            self._next_drawing = time.monotonic() + MARKER_PERIOD
            self._markers.publish(unit_markers(estimate, finding.header))

    def say_regime(self, regime: str) -> None:
        """Publish what is said where there is no result, say ``stale``."""
        self._latched_regime = regime
        self._regime.publish(String(data=regime))

    def _latch_regime(self, regime: str) -> None:
        """Publish a regime that nobody hears yet, if it is another than the last."""
        if regime != self._latched_regime:
            if self._regime.handle.get_subscription_count() == 0:
                self.say_regime(regime)
            self._latched_regime = regime

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
