"""A replay written as a bag: one MCAP file, with what was recorded and what was estimated."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..output_file import OutputError, output_file
from .bag import ARRAY, DEFAULT_BEND_ANGLE, DEFAULT_PRESSURE, NUMBER, TEXT
from .libraries import needed
from .replay import Replay

PREFIX = '/replay/'

TOPICS = {
    '/tensions': ARRAY,
    DEFAULT_BEND_ANGLE: NUMBER,
    DEFAULT_PRESSURE: NUMBER,
    f'{PREFIX}regime': TEXT,
    f'{PREFIX}bend_angle': NUMBER,
    f'{PREFIX}joint_pressure': NUMBER,
    f'{PREFIX}slip_margin': NUMBER,
}
"""Topic → type: the estimator's own names; a number has a message only where it is determined"""


def write_bag(path: Path, replay: Replay) -> None:
    """Write a replay to an ``.mcap`` file that ROS tools take, and `load_recording` too.

    Raises
    ------
    OutputError
        If the recording has no times, or the file cannot be written.
    RecordingError
        If a library is missing.
    """
    writers, typesys = needed('mcap.writer', 'rosbags.typesys', purpose='ROS bags')
    if replay.recording.time is None or not np.isfinite(replay.recording.time).all():
        raise OutputError(f'{path}: a bag needs the time of every sample, which is not recorded')
    store = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
    make = _constructors(store)
    origin = replay.recording.time_origin
    times = [origin + round(1e9 * time) for time in replay.recording.time.tolist()]
    with output_file(path) as temporary, temporary.open('wb') as file:
        writer = writers.Writer(file)
        writer.start(profile='ros2')
        schemas, channels = {}, {}
        for topic, kind in TOPICS.items():
            if kind not in schemas:
                definition, _ = store.generate_msgdef(kind, ros_version=2)
                schemas[kind] = writer.register_schema(kind, 'ros2msg', definition.encode())
            channels[topic] = writer.register_channel(topic, 'cdr', schemas[kind])
        for time, topic, value in heapq.merge(*_timed(replay, times), key=lambda entry: entry[0]):
            kind = TOPICS[topic]
            data = bytes(store.serialize_cdr(make[kind](value), kind))
            writer.add_message(channels[topic], time, data, time)
        writer.finish()


def _timed(replay: Replay, times: Sequence[int]) -> list[Iterator[tuple[int, str, Any]]]:
    """Messages of each topic in the order of time."""
    recording = replay.recording
    order = sorted(range(len(times)), key=times.__getitem__)

    def numbers(topic: str, values: Any) -> Iterator[tuple[int, str, Any]]:
        known = np.isfinite(values)
        return ((times[i], topic, float(values[i])) for i in order if known[i])

    tensions, regimes = recording.tensions(), replay.regime.tolist()
    series = [
        ((times[i], '/tensions', tensions[i]) for i in order),
        ((times[i], f'{PREFIX}regime', regimes[i]) for i in order),
        numbers(f'{PREFIX}bend_angle', replay.bend_angle),
        numbers(f'{PREFIX}joint_pressure', replay.pressure),
        numbers(f'{PREFIX}slip_margin', replay.slip_margin),
    ]
    for topic, measured in (
        (DEFAULT_BEND_ANGLE, recording.bend_angle),
        (DEFAULT_PRESSURE, recording.pressure),
    ):
        if measured is not None:
            series.append(numbers(topic, measured))
    return series


def _constructors(store: Any) -> dict[str, Callable[[Any], Any]]:
    """Type → what makes its message of a value."""
    layout = store.types['std_msgs/msg/MultiArrayLayout'](dim=[], data_offset=0)
    return {
        ARRAY: lambda pair: store.types[ARRAY](layout=layout, data=np.array(pair)),
        NUMBER: lambda value: store.types[NUMBER](data=value),
        TEXT: lambda value: store.types[TEXT](data=value),
    }
