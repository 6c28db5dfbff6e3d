"""Drive the installed estimator over real ROS 2 and print what it publishes.

Starts ``pulley_driver`` and ``estimator`` as processes of their own, on this machine only and in
a ROS domain that nobody else uses, plays the demo tensions once, and ends what it started.
"""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

import rclpy
from ament_index_python.packages import get_package_prefix
from domain_coordinator import domain_id
from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.node import Node
from std_msgs.msg import Float64, String
from tendon_statics_interfaces.msg import Estimate
from tendon_statics_interfaces.srv import Solve

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.installed_files import installed_config
from tendon_statics.tension_file import load_tensions

TIME_LIMIT = 60.0
DETERMINED = (Estimate.EQUILIBRIUM, Estimate.DRIVEN_TO_STOP)


class Listener(Node):
    """Keeps all that the estimator publishes."""

    def __init__(self) -> None:
        super().__init__('demo')
        self.regimes: list[str] = []
        self.angles: list[float] = []
        self.pressures: list[float] = []
        self.poses: list[PoseWithCovarianceStamped] = []
        self.estimates: list[Estimate] = []
        self.solve = self.create_client(Solve, 'estimator/solve')

        def keep(message_type: type, topic: str, take: Callable) -> None:
            self.create_subscription(message_type, f'estimator/{topic}', take, 100)

        keep(String, 'regime', lambda message: self.regimes.append(message.data))
        keep(Float64, 'bend_angle', lambda message: self.angles.append(message.data))
        keep(Float64, 'joint_pressure', lambda message: self.pressures.append(message.data))
        keep(PoseWithCovarianceStamped, 'unit_pose', self.poses.append)
        keep(Estimate, 'estimate', self.estimates.append)

    def has_answers(self, count: int) -> bool:
        """Whether all that belongs to so many messages has come."""
        determined = sum(regime in DETERMINED for regime in self.regimes)
        valid = sum(regime != 'invalid' for regime in self.regimes)
        return (
            len(self.regimes) == count
            and len(self.angles) == len(self.pressures) == len(self.poses) == determined
            and len(self.estimates) == valid
        )

    def wait(self, what: str, condition: Callable[[], bool]) -> None:
        """Spin until a condition holds."""
        deadline = time.monotonic() + TIME_LIMIT
        while not condition():
            if time.monotonic() > deadline:
                raise TimeoutError(f'waited {TIME_LIMIT:.0f} s for {what}')
            rclpy.spin_once(self, timeout_sec=0.1)


@contextmanager
def program(name: str, *arguments: str):
    """Run a node of the package; end it with SIGINT and ask for exit code 0."""
    path = Path(get_package_prefix('tendon_statics'), 'lib', 'tendon_statics', name)
    process = subprocess.Popen([path, *arguments])
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        code = process.wait(timeout=10)
        print(f'{name} ended by SIGINT with exit code {code}')
    if code != 0:
        raise RuntimeError(f'{name} ended with exit code {code}')


def main() -> None:
    """Run the demo."""
    rows = load_tensions(installed_config('demo_tensions.csv'))
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    design = str(installed_config('preliminary_design.yaml'))
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        rclpy.init()
        listener = Listener()
        try:
            with program('estimator', '--ros-args', '--params-file', design):
                listener.wait(
                    'the estimator',
                    lambda: all(s.get_publisher_count() for s in listener.subscriptions)
                    and listener.solve.service_is_ready(),
                )
                driver = ('-p', 'awaited_subscribers:=1', '-p', 'loop:=false', '-p', 'rate:=20.0')
                with program('pulley_driver', '--ros-args', *driver):
                    listener.wait(
                        'an answer to every row',
                        lambda: listener.has_answers(len(rows)),
                    )
                print_table(rows, listener)
                call_solve(listener)
        finally:
            listener.destroy_node()
            rclpy.shutdown()


def print_table(rows: list[tuple[float, float]], listener: Listener) -> None:
    """Print what came back over the topics, a line for each row played."""
    angles, pressures, poses = map(iter, (listener.angles, listener.pressures, listener.poses))
    estimates = iter(listener.estimates)
    lines = []
    for (tension_l, tension_s), regime in zip(rows, listener.regimes, strict=True):
        cells = ['', '', '', '']
        if regime in DETERMINED:
            stddev = math.sqrt(next(poses).pose.covariance[28])  # rotation about Y
            cells = [
                f'{math.degrees(next(angles)):.2f}',
                f'{math.degrees(stddev):.2f}',
                f'{next(pressures):.1f}',
                '',
            ]
        if regime != 'invalid':
            cells[3] = str(next(estimates).root_count)
        note = "the paper's case" if (tension_l, tension_s) == (1.0, 2.0) else ''
        lines.append((f'{tension_l:g}', f'{tension_s:g}', regime, *cells, note))
    header = ('T_l [N]:', 'T_s [N]:', 'regime', 'angle [deg]:', '± [deg]:', 'pressure [Pa]:')
    print(markdown_table((*header, 'roots:', ''), lines))


def call_solve(listener: Listener) -> None:
    """Call the service once."""
    future = listener.solve.call_async(Solve.Request(tension_l=1.0, tension_s=2.0))
    listener.wait('the service', future.done)
    answer = future.result()
    print(
        f'\n~/solve of 1 N and 2 N: {answer.regime}, {math.degrees(answer.bend_angle):.2f} deg '
        f'± {math.degrees(answer.bend_angle_stddev):.2f}, {answer.pressure:.1f} Pa'
    )


if __name__ == '__main__':
    try:
        main()
    except (TimeoutError, RuntimeError) as error:
        sys.exit(f'demo failed: {error}')
