"""Subscriptions of the estimator: what comes on them, what is lost, who is not heard."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSCompatibility, QoSProfile, ReliabilityPolicy, qos_check_compatible
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo

from ...estimation.health import Health
from ..overridable_qos import OVERRIDABLE
from .lost_messages import LostMessages
from .tension_source import TensionSource
from .waiting_messages import waiting_messages

INPUT_DEPTH = 1000
"""Messages kept while the node is busy, so that a burst or a stall loses none."""

MOST_AT_ONCE = 100
"""Messages taken in a row before services and timers have their turn"""


class Subscriptions:
    """All subscriptions of an estimator; what they take reaches it while it is active.

    Parameters
    ----------
    is_active : callable
        Whether messages are to be taken.
    sees_numbers : bool
        Whether a message comes with its number and its time of arrival; EventsExecutor fails on
        callbacks that take them.
    """

    def __init__(
        self,
        node: Node,
        source: TensionSource,
        health: Health,
        is_active: Callable[[], bool],
        *,
        sees_numbers: bool,
    ) -> None:
        self.arrival = 0
        """When the present message of tensions arrived, in ns since 1970"""
        self._node = node
        self._source = source
        self._health = health
        self._is_active = is_active
        self._sees_numbers = sees_numbers
        self._lost: dict[str, LostMessages] = {}
        self._by_topic: dict[str, Subscription] = {}
        self._tensions = {
            topic: self._add_tensions(topic, *of_topic)
            for topic, of_topic in source.inputs.items()
        }

    def add(self, topic: str, message_type: type, take: Callable[[Any], None]) -> None:
        """Subscribe to what is no tensions."""

        def on_message(message: Any) -> None:
            if self._is_active():
                take(message)

        self._subscribe(topic, message_type, on_message)

    def _add_tensions(
        self, topic: str, message_type: type, take: Callable[[Any, int], None]
    ) -> Subscription:
        """Subscribe to a topic of the source; count what comes and what is lost on the way."""
        lost = self._lost[topic] = LostMessages()
        health, is_foreign = self._health, self._source.is_foreign

        def take_arrived(message: Any, arrival: int | None) -> None:
            if not self._is_active():
                return
            if is_foreign(message):
                health.foreign += 1
                return
            self.arrival = arrival or time.time_ns()
            health.received += 1
            take(message, self.arrival)

        def on_message(message: Any) -> None:
            take_arrived(message, None)

        # A middleware may leave out any part of the info, or say 0.
        def on_numbered_message(message: Any, info: dict[str, int | None]) -> None:
            lost.note(info.get('publication_sequence_number'))
            take_arrived(message, info.get('received_timestamp'))

        def on_numbered_messages(message: Any, info: dict[str, int | None]) -> None:
            on_numbered_message(message, info)
            for waiting in waiting_messages(subscription, MOST_AT_ONCE):
                on_numbered_message(*waiting)

        subscription = self._subscribe(
            topic, message_type, on_numbered_messages if self._sees_numbers else on_message
        )
        return subscription

    def _subscribe(
        self, topic: str, message_type: type, callback: Callable[..., None]
    ) -> Subscription:
        self._by_topic[topic] = self._node.create_subscription(
            message_type,
            topic,
            callback,
            QoSProfile(depth=INPUT_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT),
            qos_overriding_options=QoSOverridingOptions(OVERRIDABLE),
            # As of the outputs; of a publisher that does not fit /diagnostics tells.
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )
        return self._by_topic[topic]

    @property
    def tension_topics(self) -> str:
        """The topics of tensions, as a person reads them."""
        return ' and '.join(of.topic_name for of in self._tensions.values())

    @property
    def expects_one_publisher(self) -> bool:
        """Whether each topic of tensions is to have one publisher alone."""
        return self._source.has_one_publisher

    def let_pass_what_waits(self) -> None:
        """Take the messages that came while inactive, which are not of the present."""
        for lost in self._lost.values():
            lost.forget()
        for subscription in self._by_topic.values():
            for _ in waiting_messages(subscription, INPUT_DEPTH):
                pass

    @property
    def losses_are_counted(self) -> bool:
        """Whether the middleware numbers messages."""
        return all(lost.are_counted for lost in self._lost.values())

    def settle_losses(self) -> int:
        """Return how many messages of tensions turned out to be lost since the last call."""
        count = 0
        for topic, subscription in self._tensions.items():
            heard = [
                tuple(info.endpoint_gid)
                for info in self._node.get_publishers_info_by_topic(topic)
                if not self._misfit_of(info, subscription)
            ]
            count += self._lost[topic].settle(heard)
        return count

    def publishers_of_tensions(self) -> dict[str, int]:
        """Topic of tensions → how many publish on it."""
        return {of.topic_name: of.get_publisher_count() for of in self._tensions.values()}

    def misfits(self) -> list[str]:
        """Say which publishers are not heard, and why."""
        misfits = [
            f'{subscription.topic_name} is published {misfit}'
            for topic, subscription in self._by_topic.items()
            # Of the topic before it is remapped, which this does itself.
            for info in self._node.get_publishers_info_by_topic(topic)
            if (misfit := self._misfit_of(info, subscription))
        ]
        return list(dict.fromkeys(misfits))

    def _misfit_of(self, publisher: TopicEndpointInfo, subscription: Subscription) -> str:
        taken = type_name(subscription.msg_type)
        if publisher.topic_type != taken:
            taker = 'it'
            if subscription in self._tensions.values():
                taker = f'tension_source {self._source.kind}'
            return f'as {publisher.topic_type}, but {taker} takes {taken}'
        fit, reason = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
        if fit == QoSCompatibility.ERROR:
            return f'with a quality of service that does not fit: {reason.rstrip("; ")}'
        return ''


def type_name(message_type: type) -> str:
    """Return a type as ROS writes it, say ``std_msgs/msg/String``."""
    package, kind, *_ = message_type.__module__.split('.')
    return f'{package}/{kind}/{message_type.__name__}'
