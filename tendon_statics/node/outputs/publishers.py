"""What an estimator publishes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from visualization_msgs.msg import MarkerArray

from ..overridable_qos import OVERRIDABLE
from .markers import no_markers

OUTPUT_DEPTH = 100
"""Messages kept for a subscriber that is slow"""

STATES = ('~/regime', '~/regimes', '~/markers')
"""Topics that say a state, which holds until they say another"""

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""So that who joins later hears the state; volatile subscribers fit as well"""

MARKER_PERIOD = 0.05
"""Least time in s between two drawings of the unit"""


class Finding:
    """What there is to say of one set of tensions, with a header for all that have one."""

    def __init__(self, estimate: Any, header: Header, stamp: Callable[[], Time]) -> None:
        self.estimate = estimate
        self._header = header
        self._stamp = stamp

    @cached_property
    def header(self) -> Header:
        """Header of all messages that have one, stamped when it is first asked for."""
        self._header.stamp = self._stamp()
        return self._header


Fill = Callable[[Any, Finding], bool]
"""Fills the message, or returns False where nothing is determined"""


class Output(NamedTuple):
    """A topic on which findings are published."""

    publisher: Publisher
    message: Any
    """Filled anew each time: rclpy has made a copy of it for the middleware when it returns"""
    fill: Fill


class Topics(NamedTuple):
    """What a kind of estimator says after a set of tensions, on which topics."""

    fills: Mapping[str, tuple[type, Fill]]
    """Topic → type of its messages and what fills one"""
    joint_names: Sequence[str]
    """In every `JointState`"""
    regimes_on: str
    """The topic, one of `fills`, that says the regime even where there is no estimate"""
    regimes_of: Callable[[Any], Any]
    """Returns the regimes of an estimate, to be compared with those before"""
    said: Callable[[str, Header], Any]
    """Makes a message for that topic of what is said where there is no estimate, say ``stale``"""


class Outputs:
    """The publishers of an estimator, one for each topic.

    Parameters
    ----------
    frame_id : str
        Of all headers.
    draw : callable, optional
        Makes markers of an estimate, with a header; None: there are none.
    """

    def __init__(
        self,
        node: Node,
        frame_id: str,
        topics: Topics,
        draw: Callable[[Any, Header], MarkerArray] | None,
    ) -> None:
        self._node = node
        self._header = Header(frame_id=frame_id)
        self._frame_id = frame_id
        self._topics = topics
        self._of_findings = {
            topic: Output(output_publisher(node, message_type, topic), message_type(), fill)
            for topic, (message_type, fill) in topics.fills.items()
        }
        for output in self._of_findings.values():
            if isinstance(output.message, JointState):
                output.message.name = list(topics.joint_names)
        self._outputs = tuple(self._of_findings.values())
        regimes = self._of_findings.get(topics.regimes_on)
        self._regimes = None if regimes is None else regimes.publisher
        self._latched: Any = ''
        self._draw = draw
        self._markers = output_publisher(node, MarkerArray, '~/markers') if draw else None
        self._next_drawing = 0.0
        self._diagnostics = output_publisher(node, DiagnosticArray, '/diagnostics')

    def publish(self, estimate: Any, stamp: Callable[[], Time]) -> None:
        """Publish all of an estimate that is determined and that somebody listens to."""
        finding = Finding(estimate, self._header, stamp)
        for publisher, message, fill in self._outputs:
            # Of the handle itself, for a fifth of the time, since all are asked each time.
            if publisher.handle.get_subscription_count() > 0 and fill(message, finding):
                publisher.publish(message)
        self._latch_regimes(finding)
        if (
            self._draw is not None
            and self._markers is not None
            and self._markers.handle.get_subscription_count() > 0
            and time.monotonic() >= self._next_drawing
        ):
            self._next_drawing = time.monotonic() + MARKER_PERIOD
            self._markers.publish(self._draw(estimate, finding.header))

    def say_regime(self, regime: str) -> None:
        """Publish what is said where there is no result, say ``stale``."""
        self._latched = regime
        if self._regimes is not None:
            header = Header(stamp=self._now(), frame_id=self._frame_id)
            self._regimes.publish(self._topics.said(regime, header))

    def _latch_regimes(self, finding: Finding) -> None:
        """Publish regimes that nobody hears yet, if they are others than the last."""
        regimes = self._topics.regimes_of(finding.estimate)
        if regimes != self._latched:
            self._latched = regimes
            if self._regimes is not None and self._regimes.handle.get_subscription_count() == 0:
                _, message, fill = self._of_findings[self._topics.regimes_on]
                fill(message, finding)
                self._regimes.publish(message)

    def clear_drawing(self) -> None:
        """Take away what is drawn in RViz."""
        if self._markers is not None:
            header = Header(stamp=self._now(), frame_id=self._frame_id)
            self._markers.publish(no_markers(header))
            self._next_drawing = 0.0

    def report(self, status: DiagnosticStatus) -> None:
        """Publish a status on ``/diagnostics``."""
        self._diagnostics.publish(
            DiagnosticArray(header=Header(stamp=self._now()), status=[status])
        )

    def _now(self) -> Time:
        return self._node.get_clock().now().to_msg()


def output_publisher(node: Node, message_type: type, topic: str) -> Publisher:
    """Create a publisher as all outputs have it."""
    return node.create_publisher(
        message_type,
        topic,
        LATCHED if topic in STATES else QoSProfile(depth=OUTPUT_DEPTH),
        qos_overriding_options=QoSOverridingOptions(OVERRIDABLE),
        # Its events would be waited for with every message, at more than the cost of a solve.
        # A subscriber whose QoS does not fit is warned of it by its own node.
        event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
    )
