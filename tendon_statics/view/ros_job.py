"""Work over ROS that a loop of its own calls, which is not ROS's."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.context import Context


def ros_job(context: Context, work: Callable[[], None]) -> Callable[[], None]:
    """Return the same work, left out once the context has ended.

    A signal ends it at any moment, so that work in its midst may fail of that alone.
    """

    def job() -> None:
        if not context.ok():
            return
        try:
            work()
        except Exception:
            if context.ok():
                raise

    return job
