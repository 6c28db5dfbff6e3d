"""The node ``pulley_driver``: plays recorded tensions where a rig has motor drivers.

It publishes as such drivers do, and on request makes their faults. It counts what it sends, so
that whoever counts what arrives can balance the books.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.logging import get_logger
from rclpy.node import Node

from ..files.arm_settings import arm_in
from ..files.driver_parameters import OF_UNIT, OWN, of_arm
from ..files.fault_settings import STAMP_FAULTS, Fault, FaultSettings, fault_parameters
from ..files.installed_files import installed_config
from ..files.parameter_kinds import Parameter, SettingError
from ..node.parameters.declaration import declare_all
from ..node.parameters.unknown import warn_of_unknown_parameters
from ..node.program import StartError
from ..physics.arm import Arm
from ..recordings.errors import RecordingError
from ..recordings.reading.load import load_arm_recording, load_recording
from ..recordings.reading.topics import DEFAULT_TENSIONS
from ..recordings.reading.units import OF_UNIT as OF_TABLE
from .faults import FaultMaker, Reading
from .publishers import (
    ArrayPublisher,
    JointStatePublisher,
    TensionPublisher,
    WrenchPairPublisher,
)

SHORTEST_TICK, LONGEST_TICK = 0.001, 0.1
"""s between two looks at what is due; a timer in Python is not good for more of them"""

CATCH_UP_TIME = 0.1
"""s; readings that are later than that are skipped, so that no backlog grows"""


def _measured(arm: Arm | None) -> tuple[Parameter, ...]:
    """The parameters that say how the tensions are measured."""
    return OF_UNIT if arm is None else of_arm(arm.cable_names)


def _rows(file: str, arm: Arm | None) -> Sequence[tuple[float, ...]]:
    """Read what is played: the tensions of all cables, row by row.

    Raises
    ------
    RecordingError
        If it cannot be read as a whole.
    """
    if arm is None:
        return load_recording(file or installed_config('demo_tensions.csv')).whole().tensions()
    path = file or installed_config('arm_tensions.csv')
    return load_arm_recording(path, arm).whole().tensions()


def _without_options(text: str, arm: Arm | None) -> str:
    """Say what is to be done where an error names options, of which a driver has none."""
    if '--' not in text:
        return text
    titles = OF_TABLE.required if arm is None else arm.cable_names
    return (
        f'{text}; pulley_driver has no such options: it plays a table with the columns '
        f'{", ".join(titles)} in N, or a bag with these on {DEFAULT_TENSIONS}'
    )


class PulleyDriver(Node):
    """Publishes the rows of a tension file at a steady rate."""

    def __init__(self) -> None:
        super().__init__('pulley_driver')
        values = declare_all(self, OWN)
        arm = arm_in(values['arm_file']) if values['arm_file'] else None
        values |= declare_all(self, (*_measured(arm), *fault_parameters()))
        self._loop, self._rate, self._count = values['loop'], values['rate'], values['count']
        self._awaited_subscribers = values['awaited_subscribers']
        self._publisher = self._make_publisher(values, arm)
        self._gains = [value for name, value in values.items() if name.endswith('gain')]
        self._biases = [value for name, value in values.items() if name.endswith('bias')]
        settings = FaultSettings(
            **{fault.name: values[fault.name] for fault in fault_parameters()}
        )
        try:
            self._rows = _rows(values['file'], arm)
        except RecordingError as error:
            raise StartError(_without_options(str(error), arm)) from None
        warn_of_unknown_parameters(self)
        for fault in STAMP_FAULTS:
            if settings.probability(fault) > 0.0 and isinstance(self._publisher, ArrayPublisher):
                raise SettingError(
                    f'{fault.value}_probability is {settings.probability(fault):g}, but '
                    'tension_source is array, of which no message has a stamp'
                )
        self._faults = FaultMaker(settings, len(self._gains))
        self._sent: Counter[str] = Counter()
        self._done = 0  # readings that were sent or skipped
        self._begin: float | None = None  # s
        self._has_ended = False
        self._steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        tick = max(1.0 / self._rate, SHORTEST_TICK)
        self._tick = tick / math.ceil(tick / LONGEST_TICK)
        self._timer = self.create_timer(self._tick, self._send_due, clock=self._steady_clock)
        awaited = self._awaited_subscribers
        self.get_logger().info(
            f'Ready: {len(self._rows)} rows at {self._rate:g} Hz'
            + (f', once it has found {awaited} subscribers on each topic' if awaited else '')
        )

    def destroy_node(self) -> None:
        """Say what was sent, unless that was said at the end of it, and destroy the node."""
        self._end()
        super().destroy_node()

    def _make_publisher(self, values: Mapping[str, Any], arm: Arm | None) -> TensionPublisher:
        source = values['tension_source']
        if source == 'array':
            return ArrayPublisher(self)
        if source == 'joint_state':
            names = values['cable_names'] if arm is None else arm.cable_names
            return JointStatePublisher(self, names)
        return WrenchPairPublisher(self, values['wrench_component'])

    # Sending

    def _send_due(self) -> None:
        if self._has_ended:  # The timer goes on, for a signal to be heard.
            return
        now = self._steady_clock.now().nanoseconds * 1e-9
        if self._begin is None:
            if self._publisher.subscription_count() < self._awaited_subscribers:
                return
            self._begin = now
        # Half a tick of tolerance, since a timer comes now and then a little early.
        due = math.floor((now - self._begin + 0.5 * self._tick) * self._rate) + 1 - self._done
        allowed = max(1, math.ceil(CATCH_UP_TIME * self._rate))
        if due > allowed:
            self._sent['skipped'] += due - allowed
            self._done += due - allowed
        for _ in range(min(due, allowed)):
            self._send()
            if self._has_sent_all():
                self._end()
                return

    def _send(self) -> None:
        row = self._rows[self._sent['readings'] % len(self._rows)]
        reading = self._faults.reading(row, self.get_clock().now().nanoseconds)
        messages = self._publish(reading) if reading.fault is not Fault.DROPOUT else 0
        # Only now, since the context may end in the midst of it.
        self._done += 1
        self._sent.update(['readings', reading.fault.value])
        self._sent['messages'] += messages

    def _publish(self, reading: Reading) -> int:
        raw = [
            (tension - bias) / gain
            for tension, gain, bias in zip(
                reading.tensions, self._gains, self._biases, strict=True
            )
        ]
        missing = reading.cable if reading.fault is Fault.WRONG_LENGTH else None
        return self._publisher.publish(raw, reading.stamp, missing)

    def _has_sent_all(self) -> bool:
        readings = self._sent['readings']
        return readings == self._count or (not self._loop and readings == len(self._rows))

    def _end(self) -> None:
        """Send no more, and say what was sent."""
        if self._has_ended:
            return
        self._has_ended = True
        keys = ('readings', 'messages', 'skipped', *(fault.value for fault in Fault))
        sent = json.dumps({key: self._sent[key] for key in keys})
        # Not by the node's own logger: its topic /rosout is gone after a signal.
        get_logger(f'{self.get_logger().name}.sent').info(f'Sent: {sent}')
