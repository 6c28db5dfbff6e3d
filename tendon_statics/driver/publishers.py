"""How motor drivers publish tensions: one class for each kind that the estimator takes.

Each fills one and the same message again and again, which is most of the speed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from geometry_msgs.msg import WrenchStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, Header

DEPTH = 1000
"""Room for a batch."""


class TensionPublisher(Protocol):
    """Publishes the raw values of all cables, of which one may be missing."""

    def subscription_count(self) -> int:
        """Subscribers on that topic which has the fewest."""

    def publish(self, raw: Sequence[float], stamp: int, missing: int | None) -> int:
        """Publish one value a cable with a stamp in ns; return how many messages that took.

        `missing` is the cable that is left out, counted from 0: of a unit 0 is l and 1 is s.
        """


class ArrayPublisher:
    """``std_msgs/Float64MultiArray`` on ``tensions``, without a stamp: [T_l, T_s], or an arm's."""

    def __init__(self, node: Node) -> None:
        self._tensions = node.create_publisher(Float64MultiArray, 'tensions', DEPTH)
        self._message = Float64MultiArray()

    def subscription_count(self) -> int:
        """Subscribers on ``tensions``."""
        count: int = self._tensions.get_subscription_count()
        return count

    def publish(self, raw: Sequence[float], _stamp: int, missing: int | None) -> int:
        """Publish one message, shorter by the value that is missing."""
        self._message.data = [value for cable, value in enumerate(raw) if cable != missing]
        self._tensions.publish(self._message)
        return 1


class JointStatePublisher:
    """``sensor_msgs/JointState`` on ``tensions`` with the tensions in ``effort``."""

    def __init__(self, node: Node, cable_names: Sequence[str]) -> None:
        self._tensions = node.create_publisher(JointState, 'tensions', DEPTH)
        self._cable_names = list(cable_names)
        self._message = JointState()

    def subscription_count(self) -> int:
        """Subscribers on ``tensions``."""
        count: int = self._tensions.get_subscription_count()
        return count

    def publish(self, raw: Sequence[float], stamp: int, missing: int | None) -> int:
        """Publish one message; the first cable may be missing, or the effort of another."""
        names, effort = self._cable_names, list(raw)
        if missing is not None:
            del effort[missing]
            names = names[1:] if missing == 0 else names
        _put_stamp(self._message.header, stamp)
        self._message.name = names
        self._message.effort = effort
        self._tensions.publish(self._message)
        return 1


class WrenchPairPublisher:
    """Two ``geometry_msgs/WrenchStamped``, on ``tension_l`` and ``tension_s``."""

    def __init__(self, node: Node, component: str) -> None:
        self._cables = [
            node.create_publisher(WrenchStamped, topic, DEPTH)
            for topic in ('tension_l', 'tension_s')
        ]
        self._component = 'z' if component == 'norm' else component
        self._message = WrenchStamped()

    def subscription_count(self) -> int:
        """Subscribers on that of the two topics which has fewer."""
        return min(publisher.get_subscription_count() for publisher in self._cables)

    def publish(self, raw: Sequence[float], stamp: int, missing: int | None) -> int:
        """Publish two messages, or one if one is missing."""
        _put_stamp(self._message.header, stamp)
        for cable, (publisher, value) in enumerate(zip(self._cables, raw, strict=True)):
            if cable != missing:
                setattr(self._message.wrench.force, self._component, value)
                publisher.publish(self._message)
        return 2 if missing is None else 1


def _put_stamp(header: Header, stamp: int) -> None:
    header.stamp.sec, header.stamp.nanosec = divmod(stamp, 1_000_000_000)
