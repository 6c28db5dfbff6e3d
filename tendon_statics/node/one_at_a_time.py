"""A callback group that is quick to look at."""

from __future__ import annotations

import threading
from typing import Any

from rclpy.callback_groups import CallbackGroup


class OneAtATime(CallbackGroup):
    """Lets one callback run at a time, as rclpy's `MutuallyExclusiveCallbackGroup` does.

    An executor asks of each entity before each wait whether it may run. That needs no lock, and
    no search for the entity: whoever is let begin is decided by `beginning_execution`.
    """

    def __init__(self) -> None:
        super().__init__()
        self._running: Any = None
        self._lock = threading.Lock()

    def can_execute(self, _entity: Any) -> bool:
        """Whether no callback of the group runs."""
        return self._running is None

    def beginning_execution(self, entity: Any) -> bool:
        """Let a callback begin, unless another runs."""
        with self._lock:
            if self._running is not None:
                return False
            self._running = entity
            return True

    def ending_execution(self, _entity: Any) -> None:
        """Note that the callback has ended."""
        with self._lock:
            self._running = None
