"""Recordings of an arm in ROS bags: the tensions of all cables, and measured joint angles."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...tensions.pairing import Pairing, Part
from ...tensions.reason import Reason
from ..arm_recording import ArmRecording
from ..errors import RecordingError
from ..progress import Progress, unseen
from ..session import OF_LOAD
from .bag import clocked_times, joined_to
from .bag_beside import Beside, default_beside, find_beside, named_beside
from .bag_storage import END_OF_TIME, Messages, read_messages
from .bag_tensions import TensionMessages, find_tensions
from .bag_values import DYNAMIC, JOINT_STATE, messages_on, position_of
from .topics import DEFAULT_TENSIONS, BagTopics, full_name

DEFAULT_MEASURED = '/measured_joint_states'
"""Where the arm's estimator listens"""


class ArmSample(NamedTuple):
    """The tensions of all cables, or why there are none."""

    order: int
    """Place among the messages of the bag of that which completed it"""
    time: int
    """ns"""
    tensions: tuple[float, ...]
    fault: str = ''
    """A `Reason`; empty if there is none"""


def load_arm_bag(path: Path, topics: BagTopics, progress: Progress = unseen) -> ArmRecording:
    """Read a bag of an arm: one sample for each set of tensions of all its cables.

    The rest is as in `load_bag`.

    Parameters
    ----------
    topics : BagTopics
        With cables and joints of the arm; `BagTopics.bend_angle` is the topic of joint states.

    Raises
    ------
    RecordingError
        If a topic is missing or of another type, or no message has a cable's tension.
    """
    measured = full_name(topics.bend_angle or DEFAULT_MEASURED)
    (name,) = topics.tensions or (DEFAULT_TENSIONS,)
    name = full_name(name)
    topics = dataclasses.replace(topics, bend_angle=None)
    needed = [name, *map(full_name, named_beside(topics))]
    needed += [measured] if measured != DEFAULT_MEASURED else []
    bag = read_messages(path, {*needed, measured, *default_beside(topics)}, progress)
    for topic in needed:
        if topic not in bag.types:
            there = ', '.join(f'{of} ({kind})' for of, kind in sorted(bag.types.items()))
            raise RecordingError(f'there is no topic {topic}; there are: {there or "none"}')
    tensions = find_tensions(bag, [name], topics)
    beside = find_beside(bag, topics)
    _add_angles(beside, bag, measured, topics.arm_joints)
    skew = round(min(topics.max_skew * 1e9, END_OF_TIME))
    times, clocked = clocked_times([tensions.messages, beside.messages], topics.clock, skew)
    apart = topics.max_skew if topics.tension_skew is None else topics.tension_skew
    samples = _samples(tensions, times, len(topics.cable_names), apart)
    if clocked.late & tensions.messages.keys():
        samples.sort(key=lambda sample: sample.time)
    at = np.array([sample.time for sample in samples], dtype=np.int64)
    origin = int(at.min())
    columns = zip(*(sample.tensions for sample in samples), strict=True)
    angles = {
        joint: joined_to(at, beside, f'bend_angle_{joint}', times, skew)
        for joint in range(1, len(topics.arm_joints) + 1)
    }
    load: dict[str, Any] = {of: joined_to(at, beside, of, times, skew) for of in OF_LOAD}
    return ArmRecording(
        {cable: np.array(of) for cable, of in zip(topics.cable_names, columns, strict=True)},
        {joint: of for joint, of in angles.items() if of is not None and np.isfinite(of).any()},
        **load,
        faults=[sample.fault for sample in samples],
        in_newtons=tensions.in_newtons,
        time=1e-9 * (at - origin).astype(np.float64),
        time_origin=origin,
        name=path.name,
        damage=tuple(bag.damage),
        notes=(*bag.notes, *beside.notes, *clocked.notes),
        clock=clocked.named,
    )


def _add_angles(beside: Beside, bag: Messages, topic: str, joints: tuple[str, ...]) -> None:
    """Add the measured angles of the joints that are named on a topic, if it is there."""
    if topic in bag.types:
        messages = messages_on(bag, topic, (JOINT_STATE, DYNAMIC))
        readers = {
            f'bend_angle_{number}': position_of(joint)
            for number, joint in enumerate(joints, start=1)
        }
        beside.add(bag, topic, messages, readers)


def _samples(
    found: TensionMessages, times: Mapping[int, int], count: int, max_skew: float
) -> list[ArmSample]:
    """Join messages with a part of the cables; keep what has no partner, with NaN and why."""
    samples: list[ArmSample] = []

    def deliver(parts: list[Part]) -> None:
        values = {cable: of for part in parts for cable, of in part.values.items()}
        tensions = tuple(values[cable] for cable in range(count))
        order, time = (max(of) for of in zip(*((p.source, p.time) for p in parts), strict=True))
        samples.append(ArmSample(order, time, tensions))

    def drop(part: Part) -> None:
        tensions = tuple(part.values.get(cable, math.nan) for cable in range(count))
        samples.append(ArmSample(part.source, part.time, tensions, Reason.UNPAIRED.value))

    pairing = Pairing(count, lambda: max_skew, deliver, drop)
    for topic, messages in found.messages.items():
        for message, values in zip(messages, found.values[topic], strict=True):
            order, time = message.order, times[message.order]
            if values.fault is not None:
                nothing = (math.nan,) * count
                samples.append(ArmSample(order, time, nothing, values.fault[0].value))
                continue
            known = {cable: of for cable, of in enumerate(values.values) if of is not None}
            if len(known) == count:
                samples.append(ArmSample(order, time, tuple(known.values())))
            else:
                pairing.take(Part(time, known, order))
    pairing.forget()
    return sorted(samples, key=lambda sample: sample.order)
