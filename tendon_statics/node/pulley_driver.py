"""The node ``pulley_driver``: plays recorded tensions where a rig has motor drivers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray

from ..installed_files import installed_config
from ..tension_file import TensionFileError, load_tensions
from .program import StartError, run_node


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
            floating_point_range=[FloatingPointRange(from_value=0.01, to_value=10000.0)],
        )
        self._loop = self._parameter('loop', True, 'whether to begin anew after the last row')
        self._awaited_subscribers = self._parameter(
            'awaited_subscribers',
            0,
            'subscribers on tensions to wait for before the first row',
            integer_range=[IntegerRange(from_value=0, to_value=100)],
        )
        try:
            self._rows = load_tensions(path or installed_config('demo_tensions.csv'))
        except TensionFileError as error:
            raise StartError(str(error)) from None
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


def main(args: Sequence[str] | None = None) -> int:
    """Run the node; the entry point of ``ros2 run tendon_statics pulley_driver``."""
    return run_node(PulleyDriver, args)
