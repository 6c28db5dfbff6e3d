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
from ros_programs import wait_for

from .subject import Subject


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
        self._is_quiet = False
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
        counted = {item.key: int(item.value) for item in values if item.value.isdigit()}
        key = 'messages received'
        self._is_quiet = counted[key] == self.counts.get(key)
        self.counts = counted

    def estimates(self) -> int:
        """How many have come."""
        return self.came[self._subject.estimates]

    def grown_since(self, before: dict[str, int]) -> Counter[str]:
        """Return by how much the estimator's counts have grown."""
        return Counter({key: value - before.get(key, 0) for key, value in self.counts.items()})

    def is_quiet(self) -> bool:
        """Whether nothing came between the last two reports."""
        return self._is_quiet

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
