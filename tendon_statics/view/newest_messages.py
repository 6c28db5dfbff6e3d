"""Hearing a quick topic at the price of a slow one."""

from __future__ import annotations

from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from ..node.inputs.waiting_messages import waiting_messages

FITS_ALL = {'reliability': ReliabilityPolicy.BEST_EFFORT}
"""Goes with every publisher, and never holds one up"""

LATCHED = {
    'reliability': ReliabilityPolicy.RELIABLE,  # else the middleware sends nothing from before
    'durability': DurabilityPolicy.TRANSIENT_LOCAL,
}
"""Goes with publishers that keep what they said, and with no others"""


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
    is_latched : bool
        Whether those count too that came before, of a publisher that keeps them.
    """

    def __init__(
        self,
        node: Node,
        message_type: type,
        topic: str,
        depth: int = 1,
        *,
        is_latched: bool = False,
    ) -> None:
        self._node = node
        self._depth = depth
        self._subscription = node.create_subscription(
            message_type,
            topic,
            lambda _message: None,
            QoSProfile(depth=depth, **(LATCHED if is_latched else FITS_ALL)),
            callback_group=_LeftAlone(),
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )

    def take(self) -> list[Any]:
        """Return what has come since the last call and was kept, the oldest first."""
        return [message for message, _ in waiting_messages(self._subscription, self._depth)]

    def close(self) -> None:
        """Hear no more."""
        self._node.destroy_subscription(self._subscription)


def has_volatile_publisher(node: Node, topic: str) -> bool:
    """Whether somebody publishes there who keeps nothing for those who come later."""
    return any(
        publisher.qos_profile.durability is DurabilityPolicy.VOLATILE
        for publisher in node.get_publishers_info_by_topic(topic)
    )
