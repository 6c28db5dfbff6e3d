"""The node of an arm of ten joints: beside a relay of the same messages, and ten estimators.

Each message is a `JointState` of 20 efforts, and so is each answer, of 10 positions. The tensions
are noisy and hold the arm, as on most of a rig's day; `bench.arm` has what slips cost.
"""

from __future__ import annotations

import dataclasses
import json
import sys
import tempfile
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from statistics import median

import numpy as np
from ament_index_python.packages import get_package_prefix
from ros_domain import own_domain
from sensor_msgs.msg import JointState

from tendon_statics import Arm

from .arm import JOINTS, arm_of_ten
from .caller import LOAD, Answer, Stream, Talk, calling
from .node import in_turn, median_ratio, said_of_losses, whole_rounds
from .rows import Row, at_most

RATE = 1000.0
"""Hz"""

STARTS = 3
STREAMS, COUNT = 10, 300
WARM_UP = 300

SLOW_RATE = 50.0
"""Hz, at which a machine bears eleven processes"""
SLOW_STREAMS, SLOW_COUNT = 4, 100

NOISE = 0.003
"""N"""

PROGRAMS = Path(get_package_prefix('tendon_statics'), 'lib', 'tendon_statics')
RELAY = (sys.executable, Path(__file__).with_name('arm_relay.py'))


def rows() -> list[Row]:
    """Measure."""
    arm = arm_of_ten('merged')
    talk = Talk((_joint_states('arm_estimator'),), _messages(arm), np.zeros((LOAD, 1)))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, 'arm.yaml')
        file.write_text(_as_file(arm), encoding='utf-8')
        ours = (PROGRAMS / 'arm_estimator', '--ros-args', '-p', f'arm_file:={file}')
        return [*_beside_relay(ours, talk), _beside_single_estimators(arm, ours, talk)]


def _beside_relay(ours: Sequence[str | Path], talk: Talk) -> list[Row]:
    streams: list[list[Stream]] = [[], []]
    for _ in range(STARTS):
        with own_domain(), ExitStack() as stack:
            callers = [
                stack.enter_context(calling(name, [command], talk))
                for name, command in (('relay', RELAY), ('arm', ours))
            ]
            for caller in callers:
                caller.stream(RATE, WARM_UP)
            new = in_turn([lambda c=caller: c.stream(RATE, COUNT) for caller in callers], STREAMS)
        for known, of_program in zip(streams, new, strict=True):
            known += of_program
    relayed, estimated = streams
    rounds = whole_rounds(estimated, relayed)
    work, against = f'arm_estimator, {JOINTS} joints, 1 kHz', 'bare relay of the same messages'
    back, lost = median_ratio(rounds, 'there_and_back'), sum(of.lost for of in estimated)
    return [
        Row(
            f'{work}, there and back (p50); {said_of_losses(estimated, relayed, rounds)}',
            against,
            back,
            '≤ 1.5 times, 0 lost',
            back <= 1.5 and lost == 0,
        ),
        at_most(f'{work}, CPU per message', against, median_ratio(rounds, 'cpu'), 2.0),
    ]


def _beside_single_estimators(arm: Arm, ours: Sequence[str | Path], talk: Talk) -> Row:
    """Return the row of ten estimators that are fed the same and tell an angle each."""
    names = [f'unit_{joint}' for joint in range(1, JOINTS + 1)]
    law = arm.designs[0]
    commands = [
        (
            PROGRAMS / 'estimator',
            *('--ros-args', '-r', f'__node:={name}', '-p', 'tension_source:=joint_state'),
            *('-p', f'cable_names:=[l{joint}, s{joint}]', '-p', 'estimation:=tracking'),
            *(part for key, of in dataclasses.asdict(law).items() for part in _set(key, of)),
        )
        for joint, name in enumerate(names, start=1)
    ]
    of_units = talk._replace(
        answers=[_joint_states(name, 'joint_state') for name in names],
        expected=np.zeros((LOAD, JOINTS)),
    )
    with own_domain(), ExitStack() as stack:
        callers = [
            stack.enter_context(calling('arm', [ours], talk)),
            stack.enter_context(calling('units', commands, of_units)),
        ]
        for caller in callers:
            caller.stream(SLOW_RATE, SLOW_COUNT)
        one, ten = in_turn(
            [lambda c=caller: c.stream(SLOW_RATE, SLOW_COUNT) for caller in callers], SLOW_STREAMS
        )
    ratio = median(a.cpu / b.cpu for a, b in zip(one, ten, strict=True))
    lost = sum(stream.lost for stream in one)
    return Row(
        f'arm_estimator, {JOINTS} joints, {SLOW_RATE:g} Hz, CPU per message; {lost} answers lost, '
        f'{sum(stream.lost for stream in ten)} by the ten',
        f'{JOINTS} estimators, tracking, fed the same messages',
        ratio,
        '≤ 0.2 times',
        ratio <= 0.2,
    )


def _set(name: str, value: object) -> tuple[str, str]:
    return '-p', f'design.{name}:={value}'


def _joint_states(node: str, topic: str = 'joint_states') -> Answer:
    return Answer(topic, JointState, lambda message: message.position[-1], node)


def _messages(arm: Arm) -> list[JointState]:
    generator = np.random.default_rng(1)
    tensions = generator.normal(1.0, NOISE, (LOAD, len(arm.cables))).tolist()
    return [JointState(name=list(arm.cable_names), effort=row) for row in tensions]


def _as_file(arm: Arm) -> str:
    """Return an arm as its file; JSON is YAML."""
    return json.dumps(
        {
            'units': [
                {'design': dataclasses.asdict(unit.design), 'length': unit.length}
                for unit in arm.units
            ],
            'cables': [
                {key: of for key, of in dataclasses.asdict(cable).items() if of is not None}
                for cable in arm.cables
            ],
        }
    )
