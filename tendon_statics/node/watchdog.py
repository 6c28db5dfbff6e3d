"""What is due by the clock, though no message comes: stale input, reports."""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, ClockType

from ..estimation.regimes import STALE
from .diagnostics import Reports
from .inputs.tension_source import TensionSource
from .outputs.publishers import Outputs

if TYPE_CHECKING:
    from .managed_estimator import ManagedEstimator

WARNING_PERIOD = 5.0
"""Least time in s between two warnings that messages cause."""

DIAGNOSTICS_PERIOD = 1.0
"""s"""

LONGEST_SLEEP = 0.25
"""s between two looks at what is due, unless something is before"""

SHORTEST_SLEEP = 1000
"""ns; no timer is then a little early"""

# Steady, since the node's own clock stands still with use_sim_time and no /clock.
_STEADY = Clock(clock_type=ClockType.STEADY_TIME)


def throttled() -> dict[str, Any]:
    """What a logger is told of a text that messages cause."""
    return {'throttle_duration_sec': WARNING_PERIOD, 'throttle_time_source_type': _STEADY}


class Watchdog:
    """Notices that tensions no longer come, and has reports made in time."""

    def __init__(
        self,
        node: ManagedEstimator[Any, Any],
        outputs: Outputs,
        source: TensionSource,
        reports: Reports,
    ) -> None:
        self._node = node
        self._outputs = outputs
        self._source = source
        self._reports = reports
        self._has_said_stale = True
        self._watched_since = -math.inf  # steady, in s: activation or change of the timeout
        self._next_report = math.inf  # likewise
        # One for all, since each is waited for with every message; it also wakes the executor.
        self._timer = node.create_timer(LONGEST_SLEEP, self._on_time, clock=_STEADY)

    def begin(self) -> None:
        """Begin to watch, with the node's activation."""
        self._node.health.begin_period()
        self._node.health.stale = False
        self._next_report = time.monotonic() + DIAGNOSTICS_PERIOD
        self.begin_again()

    def begin_again(self) -> None:
        """Count the time without tensions from now."""
        self._watched_since = time.monotonic()
        self._wake_when_due()

    def note_valid(self, *, was_stale: bool) -> None:
        """Note that valid tensions came, after stale ones or not."""
        self._has_said_stale = False
        if was_stale:
            self._wake_when_due()
            self._node.get_logger().info('Valid tensions come again', **throttled())

    def lose_sight(self) -> None:
        """Take it that the unit may move unseen from now on; say so once."""
        self._node.health.stale = True
        if not self._has_said_stale:
            self._has_said_stale = True
            self._outputs.say_regime(STALE)
        self._node.core.lose_sight()
        self._outputs.clear_drawing()

    def _on_time(self) -> None:
        """Do what is due by now, and wake again when the next is.

        Putting the timer off with every message would wake the executor once more for each. It
        goes on for ever, since EventsExecutor cannot handle timers that are cancelled.
        """
        if self._node.is_active:
            now = time.monotonic()
            if now >= self._stale_from():
                self._on_stale_input()
            if now >= self._next_report:
                self._next_report = now + DIAGNOSTICS_PERIOD
                self._reports.report_period()
        self._wake_when_due()

    def _stale_from(self) -> float:
        return self._node.core.stale_from(self._watched_since)

    def _wake_when_due(self) -> None:
        delay = LONGEST_SLEEP
        if self._node.is_active:
            due = min(self._stale_from(), self._next_report)
            delay = min(due - time.monotonic(), LONGEST_SLEEP)
        self._timer.timer_period_ns = max(int(delay * 1e9), 0) + SHORTEST_SLEEP
        self._timer.reset()

    def _on_stale_input(self) -> None:
        """Say once that no more tensions come; what is drawn or remembered is not vouched for."""
        self.lose_sight()
        self._source.loosen()
        node = self._node
        timeout = node.core.settings.input_timeout
        node.get_logger().warning(
            f'No valid tensions on {node.tension_topics} for {timeout:g} s', **throttled()
        )
        self._reports.report()
