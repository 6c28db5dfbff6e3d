"""Recordings in ROS 2 bags: from messages on topics to samples."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .bag_storage import Messages, read_messages
from .errors import RecordingError
from .progress import Progress, unseen
from .recording import Floats, Recording
from .topics import FORCE_COMPONENTS, BagTopics

DEFAULT_BEND_ANGLE = '/measured_bend_angle'
DEFAULT_PRESSURE = '/measured_pressure'

ARRAY = 'std_msgs/msg/Float64MultiArray'
NUMBER = 'std_msgs/msg/Float64'
TEXT = 'std_msgs/msg/String'
JOINT_STATE = 'sensor_msgs/msg/JointState'
WRENCH = 'geometry_msgs/msg/WrenchStamped'
ESTIMATE = 'tendon_statics_interfaces/msg/Estimate'


class _Series(NamedTuple):
    """What one topic says, in the order of time."""

    times: npt.NDArray[np.int64]
    """ns"""
    values: Sequence[Any]


def load_bag(path: Path, topics: BagTopics, progress: Progress = unseen) -> Recording:
    """Read a bag, as `load_recording` does: one sample for each message of tensions.

    The time of a message is the stamp in its header, where it has one, else the time at which it
    was recorded. Angle, pressure and state are those of the message nearest in time, if it is not
    farther than `BagTopics.max_skew`; so is the second tension of a pair.
    """
    if len(topics.tensions) not in (1, 2):
        raise RecordingError(
            f'{len(topics.tensions)} topics of tensions are named; '
            'one is needed, or a pair for cables l and s'
        )
    required = [*topics.tensions, topics.bend_angle, topics.pressure, topics.state]
    wanted = [*required, DEFAULT_BEND_ANGLE, DEFAULT_PRESSURE]
    bag = read_messages(path, [_full(name) for name in wanted if name], progress)
    for name in filter(None, required):
        if _full(name) not in bag.types:
            there = ', '.join(f'{topic} ({kind})' for topic, kind in sorted(bag.types.items()))
            raise RecordingError(
                f'there is no topic {_full(name)}; there are: {there or "none"}{_why(bag)}'
            )
    tensions = _tensions(bag, topics)
    if not len(tensions.times):
        raise RecordingError(f'there is no message on {_full(topics.tensions[0])}{_why(bag)}')
    origin = int(tensions.times[0])
    skew = round(topics.max_skew * 1e9)

    def joined(name: str, series: Callable[[Messages, str], _Series]) -> Floats | None:
        if _full(name) not in bag.types:
            return None
        return _nearest_numbers(series(bag, _full(name)), tensions.times, skew)

    return Recording(
        tension_l=np.array([pair[0] for pair in tensions.values]),
        tension_s=np.array([pair[1] for pair in tensions.values]),
        bend_angle=joined(
            topics.bend_angle or DEFAULT_BEND_ANGLE,
            lambda bag, name: _bend_angles(bag, name, topics.joint_name),
        ),
        pressure=joined(topics.pressure or DEFAULT_PRESSURE, _numbers),
        state=_states(bag, _full(topics.state), tensions.times, skew) if topics.state else None,
        time=1e-9 * (tensions.times - origin).astype(np.float64),
        time_origin=origin,
        name=path.name,
        damage=tuple(bag.damage),
    )


def _why(bag: Messages) -> str:
    return f'; {bag.damage[0]}' if bag.damage else ''


def _full(topic: str) -> str:
    """Return a topic's name as it stands in a bag."""
    return topic if topic.startswith('/') else f'/{topic}'


def _series(bag: Messages, topic: str, value: Callable[[Any], Any]) -> _Series:
    """Take a value from each message of a topic, in the order of time."""
    timed = [
        (_time(message, log_time), value(message)) for log_time, message in bag.messages[topic]
    ]
    timed.sort(key=lambda entry: entry[0])
    return _Series(np.array([time for time, _ in timed], np.int64), [value for _, value in timed])


def _time(message: Any, log_time: int) -> int:
    """Return a message's time in ns: its stamp, or when it was recorded."""
    header = getattr(message, 'header', None)
    stamp = 0 if header is None else header.stamp.sec * 1_000_000_000 + header.stamp.nanosec
    return stamp or log_time


def _of_type(bag: Messages, topic: str, readers: dict[str, Any]) -> Any:
    """Return what is to be done with a topic by its type.

    Raises
    ------
    RecordingError
        If the type is none of those.
    """
    kind = bag.types[topic]
    if kind not in readers:
        raise RecordingError(f'the topic {topic} is a {kind}; {" or ".join(readers)} is needed')
    return readers[kind]


def _tensions(bag: Messages, topics: BagTopics) -> _Series:
    names = [_full(name) for name in topics.tensions]
    if len(names) == 1:
        readers = {
            ARRAY: _pair_of_array,
            JOINT_STATE: lambda message: tuple(
                _named(message, cable, message.effort) for cable in topics.cable_names
            ),
            ESTIMATE: lambda message: (message.tension_l, message.tension_s),
        }
        return _series(bag, names[0], _of_type(bag, names[0], readers))
    if topics.force_component not in FORCE_COMPONENTS:
        raise RecordingError(
            f'the force component is {topics.force_component!r}; '
            f'there are {", ".join(FORCE_COMPONENTS)}'
        )

    def force(message: Any) -> float:
        vector = message.wrench.force
        if topics.force_component == 'norm':
            return math.hypot(vector.x, vector.y, vector.z)
        return float(getattr(vector, topics.force_component))

    of_l, of_s = (_series(bag, name, _of_type(bag, name, {WRENCH: force})) for name in names)
    paired = _nearest_numbers(of_s, of_l.times, round(topics.max_skew * 1e9))
    return _Series(of_l.times, list(zip(of_l.values, paired, strict=True)))


def _pair_of_array(message: Any) -> tuple[float, float]:
    data = message.data
    return (float(data[0]), float(data[1])) if len(data) == 2 else (math.nan, math.nan)


def _named(message: Any, name: str, values: Sequence[float]) -> float:
    """Return the value of a name in a ``JointState``; NaN if it has none."""
    try:
        return float(values[list(message.name).index(name)])
    except (ValueError, IndexError):
        return math.nan


def _numbers(bag: Messages, topic: str) -> _Series:
    return _series(bag, topic, _of_type(bag, topic, {NUMBER: lambda message: message.data}))


def _bend_angles(bag: Messages, topic: str, joint_name: str | None) -> _Series:
    def position(message: Any) -> float:
        name = joint_name
        if name is None:
            if len(message.name) > 1:
                raise RecordingError(
                    f'the topic {topic} has joints {", ".join(message.name)}; name one of them'
                )
            name = message.name[0] if len(message.name) else ''
        return _named(message, name, message.position)

    readers = {NUMBER: lambda message: message.data, JOINT_STATE: position}
    return _series(bag, topic, _of_type(bag, topic, readers))


def _states(bag: Messages, topic: str, times: npt.NDArray[np.int64], skew: int) -> list[str]:
    series = _series(bag, topic, _of_type(bag, topic, {TEXT: lambda message: message.data}))
    return [
        series.values[index] if index >= 0 else '' for index in _nearest(series.times, times, skew)
    ]


def _nearest_numbers(series: _Series, times: npt.NDArray[np.int64], skew: int) -> Floats:
    """Values nearest in time, NaN where none is near enough."""
    values = np.array([*series.values, math.nan], dtype=np.float64)
    return values[_nearest(series.times, times, skew)]


def _nearest(
    there: npt.NDArray[np.int64], times: npt.NDArray[np.int64], skew: int
) -> npt.NDArray[np.intp]:
    """Index of the time nearest to each of `times`, −1 where none is within `skew`; all in ns."""
    if not len(there):
        return np.full(len(times), -1)
    after = np.searchsorted(there, times).clip(0, len(there) - 1)
    before = (after - 1).clip(0)
    nearest = np.where(times - there[before] <= there[after] - times, before, after)
    return np.where(abs(there[nearest] - times) <= skew, nearest, -1)
