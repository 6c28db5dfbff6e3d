"""What a bag has beside the tensions: angle, pressure, state, and what acts on the unit."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ..errors import RecordingError
from .bag_load import BASES, WRENCHES, base_angles, tip_force
from .bag_record import TEXT
from .bag_storage import Message, Messages, without_copies
from .bag_values import (
    DYNAMIC,
    JOINT_STATE,
    NUMBER,
    NUMBER_32,
    joints_on,
    messages_on,
    position_of,
)
from .topics import BagTopics, full_name

DEFAULT_TOPICS = {
    'bend_angle': '/measured_bend_angle',
    'pressure': '/measured_pressure',
    'base_tilt': '/measured_base_tilt',
    'base_roll': '/measured_base_roll',
    'tip_force_x': '/measured_tip_force_x',
    'tip_force_z': '/measured_tip_force_z',
}
"""Quantity → where its number is looked for if it is not named, and written by a replay"""

ESTIMATORS = {'imu': '/imu', 'pose': '/base_pose'}
"""Value of ``gravity_source`` → where the estimator listens"""


@dataclasses.dataclass(frozen=True)
class Series:
    """The messages that tell one quantity, and what they say."""

    messages: Sequence[Message]
    values: Sequence[Any]


@dataclasses.dataclass
class Beside:
    """What was measured beside the tensions."""

    messages: dict[str, Sequence[Message]] = dataclasses.field(default_factory=dict)
    """By topic"""
    series: dict[str, Series] = dataclasses.field(default_factory=dict)
    """By quantity of a `Recording`"""
    notes: list[str] = dataclasses.field(default_factory=list)

    def add(
        self,
        bag: Messages,
        topic: str,
        messages: Sequence[Message],
        read: Mapping[str, Callable[[Message], Any]],
    ) -> None:
        """Add what the messages on a topic say of each quantity, but for copies.

        A message that has no value of a quantity, None, is left out for it.
        """
        messages = without_copies(bag, topic, messages)
        self.messages[topic] = messages
        for quantity, value in read.items():
            told = [(message, value(message)) for message in messages]
            told = [(message, found) for message, found in told if found is not None]
            self.series[quantity] = Series([m for m, _ in told], [found for _, found in told])


def default_beside(topics: BagTopics) -> Iterator[str]:
    """Topics that are looked at without being named."""
    yield from DEFAULT_TOPICS.values()
    if topics.gravity_source in ESTIMATORS:
        yield ESTIMATORS[topics.gravity_source]


def named_beside(topics: BagTopics) -> Iterator[str]:
    """Topics that have to be there, since they are named."""
    names = (topics.bend_angle, topics.pressure, topics.state, topics.base, topics.tip_wrench)
    yield from filter(None, names)


def find_beside(bag: Messages, topics: BagTopics) -> Beside:
    """Find all that is there of what was measured beside the tensions.

    Raises
    ------
    RecordingError
        If a topic has messages of another type, or its joint is not known.
    """
    beside = Beside()
    name = full_name(topics.bend_angle or DEFAULT_TOPICS['bend_angle'])
    if name in bag.types:
        _add_bend_angle(beside, bag, name, topics.joint_name)
    _add_number(beside, bag, 'pressure', topics.pressure)
    _add_base(beside, bag, topics)
    if topics.tip_wrench is not None:
        name = full_name(topics.tip_wrench)
        read = {'tip_force_x': tip_force('x'), 'tip_force_z': tip_force('z')}
        beside.add(bag, name, messages_on(bag, name, WRENCHES), read)
    else:
        _add_number(beside, bag, 'tip_force_x')
        _add_number(beside, bag, 'tip_force_z')
    if topics.state is not None:
        name = full_name(topics.state)
        messages = messages_on(bag, name, (TEXT,))
        beside.add(bag, name, messages, {'state': lambda message: message.content.data})
    return beside


def _add_number(beside: Beside, bag: Messages, quantity: str, topic: str | None = None) -> None:
    """Add a quantity that has a topic of plain numbers, if it is there."""
    name = full_name(topic or DEFAULT_TOPICS[quantity])
    if name in bag.types:
        messages = messages_on(bag, name, (NUMBER, NUMBER_32))
        beside.add(bag, name, messages, {quantity: lambda message: float(message.content.data)})


def _add_base(beside: Beside, bag: Messages, topics: BagTopics) -> None:
    """Add where gravity points in the joint frame, by an IMU, a pose or a plain tilt."""
    name = full_name(topics.base or ESTIMATORS.get(topics.gravity_source, ''))
    if name in bag.types and bag.types[name] not in (NUMBER, NUMBER_32):
        messages = messages_on(bag, name, BASES)
        angles = base_angles(topics.imu_mounting)
        read = [(message, angles(message)) for message in messages]
        told = {message.order: found for message, found in read if found is not None}
        lost = len(read) - len(told)
        if lost:
            beside.notes.append(
                f'{lost} of {len(read)} messages on {name} are left out, since they tell no '
                'direction of gravity: a quaternion is not of length 1, or a base not at rest'
            )
        known = [message for message in messages if message.order in told]
        readers: dict[str, Callable[[Message], float]] = {
            'base_tilt': lambda message: told[message.order][0],
            'base_roll': lambda message: told[message.order][1],
        }
        beside.add(bag, name, known, readers)
        return
    _add_number(beside, bag, 'base_tilt', topics.base)
    _add_number(beside, bag, 'base_roll')


def _add_bend_angle(beside: Beside, bag: Messages, topic: str, joint: str | None) -> None:
    """Add the angles on a topic.

    Raises
    ------
    RecordingError
        If it is to be said which joint is meant, or no message has its position.
    """
    kinds = (NUMBER, NUMBER_32, JOINT_STATE, DYNAMIC)
    messages = messages_on(bag, topic, kinds)
    with_names = bool(messages) and messages[0].kind in (JOINT_STATE, DYNAMIC)
    joints = joints_on(messages) if with_names else []
    if joint is None and len(joints) > 1:
        raise RecordingError(f'the topic {topic} has joints {", ".join(joints)}; name one of them')
    name = joint or next(iter(joints), 'a joint')
    beside.add(bag, topic, messages, {'bend_angle': position_of(name)})
    if with_names and not any(map(_is_known, beside.series['bend_angle'].values)):
        there = [one for one in joints if any(_is_known(position_of(one)(m)) for m in messages)]
        raise RecordingError(
            f'no message on {topic} has the position of {name}; '
            f'there is that of: {", ".join(sorted(there)) or "none"}'
        )


def _is_known(value: float | None) -> bool:
    return value is not None and not math.isnan(value)
