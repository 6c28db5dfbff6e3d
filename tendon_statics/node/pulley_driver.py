"""The node ``pulley_driver``: plays recorded tensions where a rig has motor drivers."""

from __future__ import annotations

from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray

from ..installed_files import installed_config
from ..recordings.errors import RecordingError
from ..recordings.load import load_recording
from .program import StartError

MIN_RATE, MAX_RATE = 0.01, 10000.0
"""Hz"""


class PulleyDriver(Node):
    """Publishes the rows of a tension file at a steady rate."""

    def __init__(self) -> None:
        super().__init__('pulley_driver')
        path = self._parameter(
            'file', '', 'CSV file of tensions in N to play; empty: the installed demo_tensions.csv'
        )
        rate = self._parameter(
            'rate',
            10.0,
            '[Hz]: messages per second',
            floating_point_range=[FloatingPointRange(from_value=MIN_RATE, to_value=MAX_RATE)],
            dynamic_typing=True,  # so that 20 is as good as 20.0
        )
        if not isinstance(rate, (int, float)) or not MIN_RATE <= rate <= MAX_RATE:
            raise StartError(f'rate is {rate!r}, allowed is {MIN_RATE} to {MAX_RATE} Hz')
        self._loop = self._parameter('loop', True, 'whether to begin anew after the last row')
        self._awaited_subscribers = self._parameter(
            'awaited_subscribers',
            0,
            'subscribers on tensions to wait for before the first row',
            integer_range=[IntegerRange(from_value=0, to_value=100)],
        )
        try:
            recording = load_recording(path or installed_config('demo_tensions.csv')).whole()
        except RecordingError as error:
            raise StartError(str(error)) from None
        self._rows = recording.tensions()
        self._next = 0
        self._tensions = self.create_publisher(Float64MultiArray, 'tensions', 10)
        self._timer = self.create_timer(1.0 / rate, self._play)

    def _parameter(self, name: str, default: Any, description: str, **ranges: Any) -> Any:
        descriptor = ParameterDescriptor(description=description, read_only=True, **ranges)
        return self.declare_parameter(name, default, descriptor).value

    def _play(self) -> None:
        if self._tensions.get_subscription_count() < self._awaited_subscribers:
            return
        self._awaited_subscribers = 0
        self._tensions.publish(Float64MultiArray(data=self._rows[self._next]))
        self._next += 1
        if self._next == len(self._rows):
            self._next = 0
            if not self._loop:
                self._timer.cancel()
                self.get_logger().info(f'Played {len(self._rows)} rows')
