"""Make ``config/recorded_session.mcap``: a session on a stand-in rig, recorded over real ROS 2.

``pulley_driver`` plays the tensions of an operator who brings a unit to an angle by hand, the
cables slack, and then pulls one cable until the unit slips, over and over. A stand-in for unit
and sensors follows it: a unit that is not what the preliminary design says, load cells and a
camera with noise, and a pressure sensor. ``estimator`` takes the measured tensions. All run on
this machine only, in a ROS domain that nobody else uses.
"""

from __future__ import annotations

import csv
import dataclasses
import random
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

from make_docs import ROOT
from mcap.writer import Writer
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile
from ros_domain import own_domain
from ros_programs import Program, spinning, wait_for
from rosbags.typesys import Stores, get_typestore
from std_msgs.msg import Float64, Float64MultiArray, String

from tendon_statics import default_design_path, load_design
from tendon_statics.files.output_file import output_file
from tendon_statics.physics import StickSlipTracker, TensionError
from tendon_statics.recordings.reading.bag_record import TEXT
from tendon_statics.recordings.reading.bag_values import ARRAY, NUMBER

OUTPUT = ROOT / 'config' / 'recorded_session.mcap'
UNIT = dataclasses.replace(
    load_design(default_design_path()), mass=0.024, cable_offset=0.0041, friction_coefficient=0.92
)
"""The stand-in unit: what a calibration of the recording is to find"""

TENSION_STDDEV, BEND_ANGLE_STDDEV, PRESSURE_STDDEV = 0.01, 0.005, 8.0
"""Noise of the stand-in sensors in N, rad and Pa"""
DEAD_BAND = 0.03
"""N below which the load cells say 0"""

RATE = 20.0
"""Hz"""
PLAN = [
    *((0.0, 1.0, 's'), (0.2, 0.3, 'l'), (-0.3, 1.5, 's'), (0.4, 0.5, 's'), (-0.1, 0.8, 'l')),
    *((0.1, 2.0, 's'), (-0.4, 0.3, 'l'), (0.3, 0.5, 's'), (-0.2, 1.2, 'l'), (0.0, 0.4, 's')),
    *((0.25, 0.6, 's'), (-0.35, 0.3, 'l'), (0.15, 1.8, 's'), (-0.15, 0.35, 'l'), (0.4, 1.0, 's')),
]
"""Angle in rad to which the operator brings the unit, tension in N of the cable that is not
pulled, and the cable that is"""

TOPICS = {
    '/tensions': (Float64MultiArray, ARRAY),
    '/measured_bend_angle': (Float64, NUMBER),
    '/measured_pressure': (Float64, NUMBER),
    '/estimator/regime': (String, TEXT),
    '/estimator/bend_angle': (Float64, NUMBER),
}
"""What is recorded"""


def session() -> list[tuple[float, float]]:
    """Tensions of the whole session in N, one pair for each period of `RATE`."""
    rows: list[tuple[float, float]] = []
    for _, weak, pulled in PLAN:
        expected = 1.9 * weak
        pulls = [0.0] * 12  # slack, while the unit is brought to its angle
        pulls += [weak] * 5
        pulls += _ramp(weak, 0.8 * expected, 0.1)
        pulls += _ramp(0.8 * expected, 1.1 * expected + 0.15, 0.005 + 0.004 * weak)
        for pull in pulls:
            other = weak if pull else 0.0
            rows.append((other, pull) if pulled == 's' else (pull, other))
    return rows


def _ramp(start: float, end: float, step: float) -> list[float]:
    return [start + step * index for index in range(int((end - start) / step))]


class Bench(Node):
    """The unit with its sensors, and the operator's hand."""

    def __init__(self, context: Context) -> None:
        super().__init__('bench', context=context)
        self._noise = random.Random(1)
        self._unit = StickSlipTracker(UNIT)
        self._plan = iter(PLAN)
        self._target = 0.0
        self._was_slack = False
        self._tensions = self.create_publisher(Float64MultiArray, 'tensions', 100)
        self._bend_angle = self.create_publisher(Float64, 'measured_bend_angle', 100)
        self._pressure = self.create_publisher(Float64, 'measured_pressure', 100)
        self.create_subscription(Float64MultiArray, 'pulleys/tensions', self._on_pull, 1000)

    def _on_pull(self, message: Float64MultiArray) -> None:
        slack = max(message.data) == 0.0
        if slack and not self._was_slack:
            self._target, _, _ = next(self._plan)
        self._was_slack = slack
        pressure = None
        if slack:
            way = self._target - self._unit.bend_angle
            self._unit.reset(self._unit.bend_angle + max(-0.1, min(0.1, way)))
        else:
            with suppress(TensionError):
                pressure = self._unit.update(*message.data).pressure
        self._tensions.publish(
            Float64MultiArray(data=[self._load_cell(tension) for tension in message.data])
        )
        angle = self._unit.bend_angle + self._noise.gauss(0.0, BEND_ANGLE_STDDEV)
        self._bend_angle.publish(Float64(data=round(angle, 4)))
        if pressure is not None:
            pressure += self._noise.gauss(0.0, PRESSURE_STDDEV)
            self._pressure.publish(Float64(data=round(pressure, 1)))

    def _load_cell(self, tension: float) -> float:
        read = round(tension + self._noise.gauss(0.0, TENSION_STDDEV), 4)
        return read if read >= DEAD_BAND else 0.0


class Recorder(Node):
    """Writes every message that comes to an MCAP file, at the time at which it comes."""

    def __init__(self, context: Context, writer: Writer) -> None:
        super().__init__('recorder', context=context)
        self.counts = dict.fromkeys(TOPICS, 0)
        self._writer = writer
        store = get_typestore(Stores.ROS2_JAZZY)
        schemas: dict[str, int] = {}
        for topic, (message_type, name) in TOPICS.items():
            if name not in schemas:
                definition, _ = store.generate_msgdef(name, ros_version=2)
                schemas[name] = writer.register_schema(name, 'ros2msg', definition.encode())
            self._record(topic, message_type, writer.register_channel(topic, 'cdr', schemas[name]))

    def _record(self, topic: str, message_type: type, channel: int) -> None:
        def keep(data: bytes) -> None:
            now = self.get_clock().now().nanoseconds
            self._writer.add_message(channel, now, data, now)
            self.counts[topic] += 1

        self.create_subscription(message_type, topic, keep, QoSProfile(depth=1000), raw=True)

    def is_connected(self) -> bool:
        """Whether every topic has its publisher."""
        return all(self.count_publishers(topic) > 0 for topic in TOPICS)


def record(path: Path) -> dict[str, int]:
    """Run the session and record it; return the messages by topic."""
    rows = session()
    with (
        tempfile.TemporaryDirectory() as folder,
        output_file(path) as temporary,
        temporary.open('wb') as file,
    ):
        played = Path(folder, 'session.csv')
        with played.open('w', encoding='utf-8', newline='') as table:
            csv.writer(table).writerows([('tension_l', 'tension_s'), *rows])
        writer = Writer(file, chunk_size=128 * 1024)
        writer.start(profile='ros2')
        with (
            spinning(lambda context: Recorder(context, writer)) as recorder,
            spinning(Bench),
            Program.running(
                'estimator',
                *_ros('-r', 'measured_bend_angle:=no_camera', '-p', 'estimation:=tracking'),
            ),
        ):
            wait_for('every publisher', recorder.is_connected)
            wait_for('the bench', lambda: recorder.count_subscribers('/tensions') > 1)
            play = (f'file:={played}', f'rate:={RATE}', 'loop:=false', 'awaited_subscribers:=1')
            parts = [part for argument in play for part in ('-p', argument)]
            with Program.running(
                'pulley_driver', *_ros('-r', 'tensions:=pulleys/tensions', *parts)
            ) as driver:
                limit = 2.0 * len(rows) / RATE + 30.0
                wait_for('the last row', lambda: 'Played' in driver.output(), limit)
                wait_for('its tensions', lambda: recorder.counts['/tensions'] >= len(rows) - 5)
                wait_for(
                    'its estimate',
                    lambda: recorder.counts['/estimator/regime'] >= recorder.counts['/tensions'],
                )
        writer.finish()
        return recorder.counts


def _ros(*arguments: Any) -> tuple[str, ...]:
    return ('--ros-args', *map(str, arguments))


def main() -> None:
    """Record the session that travels with the project."""
    with own_domain():
        counts = record(OUTPUT)
    for topic, count in counts.items():
        print(f'{count:6d} messages on {topic}')
    print(f'{OUTPUT.relative_to(ROOT)}: {OUTPUT.stat().st_size / 1024:.0f} KiB')


if __name__ == '__main__':
    try:
        main()
    except (TimeoutError, RuntimeError) as error:
        sys.exit(f'recording failed: {error}')
