"""Recordings of an arm in ROS bags: the tensions of all cables, and measured joint angles."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np

from ..arm_recording import ArmRecording
from ..errors import RecordingError
from ..progress import Progress, unseen
from ..session import OF_LOAD
from .bag import clocked_times, joined_to
from .bag_beside import Beside, default_beside, find_beside, named_beside
from .bag_storage import END_OF_TIME, Messages, read_messages
from .bag_tensions import find_tensions, tension_samples
from .bag_values import DYNAMIC, JOINT_STATE, messages_on, position_of
from .topics import DEFAULT_TENSIONS, BagTopics, full_name

DEFAULT_MEASURED = '/measured_joint_states'
"""Where the arm's estimator listens"""


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
    times, clocked = clocked_times(tensions, beside, topics, skew)
    samples = tension_samples(tensions, times, clocked, topics)
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
