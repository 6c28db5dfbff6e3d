"""What an estimator publishes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
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

SLOW_PERIOD = 0.05
"""Least time in s between two messages on a topic of which each takes long"""


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


class SlowOutput:
    """A topic whose messages take long to fill, so that not every finding is published on it."""

    def __init__(self, output: Output) -> None:
        self._output = output
        self._next = 0.0

    def publish(self, finding: Finding) -> None:
        """Publish a finding if somebody listens, and the last message is `SLOW_PERIOD` ago."""
        publisher, message, fill = self._output
        if publisher.handle.get_subscription_count() > 0 and time.monotonic() >= self._next:
            self._next = time.monotonic() + SLOW_PERIOD
            if fill(message, finding):
                publisher.publish(message)

    def replace(self, message: Any) -> None:
        """Publish something else, and the next finding whenever it comes."""
        self._output.publisher.publish(message)
        self._next = 0.0


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
    slow_fills: Mapping[str, tuple[type, Fill]] = MappingProxyType({})
    """As `fills`, of topics on which not every finding is published"""


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
        self._slow = [
            SlowOutput(Output(output_publisher(node, message_type, topic), message_type(), fill))
            for topic, (message_type, fill) in topics.slow_fills.items()
        ]
        self._markers: SlowOutput | None = None
        if draw is not None:
            publisher = output_publisher(node, MarkerArray, '~/markers')
            self._markers = SlowOutput(Output(publisher, MarkerArray(), _drawing(draw)))
            self._slow.append(self._markers)
        self._diagnostics = output_publisher(node, DiagnosticArray, '/diagnostics')

    def publish(self, estimate: Any, stamp: Callable[[], Time]) -> None:
        """Publish all of an estimate that is determined and that somebody listens to."""
        finding = Finding(estimate, self._header, stamp)
        for publisher, message, fill in self._outputs:
            # Of the handle itself, for a fifth of the time, since all are asked each time.
            if publisher.handle.get_subscription_count() > 0 and fill(message, finding):
                publisher.publish(message)
        self._latch_regimes(finding)
        for slow in self._slow:
            slow.publish(finding)

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
            self._markers.replace(no_markers(header))

    def report(self, status: DiagnosticStatus) -> None:
        """Publish a status on ``/diagnostics``."""
        self._diagnostics.publish(
            DiagnosticArray(header=Header(stamp=self._now()), status=[status])
        )

    def _now(self) -> Time:
        return self._node.get_clock().now().to_msg()


def _drawing(draw: Callable[[Any, Header], MarkerArray]) -> Fill:
    def fill(message: MarkerArray, finding: Finding) -> bool:
        message.markers = draw(finding.estimate, finding.header).markers
        return True

    return fill


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
