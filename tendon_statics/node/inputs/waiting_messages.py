"""Messages that wait in the middleware, taken without the executor."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rclpy.subscription import Subscription


def waiting_messages(
    subscription: Subscription, most: int
) -> Iterator[tuple[Any, dict[str, int | None]]]:
    """Take what waits for a subscription, `most` messages at the most; each with its info.

    For every message that an executor takes it gathers all that the node has. In a callback of
    the subscription that can be spared for those that came meanwhile.
    """
    handle, message_type, raw = subscription.handle, subscription.msg_type, subscription.raw
    with handle:
        for _ in range(most):
            taken = handle.take_message(message_type, raw)
            if taken is None:
                return
            yield taken
