"""Recordings in ROS 2 bags: from messages on topics to samples."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..errors import RecordingError
from ..progress import Progress, unseen
from ..recording import Floats, Recording
from .bag_storage import END_OF_TIME, Messages, read_messages
from .topics import BagTopics, full_name

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
    required = [*topics.tensions, topics.bend_angle, topics.pressure, topics.state]
    wanted = [*required, DEFAULT_BEND_ANGLE, DEFAULT_PRESSURE]
    bag = read_messages(path, [full_name(name) for name in wanted if name], progress)
    for name in filter(None, required):
        if full_name(name) not in bag.types:
            there = ', '.join(f'{topic} ({kind})' for topic, kind in sorted(bag.types.items()))
            raise RecordingError(
                f'there is no topic {full_name(name)}; there are: {there or "none"}{_why(bag)}'
            )
    skew = round(min(topics.max_skew * 1e9, END_OF_TIME))
    tensions = _tensions(bag, topics, skew)
    origin = int(tensions.times[0])

    def joined(name: str, series: Callable[[Messages, str], _Series]) -> Floats | None:
        if full_name(name) not in bag.types:
            return None
        return _nearest_numbers(series(bag, full_name(name)), tensions.times, skew)

    return Recording(
        tension_l=np.array([pair[0] for pair in tensions.values]),
        tension_s=np.array([pair[1] for pair in tensions.values]),
        bend_angle=joined(
            topics.bend_angle or DEFAULT_BEND_ANGLE,
            lambda bag, name: _bend_angles(bag, name, topics.joint_name),
        ),
        pressure=joined(topics.pressure or DEFAULT_PRESSURE, _numbers),
        state=_states(bag, full_name(topics.state), tensions.times, skew)
        if topics.state
        else None,
        time=1e-9 * (tensions.times - origin).astype(np.float64),
        time_origin=origin,
        name=path.name,
        damage=tuple(bag.damage),
    )


def _why(bag: Messages) -> str:
    return f'; {bag.damage[0]}' if bag.damage else ''


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


_Reader = Callable[[Messages, str], _Series]
"""Reads the values of a topic"""


def _of_type(bag: Messages, topic: str, readers: dict[str, _Reader]) -> _Reader:
    """Return what reads a topic by its type.

    Raises
    ------
    RecordingError
        If the type is none of those.
    """
    kind = bag.types[topic]
    if kind not in readers:
        raise RecordingError(f'the topic {topic} is a {kind}; {" or ".join(readers)} is needed')
    return readers[kind]


def _each(value: Callable[[Any], Any]) -> _Reader:
    """Return what reads a value from each message."""
    return lambda bag, topic: _series(bag, topic, value)


def _tensions(bag: Messages, topics: BagTopics, skew: int) -> _Series:
    names = [full_name(name) for name in topics.tensions]
    kinds: dict[str, _Reader] = {
        ARRAY: _pairs,
        JOINT_STATE: lambda bag, topic: _named(bag, topic, topics.cable_names, 'effort'),
        ESTIMATE: _each(lambda message: (message.tension_l, message.tension_s)),
    }
    if len(names) == 2:
        kinds = {WRENCH: _each(lambda message: _force(message, topics.force_component))}
    readers = [_of_type(bag, name, kinds) for name in names]
    for name in names:
        if not bag.messages[name]:
            raise RecordingError(f'there is no message on {name}{_why(bag)}')
    first, *second = (read(bag, name) for read, name in zip(readers, names, strict=True))
    if not second:
        return first
    paired = _nearest_numbers(second[0], first.times, skew)
    return _Series(first.times, list(zip(first.values, paired, strict=True)))


def _force(message: Any, component: str) -> float:
    vector = message.wrench.force
    if component == 'norm':
        return math.hypot(vector.x, vector.y, vector.z)
    return float(getattr(vector, component))


def _pairs(bag: Messages, topic: str) -> _Series:
    """Both tensions of each array, NaN of one that does not have two numbers.

    Raises
    ------
    RecordingError
        If none has.
    """
    lengths = sorted({len(message.data) for _, message in bag.messages[topic]})
    if 2 not in lengths:
        raise RecordingError(
            f'the messages on {topic} hold {" or ".join(map(str, lengths))} numbers; '
            'two are needed, T_l and T_s'
        )

    def pair(message: Any) -> tuple[float, float]:
        data = message.data
        return (float(data[0]), float(data[1])) if len(data) == 2 else (math.nan, math.nan)

    return _series(bag, topic, pair)


def _named(bag: Messages, topic: str, names: Sequence[str], field: str) -> _Series:
    """Values of some names in each ``JointState``, a tuple; NaN of a name that is not in it.

    Raises
    ------
    RecordingError
        If there are messages, but none with a value of each name.
    """
    there: set[str] = set()
    complete = not bag.messages[topic]

    def values(message: Any) -> tuple[float, ...]:
        nonlocal complete
        held = dict(zip(message.name, getattr(message, field), strict=False))
        there.update(held)
        complete = complete or held.keys() >= set(names)
        return tuple(float(held.get(name, math.nan)) for name in names)

    series = _series(bag, topic, values)
    if not complete:
        raise RecordingError(
            f'no message on {topic} has the {field} of {" and ".join(names)}; '
            f'there is that of: {", ".join(sorted(there)) or "none"}'
        )
    return series


def _numbers(bag: Messages, topic: str) -> _Series:
    return _of_type(bag, topic, {NUMBER: _each(lambda message: message.data)})(bag, topic)


def _bend_angles(bag: Messages, topic: str, joint_name: str | None) -> _Series:
    def positions(bag: Messages, topic: str) -> _Series:
        joints = {name: None for _, message in bag.messages[topic] for name in message.name}
        if joint_name is None and len(joints) > 1:
            raise RecordingError(
                f'the topic {topic} has joints {", ".join(joints)}; name one of them'
            )
        name = next(iter(joints), 'a joint') if joint_name is None else joint_name
        series = _named(bag, topic, (name,), 'position')
        return _Series(series.times, [position for (position,) in series.values])

    readers = {NUMBER: _each(lambda message: message.data), JOINT_STATE: positions}
    return _of_type(bag, topic, readers)(bag, topic)


def _states(bag: Messages, topic: str, times: npt.NDArray[np.int64], skew: int) -> list[str]:
    series = _of_type(bag, topic, {TEXT: _each(lambda message: message.data)})(bag, topic)
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
