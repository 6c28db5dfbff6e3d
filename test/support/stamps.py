"""When a message was stamped."""

from __future__ import annotations

from typing import Any

from rclpy.time import Time


def stamp(message: Any) -> int:
    """Return the stamp of a message in ns."""
    nanoseconds: int = Time.from_msg(message.header.stamp).nanoseconds
    return nanoseconds
