"""An executor that does not wake itself."""

from __future__ import annotations

import threading

from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.guard_condition import GuardCondition


class LoneThreadExecutor(SingleThreadedExecutor):
    """rclpy's executor of one thread, at half its work for each message.

    When a callback begins and when it ends, rclpy triggers a guard condition, for the threads of
    its other executor that may wait by then. Here none does: triggered, the next wait would only
    end at once, for nothing, and all that the node has would be gathered once more. What another
    thread asks for wakes it as ever.

    It is to be spun by the thread that makes it.
    """

    def __init__(self, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        # Not public; where rclpy comes to call it otherwise, all is as if this were not here.
        guard: GuardCondition = self._guard  # type: ignore[has-type]
        self._guard = _GuardForOthers(None, None, context=self.context)
        guard.destroy()


class _GuardForOthers(GuardCondition):
    """A guard condition that its own thread does not trigger, since it cannot be waiting."""

    def __init__(self, *of: object, context: Context) -> None:
        super().__init__(*of, context=context)
        self._own = threading.get_ident()

    def trigger(self) -> None:
        if threading.get_ident() != self._own:
            super().trigger()
