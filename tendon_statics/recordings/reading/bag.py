"""Recordings in ROS bags: from messages on topics to samples."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import RecordingError
from ..progress import Progress, unseen
from ..recording import Recording
from .bag_storage import END_OF_TIME, Message, Messages, read_messages, without_copies
from .bag_tensions import find_tensions, tension_samples
from .bag_values import (
    DYNAMIC,
    JOINT_STATE,
    NUMBER,
    NUMBER_32,
    TEXT,
    joints_on,
    messages_on,
    position_of,
)
from .clock import Stamped, Times, common_clock
from .topics import DEFAULT_PAIR, DEFAULT_TENSIONS, BagTopics, full_name

DEFAULT_BEND_ANGLE = '/measured_bend_angle'
DEFAULT_PRESSURE = '/measured_pressure'
REPLAYED = '/replay/regime'
"""Topic of a bag that `replay` has written, whose tensions are in N"""


def load_bag(path: Path, topics: BagTopics, progress: Progress = unseen) -> Recording:
    """Read a bag, as `load_recording` does: one sample for each pair of tensions.

    The samples stand in the order of recording, but for messages that came late. Their times are
    by the clock that is chosen (`common_clock`). Angle, pressure and state are those of the
    message nearest in time, if it is not farther than `BagTopics.max_skew`.
    """
    required = [*(topics.tensions or ()), topics.bend_angle, topics.pressure, topics.state]
    defaults = [DEFAULT_TENSIONS, *DEFAULT_PAIR, DEFAULT_BEND_ANGLE, DEFAULT_PRESSURE]
    wanted = {full_name(name) for name in [*required, *defaults] if name}
    bag = read_messages(path, wanted, progress)
    names = _tension_topics(bag, topics)
    for name in filter(None, [*names, *required]):
        if full_name(name) not in bag.types:
            there = ', '.join(f'{topic} ({kind})' for topic, kind in sorted(bag.types.items()))
            why = f'; {bag.damage[0]}' if bag.damage else ''
            raise RecordingError(
                f'there is no topic {full_name(name)}; there are: {there or "none"}{why}'
            )
    tensions = find_tensions(bag, names, topics)
    others = _others(bag, topics)
    skew = round(min(topics.max_skew * 1e9, END_OF_TIME))
    times, late, notes = _times([tensions.messages, others.messages], topics.clock, skew)
    tension_skew = topics.max_skew if topics.tension_skew is None else topics.tension_skew
    samples = tension_samples(tensions, times, tension_skew)
    if late & tensions.messages.keys():
        samples.sort(key=lambda sample: sample.time)
    at = np.array([sample.time for sample in samples], dtype=np.int64)
    origin = int(at.min())

    def joined(name: str | None, missing: Any) -> npt.NDArray[Any] | None:
        if name is None or name not in others.messages:
            return None
        values = np.array([*others.values[name], missing])
        there = np.array([times[message.order] for message in others.messages[name]], np.int64)
        return values[_nearest(there, at, skew)]

    state = joined(others.state, '')
    return Recording(
        tension_l=np.array([sample.tension_l for sample in samples]),
        tension_s=np.array([sample.tension_s for sample in samples]),
        bend_angle=joined(others.bend_angle, np.nan),
        pressure=joined(others.pressure, np.nan),
        state=None if state is None else state.tolist(),
        faults=[sample.fault for sample in samples],
        in_newtons=tensions.in_newtons or REPLAYED in bag.types,
        time=1e-9 * (at - origin).astype(np.float64),
        time_origin=origin,
        name=path.name,
        damage=tuple(bag.damage),
        notes=(*bag.notes, *notes),
    )


def _times(
    used: Sequence[Mapping[str, Sequence[Message]]], clock: str, skew: int
) -> tuple[dict[int, int], set[str], list[str]]:
    """Return the time of every message, by its order, as `common_clock` chooses it.

    One topic may tell more than one thing.
    """
    on: dict[str, dict[int, Message]] = {}
    for messages_by_topic in used:
        for topic, messages in messages_by_topic.items():
            on.setdefault(topic, {}).update((message.order, message) for message in messages)
    ordered = {topic: sorted(messages) for topic, messages in on.items()}
    stamped = {
        topic: Stamped.of((on[topic][order].stamp, on[topic][order].log_time) for order in orders)
        for topic, orders in ordered.items()
    }
    times, late, notes = common_clock(stamped, clock, skew)
    by_order = {
        order: time
        for topic, orders in ordered.items()
        for order, time in zip(orders, times[topic].tolist(), strict=True)
    }
    return by_order, late, notes


def _tension_topics(bag: Messages, topics: BagTopics) -> list[str]:
    """Return the topics of the tensions: those that are named, or where the estimator listens."""
    if topics.tensions is not None:
        return [full_name(name) for name in topics.tensions]
    there = DEFAULT_TENSIONS in bag.types
    if topics.tension_source == 'wrench_pair' or (
        not there and topics.tension_source is None and set(DEFAULT_PAIR) <= bag.types.keys()
    ):
        return [*DEFAULT_PAIR]
    return [DEFAULT_TENSIONS]


class _Others:
    """What was measured beside the tensions: topics with messages and values, and their names."""

    def __init__(self) -> None:
        self.messages: dict[str, list[Message]] = {}
        self.values: dict[str, list[Any]] = {}
        self.bend_angle: str | None = None
        self.pressure: str | None = None
        self.state: str | None = None

    def add(
        self,
        bag: Messages,
        name: str,
        messages: Sequence[Message],
        value: Callable[[Message], Any],
    ) -> None:
        """Add the messages on a topic, but for those that have no value, and copies."""
        messages = without_copies(bag, name, messages)
        pairs = [(message, value(message)) for message in messages]
        self.messages[name] = [message for message, found in pairs if found is not None]
        self.values[name] = [found for _, found in pairs if found is not None]


def _others(bag: Messages, topics: BagTopics) -> _Others:
    others = _Others()
    name = full_name(topics.bend_angle or DEFAULT_BEND_ANGLE)
    if name in bag.types:
        others.bend_angle = name
        _add_bend_angle(others, bag, name, topics.joint_name)
    name = full_name(topics.pressure or DEFAULT_PRESSURE)
    if name in bag.types:
        others.pressure = name
        messages = messages_on(bag, name, (NUMBER, NUMBER_32))
        others.add(bag, name, messages, lambda message: float(message.content.data))
    if topics.state is not None:
        others.state = name = full_name(topics.state)
        others.add(
            bag, name, messages_on(bag, name, (TEXT,)), lambda message: message.content.data
        )
    return others


def _add_bend_angle(others: _Others, bag: Messages, topic: str, joint: str | None) -> None:
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
    others.add(bag, topic, messages, position_of(name))
    if with_names and not any(map(_is_known, others.values[topic])):
        there = [one for one in joints if any(_is_known(position_of(one)(m)) for m in messages)]
        raise RecordingError(
            f'no message on {topic} has the position of {name}; '
            f'there is that of: {", ".join(sorted(there)) or "none"}'
        )


def _is_known(value: float | None) -> bool:
    return value is not None and not math.isnan(value)


def _nearest(there: Times, times: Times, skew: int) -> npt.NDArray[np.intp]:
    """Index of the time nearest to each of `times`, −1 where none is within `skew`; all in ns."""
    if not len(there):
        return np.full(len(times), -1)
    order = np.argsort(there, kind='stable')
    ordered = there[order]
    after = np.searchsorted(ordered, times).clip(0, len(there) - 1)
    before = (after - 1).clip(0)
    nearest = np.where(times - ordered[before] <= ordered[after] - times, before, after)
    return np.where(abs(ordered[nearest] - times) <= skew, order[nearest], -1)
