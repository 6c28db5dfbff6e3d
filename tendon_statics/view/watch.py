"""What is heard of one estimator."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.node import Node

from ..estimation.regimes import INVALID, STALE
from .design_question import DesignQuestion
from .estimators_in_sight import Sighting
from .history import History
from .newest_messages import KeptMessages, NewestMessages

SILENCE = 0.5
"""Seconds without an estimate after which the lines of a page end"""


class Watch:
    """What one estimator says, from when somebody looks at it until nobody does.

    Parameters
    ----------
    rate : float
        How often per second `poll` is called, at the most.
    """

    def __init__(self, node: Node, sighting: Sighting, rate: float) -> None:
        self.sighting = sighting
        self.history = History(rate, ())
        """A new one whenever there is something else to draw, as of an arm with more joints"""
        self.estimate: Any = None
        """The newest that came, None before the first"""
        self.estimated_at = -math.inf
        """When it came, on the clock of `time.monotonic`"""
        self.admissible: Any = None
        """What came with it on where friction can hold an arm; None if nothing did"""
        self._admissible_at = -math.inf
        self.said = ''
        """``invalid`` or ``stale`` where the estimator says that in place of an estimate"""
        self.diagnostics: DiagnosticStatus | None = None
        self.diagnosed_at = -math.inf
        self._rate = rate
        self._names: Sequence[str] = ()
        self._kind = kind = sighting.kind
        self._estimates = NewestMessages(node, kind.estimates, sighting.topic)
        self._regimes = KeptMessages(node, kind.regimes, f'{sighting.name}/{kind.regimes_on}')
        self._admissible: NewestMessages | None = None
        if kind.admissible is not None:
            topic = f'{sighting.name}/admissible_angles'
            self._admissible = NewestMessages(node, kind.admissible, topic)
        # Room for the estimators of a rig, which share the topic.
        self._diagnostics = NewestMessages(node, DiagnosticArray, '/diagnostics', depth=50)
        self._design = DesignQuestion(node, sighting.name, kind)
        self._ended = True  # What has not begun needs no end.

    @property
    def design(self) -> Any:
        """The design of the unit, or the arm, as far as the estimator has told it."""
        return self._design.design

    def poll(self) -> None:
        """Take what has come."""
        now = time.monotonic()
        self._design.ask_when_due(now)
        for message in self._regimes.take():
            regime = self._kind.first_regime(message)
            self.said = regime if regime in (INVALID, STALE) else ''
        for message in self._admissible.take() if self._admissible is not None else ():
            self.admissible = message
            self._admissible_at = now
        for message in self._estimates.take():
            if now - self._admissible_at > SILENCE:
                self.admissible = None
            self.estimate = message
            self.estimated_at = now
            self._ended = False
            self._note(message)
        if now - self.estimated_at > SILENCE and not self._ended:
            self._ended = True
            self.history.add(time.time(), {})
        name = f'{self.sighting.name.lstrip("/")}: estimation'
        for message in self._diagnostics.take():
            for status in message.status:
                if status.name == name:
                    self.diagnostics = status
                    self.diagnosed_at = now

    def _note(self, estimate: Any) -> None:
        names = self._kind.names_of(estimate)
        if names != self._names:
            self._names = names
            self.history = History(self._rate, names)
        self.history.add(time.time(), self._kind.sample(estimate))

    def close(self) -> None:
        """Hear no more."""
        for topic in (self._estimates, self._regimes, self._admissible, self._diagnostics):
            if topic is not None:
                topic.close()
        self._design.close()


class Watches:
    """The estimators that pages look at: each is heard once, however many pages there are."""

    def __init__(self, node: Node, rate: float) -> None:
        self._node = node
        self._rate = rate
        self._watched: dict[Sighting, tuple[Watch, int]] = {}

    def __bool__(self) -> bool:
        return bool(self._watched)

    def look(self, sighting: Sighting) -> Watch:
        """Begin to look at an estimator; `leave` ends it."""
        watch, lookers = self._watched.get(sighting, (None, 0))
        watch = watch or Watch(self._node, sighting, self._rate)
        self._watched[sighting] = watch, lookers + 1
        return watch

    def leave(self, watch: Watch) -> None:
        """Look no more; who leaves last ends the subscriptions."""
        _, lookers = self._watched[watch.sighting]
        if lookers > 1:
            self._watched[watch.sighting] = watch, lookers - 1
        else:
            del self._watched[watch.sighting]
            watch.close()

    def poll(self) -> None:
        """Take what has come, of each."""
        for watch, _ in self._watched.values():
            watch.poll()

    def close(self) -> None:
        """End all."""
        while self._watched:
            _, (watch, _) = self._watched.popitem()
            watch.close()
