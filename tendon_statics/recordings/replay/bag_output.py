"""A replay written as a bag: one MCAP file, with what was recorded and what was estimated."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...files.output_file import OutputError, output_file
from ..libraries import needed
from ..progress import Progress, unseen
from ..reading.bag_beside import DEFAULT_TOPICS
from ..reading.bag_record import TEXT
from ..reading.bag_values import ARRAY, NUMBER
from ..recording import Recording
from ..session import Floats
from .result import Replay

BOOLEAN = 'std_msgs/msg/Bool'

STATE = '/state'
PREFIX = '/replay/'

LATEST = 2**63 - 1
"""ns since 1970; it is in the year 2262"""

BEYOND = 1e10
"""s; that far from any time that a bag can hold is outside of it"""


class _Series(NamedTuple):
    """What is said on one topic."""

    topic: str
    kind: str
    values: Sequence[Any]
    """One for each sample, None where there is no message"""


def write_bag(path: Path, replay: Replay, progress: Progress = unseen) -> None:
    """Write a replay to an ``.mcap`` file that ROS tools take, and `load_recording` too.

    What was recorded is on the topics that are read without being named, and on ``/state``, as it
    was, with NaN where it is missing. What was estimated is on the topics below ``/replay/``; a
    number has a message only where it is determined.

    Raises
    ------
    OutputError
        If the recording has no times or such as no bag can hold, or the file cannot be written.
    RecordingError
        If a library is missing.
    """
    writers, typesys = needed('mcap.writer', 'rosbags.typesys', purpose='ROS bags')
    times = _times(path, replay.recording)
    store = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
    make = _constructors(store)
    all_series = _recorded(replay.recording) + _estimated(replay)
    with output_file(path) as temporary, temporary.open('wb') as file:
        writer = writers.Writer(file)
        writer.start(profile='ros2')
        schemas, channels = {}, {}
        for topic, kind, _ in all_series:
            if kind not in schemas:
                definition, _ = store.generate_msgdef(kind, ros_version=2)
                schemas[kind] = writer.register_schema(kind, 'ros2msg', definition.encode())
            channels[topic] = writer.register_channel(topic, 'cdr', schemas[kind])
        order = sorted(range(len(times)), key=times.__getitem__)
        for sample in progress(order, 'writing'):
            time = times[sample]
            for topic, kind, values in all_series:
                value = values[sample]
                if value is not None:
                    data = bytes(store.serialize_cdr(make[kind](value), kind))
                    writer.add_message(channels[topic], time, data, time)
        writer.finish()


def _times(path: Path, recording: Recording) -> list[int]:
    """Return the time of each sample in ns since 1970.

    Raises
    ------
    OutputError
        If one has none, or one that a bag cannot hold.
    """
    if recording.time is None or not np.isfinite(recording.time).all():
        raise OutputError(f'{path}: a bag needs the time of every sample, which is not recorded')
    near = recording.time.clip(-BEYOND, BEYOND).tolist()
    times = [recording.time_origin + round(1e9 * time) for time in near]
    for sample, time in enumerate(times):
        if not 0 <= time <= LATEST:
            since_1970 = 1e-9 * recording.time_origin + float(recording.time[sample])
            raise OutputError(
                f'{path}: a bag holds times from 0 to {1e-9 * LATEST:.10g} s since 1970, and '
                f'sample {sample + 1} is at {since_1970:.10g} s; write a table, or shift the times'
            )
    return times


def _recorded(recording: Recording) -> list[_Series]:
    series = [_Series('/tensions', ARRAY, recording.tensions())]
    for quantity, topic in DEFAULT_TOPICS.items():
        values = getattr(recording, quantity)
        if values is not None:
            series.append(_Series(topic, NUMBER, values.tolist()))
    if recording.state is not None:
        series.append(_Series(STATE, TEXT, recording.state))
    if recording.readings is not None:
        series.append(_Series('/readings', ARRAY, list(zip(*recording.readings, strict=True))))
    return series


def _estimated(replay: Replay) -> list[_Series]:
    return [
        _Series(f'{PREFIX}regime', TEXT, replay.regime.tolist()),
        _Series(f'{PREFIX}bend_angle', NUMBER, _determined(replay.bend_angle)),
        _Series(f'{PREFIX}bend_angle_stddev', NUMBER, _determined(replay.bend_angle_stddev)),
        *_band(replay),
        _Series(f'{PREFIX}joint_pressure', NUMBER, _determined(replay.pressure)),
        _Series(f'{PREFIX}joint_pressure_stddev', NUMBER, _determined(replay.pressure_stddev)),
        _Series(f'{PREFIX}slip_margin', NUMBER, _determined(replay.slip_margin)),
        _Series(f'{PREFIX}angle_assured', BOOLEAN, replay.angle_assured.tolist()),
        _Series(f'{PREFIX}validity', TEXT, replay.validity.tolist()),
    ]


def _band(replay: Replay) -> list[_Series]:
    """What a filter says beside."""
    if replay.interval is None or replay.regime_probabilities is None:
        return []
    low, high = replay.interval
    return [
        _Series(f'{PREFIX}bend_angle_low', NUMBER, _determined(low)),
        _Series(f'{PREFIX}bend_angle_high', NUMBER, _determined(high)),
        *(
            _Series(f'{PREFIX}probability_{regime.value}', NUMBER, _determined(shares))
            for regime, shares in replay.regime_probabilities.items()
        ),
    ]


def _determined(values: Floats) -> list[float | None]:
    return [value if math.isfinite(value) else None for value in values.tolist()]


def _constructors(store: Any) -> dict[str, Callable[[Any], Any]]:
    """Type → what makes its message of a value."""
    layout = store.types['std_msgs/msg/MultiArrayLayout'](dim=[], data_offset=0)
    array = store.types[ARRAY]
    return {kind: store.types[kind] for kind in (NUMBER, TEXT, BOOLEAN)} | {
        ARRAY: lambda pair: array(layout=layout, data=np.array(pair))
    }
