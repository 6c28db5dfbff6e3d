"""Counts what an estimator publishes, keeps what it says of itself, and sets its parameters."""

from __future__ import annotations

import itertools
import threading
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.srv import SetParameters
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time import Time
from ros_programs import wait_for

from .subject import Subject

QUIET = 2.5
"""Seconds, longer than between two reports"""


class Observer(Node):
    """Beside one estimator."""

    def __init__(self, context: Context, subject: Subject) -> None:
        super().__init__('observer', context=context)
        self.came: Counter[str] = Counter()
        self.counts: dict[str, int] = {}
        self.settings: Counter[str] = Counter()
        """How parameters were set: as expected, or otherwise"""
        self._subject = subject
        self._client = self.create_client(SetParameters, f'{subject.program}/set_parameters')
        self._state: tuple[int, int] = (0, 0)
        self._changed_at = self._reported_at = 0.0
        for name, kind in subject.outputs.items():
            self.create_subscription(
                kind,
                f'{subject.program}/{name}',
                lambda message, name=name: self._count(name, message),
                5000,
            )
        self.create_subscription(DiagnosticArray, '/diagnostics', self._keep, 100)

    def _count(self, name: str, message: Any) -> None:
        self.came[name] += 1
        if name == self._subject.regimes:
            self.came[f'{name} {self._subject.regime(message)}'] += 1

    def _keep(self, message: DiagnosticArray) -> None:
        values = message.status[0].values
        self.counts = {item.key: int(item.value) for item in values if item.value.isdigit()}
        self._reported_at = 1e-9 * Time.from_msg(message.header.stamp).nanoseconds
        state = self.counts['messages received'], self.came.total()
        if state != self._state:
            self._state, self._changed_at = state, self._reported_at

    def estimates(self) -> int:
        """How many have come."""
        return self.came[self._subject.estimates]

    def grown_since(self, before: dict[str, int]) -> Counter[str]:
        """Return by how much the estimator's counts have grown."""
        return Counter({key: value - before.get(key, 0) for key, value in self.counts.items()})

    def taken_since(self, before: dict[str, int]) -> int:
        """Return how many messages more the estimator has received or knows to be lost."""
        grown = self.grown_since(before)
        return grown['messages received'] + grown['messages lost on the way']

    def is_quiet(self) -> bool:
        """Whether for a while nothing came, neither to the estimator nor of it.

        By the times of its reports, some of which follow each other closely.
        """
        return self._reported_at - self._changed_at > QUIET

    @contextmanager
    def meddling(self) -> Iterator[None]:
        """Set parameters all the time, as clients do that know no better."""
        ended = threading.Event()

        def meddle() -> None:
            for value, is_taken in itertools.cycle(self._subject.settings):
                if ended.wait(0.2):
                    return
                asked = self._client.call_async(
                    SetParameters.Request(parameters=[Parameter(*value).to_parameter_msg()])
                )
                wait_for('an answer', asked.done)
                (result,) = asked.result().results
                as_expected = result.successful == is_taken
                self.settings['as expected' if as_expected else f'otherwise: {value}'] += 1

        thread = threading.Thread(target=meddle)
        wait_for('the service', self._client.service_is_ready)
        thread.start()
        try:
            yield
        finally:
            ended.set()
            thread.join()
