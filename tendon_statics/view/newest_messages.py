"""Hearing a quick topic at the price of a slow one."""

from __future__ import annotations

import math
import time
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription

from ..node.inputs.waiting_messages import waiting_messages

FITS_ALL = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
"""Goes with every publisher, and never holds one up"""

RELIABLE = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
"""Loses nothing of publishers that see to that, and does not go with others"""

LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,  # else the middleware sends nothing from before
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
"""Goes with publishers that keep what they said, and with no others"""

LOOK_PERIOD = 1.0
"""Seconds between two looks at how publishers say it"""


class _LeftAlone(CallbackGroup):
    """The group of what no executor is to take."""

    def can_execute(self, _entity: Any) -> bool:
        return False

    def beginning_execution(self, _entity: Any) -> bool:
        return False

    def ending_execution(self, _entity: Any) -> None:
        pass


class NewestMessages:
    """A subscription whose messages are taken when they are asked for, and not as they come.

    The middleware keeps the newest and drops the rest, outside Python. An executor would wake for
    each, which at 500 Hz is a fifth of a core.

    Parameters
    ----------
    depth : int
        How many of the newest messages are kept.
    """

    def __init__(self, node: Node, message_type: type, topic: str, depth: int = 1) -> None:
        self._node = node
        self._depth = depth
        qos = QoSProfile(depth=depth, reliability=FITS_ALL.reliability)
        self._subscription = listen(node, message_type, topic, qos)

    def take(self) -> list[Any]:
        """Return what has come since the last call and was kept, the oldest first."""
        return [message for message, _ in waiting_messages(self._subscription, self._depth)]

    def close(self) -> None:
        """Hear no more."""
        self._node.destroy_subscription(self._subscription)


class KeptMessages:
    """The newest message of a topic that says what holds, also one that was said before.

    A publisher that keeps nothing for those who come later is heard as well.
    """

    def __init__(self, node: Node, message_type: type, topic: str) -> None:
        self._node = node
        self._message_type = message_type
        self._topic = topic
        self._qos = FITS_ALL
        self._subscription = listen(node, message_type, topic, self._qos)
        self._look_at = -math.inf

    def take(self) -> list[Any]:
        """Return the message that has come since the last call, if there is one."""
        now = time.monotonic()
        if now >= self._look_at:
            self._look_at = now + LOOK_PERIOD
            self._fit()
        return [message for message, _ in waiting_messages(self._subscription, 1)]

    def _fit(self) -> None:
        """Ask for as much as all who publish give, since it is said once; one may come later."""
        qos = FITS_ALL
        given = [info.qos_profile for info in self._node.get_publishers_info_by_topic(self._topic)]
        if given and all(one.reliability is RELIABLE.reliability for one in given):
            is_kept = all(one.durability is LATCHED.durability for one in given)
            qos = LATCHED if is_kept else RELIABLE
        if qos is not self._qos:
            self._qos = qos
            self.close()
            self._subscription = listen(self._node, self._message_type, self._topic, qos)

    def close(self) -> None:
        """Hear no more."""
        self._node.destroy_subscription(self._subscription)


def listen(node: Node, message_type: type, topic: str, qos: QoSProfile) -> Subscription:
    """Create a subscription whose messages no executor takes."""
    return node.create_subscription(
        message_type,
        topic,
        lambda _message: None,
        qos,
        callback_group=_LeftAlone(),
        event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
    )
