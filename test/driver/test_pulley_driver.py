"""The installed node ``pulley_driver``: what it plays, its faults and books, how it refuses."""

import dataclasses
import json
import math
import re
import signal
from contextlib import contextmanager

import pytest
from forked_programs import ForkedProgram
from geometry_msgs.msg import WrenchStamped
from rclpy.node import Node
from ros_programs import spinning, wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from tendon_statics import load_arm
from tendon_statics.driver.faults import FaultMaker
from tendon_statics.files.fault_settings import (
    IMPLAUSIBLE_TENSION,
    STAMP_FAULTS,
    Fault,
    FaultSettings,
)
from tendon_statics.files.installed_files import installed_config
from tendon_statics.recordings.reading.load import load_arm_recording, load_recording

ROWS = load_recording(installed_config('demo_tensions.csv')).tensions()
TOPICS = {
    'array': {'tensions': Float64MultiArray},
    'joint_state': {'tensions': JointState},
    'wrench_pair': {'tension_l': WrenchStamped, 'tension_s': WrenchStamped},
}
KINDS = tuple(TOPICS)
CABLES = ('cable_l', 'cable_s')


class Audience(Node):
    """Keeps what the driver plays, by topic."""

    def __init__(self, context, kind):
        super().__init__('audience', context=context)
        self.messages = {topic: [] for topic in TOPICS[kind]}
        for topic, message_type in TOPICS[kind].items():
            self.create_subscription(message_type, topic, self.messages[topic].append, 10000)

    def count(self):
        """Messages on all topics."""
        return sum(map(len, self.messages.values()))


@contextmanager
def audience(kind='array'):
    with spinning(lambda context: Audience(context, kind)) as node:
        yield node


def driver(*arguments):
    return ForkedProgram.running(
        'pulley_driver',
        *('--ros-args', '-p', 'awaited_subscribers:=1'),
        *(part for argument in arguments for part in ('-p', argument)),
    )


def books(program):
    """What it says that it sent."""
    (line,) = re.findall(r'Sent: (.*)', program.output())
    return json.loads(line)


def nanoseconds(message):
    return message.header.stamp.sec * 10**9 + message.header.stamp.nanosec


def write(folder, *rows):
    path = folder / 'run.csv'
    path.write_text('tension_l,tension_s\n' + ''.join(f'{a},{b}\n' for a, b in rows))
    return path


def test_it_plays_every_row_once_in_order():
    with audience() as heard, driver('loop:=false', 'rate:=200.0') as program:
        wait_for('the books', lambda: 'Sent: ' in program.output())
        wait_for('every row', lambda: heard.count() == len(ROWS))
        assert [tuple(message.data) for message in heard.messages['tensions']] == ROWS
        assert program.end() == 0
        sent = books(program)
    # Of moments, not of rows: where a machine made it pause.
    assert sent.pop('skipped') >= 0
    expected = {'readings': len(ROWS), 'messages': len(ROWS), 'good': len(ROWS)}
    assert {key: value for key, value in sent.items() if value} == expected


def test_it_begins_anew_with_the_file_it_is_given(tmp_path):
    path = write(tmp_path, (1.0, 2.0), (3.0, 4.0))
    with audience() as heard, driver(f'file:={path}', 'rate:=200', 'count:=5') as program:
        wait_for('a third round', lambda: heard.count() == 5)
        wait_for('the books', lambda: 'Sent: ' in program.output())
        played = [tuple(message.data) for message in heard.messages['tensions']]
    assert played == [(1.0, 2.0), (3.0, 4.0)] * 2 + [(1.0, 2.0)]


@pytest.mark.parametrize('kind', KINDS)
def test_raw_values_become_tensions_again_by_gain_and_bias(kind, tmp_path):
    """The components that carry no tension are 0."""
    true, gains, biases = (1.25, 4.5), (0.5, -2.0), (0.25, 8.0)
    with (
        audience(kind) as heard,
        driver(
            *(f'file:={write(tmp_path, true)}', f'tension_source:={kind}', 'count:=1'),
            *('cable_names:=[winch_1, winch_2]', 'wrench_component:=x'),
            *(f'cable_l.gain:={gains[0]}', f'cable_l.bias:={biases[0]}'),
            *(f'cable_s.gain:={gains[1]}', f'cable_s.bias:={biases[1]}'),
        ),
    ):
        wait_for('the message', lambda: all(heard.messages.values()))
    first = {topic: messages[0] for topic, messages in heard.messages.items()}
    if kind == 'array':
        raw = first['tensions'].data
    elif kind == 'joint_state':
        assert first['tensions'].name == ['winch_1', 'winch_2']
        assert not first['tensions'].position
        raw = first['tensions'].effort
    else:
        assert nanoseconds(first['tension_l']) == nanoseconds(first['tension_s'])
        forces = [first[topic].wrench.force for topic in TOPICS[kind]]
        assert {(force.y, force.z) for force in forces} == {(0.0, 0.0)}
        raw = [force.x for force in forces]
    read = [g * value + b for g, value, b in zip(gains, raw, biases, strict=True)]
    assert tuple(read) == true


ARM_FILE = installed_config('arm.yaml')
ARM_CABLES = ('l_mid', 's_mid', 'l_tip', 's_tip')


def test_an_arms_recording_is_played_with_all_cables_in_one_message_by_name():
    rows = load_arm_recording(installed_config('arm_tensions.csv'), load_arm(ARM_FILE)).tensions()
    scale = ('cables.s_tip.gain:=0.5', 'cables.s_tip.bias:=0.25')
    with (
        audience('joint_state') as heard,
        driver(f'arm_file:={ARM_FILE}', 'rate:=500', 'count:=20', *scale),
    ):
        wait_for('twenty messages', lambda: heard.count() == 20)
    played = heard.messages['tensions']
    assert {tuple(message.name) for message in played} == {ARM_CABLES}
    for row, message in zip(rows, played, strict=False):
        *others, s_tip = message.effort
        assert [*others, 0.5 * s_tip + 0.25] == pytest.approx(row)


def test_an_arm_is_played_as_an_array_in_the_order_of_its_file(tmp_path):
    path = tmp_path / 'arm.csv'
    path.write_text('s_tip;l_tip;s_mid;l_mid\n4,5;3;2;1\n')
    with (
        audience() as heard,
        driver(f'arm_file:={ARM_FILE}', f'file:={path}', 'tension_source:=array', 'count:=1'),
    ):
        wait_for('the message', lambda: heard.count() == 1)
    assert list(heard.messages['tensions'][0].data) == [1.0, 2.0, 3.0, 4.5]


@pytest.mark.parametrize(
    ('parameters', 'named'),
    [
        ((f'arm_file:={ARM_FILE}', 'file:=DEMO'), 'there is no column l_mid'),
        ((f'arm_file:={ARM_FILE}', 'tension_source:=wrench_pair'), 'tension_source'),
        (('arm_file:=none.yaml',), 'arm_file: none.yaml: it cannot be read'),
    ],
)
def test_what_is_no_recording_of_the_arm_is_refused_in_one_line(parameters, named):
    demo = str(installed_config('demo_tensions.csv'))
    with driver(*(one.replace('DEMO', demo) for one in parameters)) as program:
        assert program.process.wait(60.0) == 1
        assert named in program.output()


@pytest.mark.parametrize('kind', KINDS)
def test_every_fault_arrives_where_the_seed_puts_it_and_the_books_balance(kind, tmp_path):
    """The rows differ, so that each message says which of them it is, by a cable that is sound."""
    settings = FaultSettings(
        seed=7,
        nan_burst_length=3,
        slack_length=5,
        **{
            f'{fault.value}_probability': 0.03
            for fault in Fault
            if fault is not Fault.NONE and not (kind == 'array' and fault in STAMP_FAULTS)
        },
    )
    path = write(tmp_path, *((FIRST[0] + k * STEP, FIRST[1] + k * STEP) for k in range(COUNT)))
    with (
        audience(kind) as heard,
        driver(
            *(f'file:={path}', 'loop:=false', f'tension_source:={kind}', 'rate:=2000'),
            *(f'{name}:={value}' for name, value in dataclasses.asdict(settings).items()),
        ) as program,
    ):
        wait_for('the books', lambda: 'Sent: ' in program.output())
        sent = books(program)
        wait_for('every message', lambda: heard.count() >= sent['messages'])
    maker = FaultMaker(settings)
    expected = [maker.reading(FIRST, now=k).fault for k in range(COUNT)]
    assert faults_seen(kind, heard.messages) == expected
    assert set(expected) >= {fault for fault in Fault if settings.probability(fault) > 0.0}
    assert heard.count() == sent['messages']
    assert sent['readings'] == COUNT
    assert {fault: sent[fault.value] for fault in Fault} == {
        fault: expected.count(fault) for fault in Fault
    }


COUNT, FIRST, STEP = 2000, (1.0, 11.0), 2.0**-12


def faults_seen(kind, messages):
    """The fault of each row, from the messages alone."""
    pairs = {
        'array': pairs_of_arrays,
        'joint_state': pairs_of_joint_states,
        'wrench_pair': pairs_of_wrenches,
    }[kind](messages)
    faults, newest = [], None
    for k in range(COUNT):
        values, stamp = pairs.get(k, ({}, None))
        fault = fault_seen(values, stamp, newest)
        if fault in (Fault.NONE, Fault.SLACK):
            newest = stamp
        faults.append(fault)
    return faults


def fault_seen(values, stamp, newest):
    if not values:
        return Fault.DROPOUT
    if len(values) == 1:
        return Fault.WRONG_LENGTH
    for value, fault in ((0.0, Fault.SLACK), (IMPLAUSIBLE_TENSION, Fault.IMPLAUSIBLE)):
        if value in values.values():
            return fault
    if any(map(math.isnan, values.values())):
        return Fault.NAN_BURST
    if newest is not None and stamp == newest:
        return Fault.REPEATED_STAMP
    if newest is not None and stamp < newest:
        return Fault.OUT_OF_ORDER
    return Fault.NONE


def row_and_cable(value):
    """Which row and cable a sound value is of; None of a spoilt one."""
    for cable in (0, 1):
        k = (value - FIRST[cable]) / STEP
        if k in range(COUNT):
            return int(k), cable
    return None


def pairs_of_arrays(messages):
    return {row(message.data): (by_cable(message.data), None) for message in messages['tensions']}


def pairs_of_joint_states(messages):
    """A name without an effort has no value, nor has a cable that is not named."""
    pairs = {}
    for message in messages['tensions']:
        efforts = dict(zip(message.name, message.effort, strict=False))
        assert set(efforts) <= {'cable_l', 'cable_s'}
        values = {cable: efforts[name] for cable, name in enumerate(CABLES) if name in efforts}
        pairs[row(values.values())] = (values, nanoseconds(message))
    return pairs


def pairs_of_wrenches(messages):
    """A spoilt value belongs to the first sound one of the other cable that has its stamp."""
    pairs = {}
    rows_by_stamp = {}
    for cable, topic in enumerate(('tension_l', 'tension_s')):
        for message in messages[topic]:
            value, stamp = message.wrench.force.z, nanoseconds(message)
            if row_and_cable(value):
                k, _ = row_and_cable(value)
                pairs.setdefault(k, ({}, stamp))[0][cable] = value
                rows_by_stamp.setdefault((1 - cable, stamp), k)
    for cable, topic in enumerate(('tension_l', 'tension_s')):
        for message in messages[topic]:
            value, stamp = message.wrench.force.z, nanoseconds(message)
            if not row_and_cable(value):
                pairs[rows_by_stamp[cable, stamp]][0][cable] = value
    return pairs


def row(values):
    """The row that a message is of."""
    (k,) = {row_and_cable(value)[0] for value in values if row_and_cable(value)}
    return k


def by_cable(values):
    """Values by cable; a single one is of the cable that it says."""
    if len(values) == 1:
        return {row_and_cable(values[0])[1]: values[0]}
    return dict(enumerate(values))


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('arguments', [('rate:=20000',), ('count:=3',)], ids=['storm', 'ended'])
def test_a_signal_finds_the_books_said_once_and_exits_with_0(number, arguments):
    with audience() as heard, driver(*arguments) as program:
        wait_for('some messages', lambda: heard.count() >= 3)
        assert program.end(number) == 0
        assert books(program)['messages'] >= heard.count()
        assert 'Traceback' not in program.output()
        assert 'Failed' not in program.output()


def test_it_warns_of_parameters_that_nobody_has():
    with driver('dropout_probabilty:=0.5', 'joint_name:=elbow') as program:
        ignored = 'Parameters that this node does not have, ignored: '
        wait_for('the warning', lambda: ignored in program.output())
        (line,) = [line for line in program.output().splitlines() if ignored in line]
    assert line.endswith(f'{ignored}dropout_probabilty')


@pytest.mark.parametrize(
    ('argument', 'named'),
    [
        ('file:=/missing.csv', '/missing.csv: it cannot be read'),
        ('rate:=0.0', 'rate is 0.0, allowed is 0.01 to 20000 Hz'),
        ('rate:=20001', 'rate is 20001.0, allowed is 0.01 to 20000 Hz'),
        ('rate:=fast', "rate is 'fast', which is not a number"),
        ('count:=-1', 'count is -1, allowed is 0 to'),
        ('count:=1.5', 'count is 1.5, which is not an integer'),
        ('noise_stddev:=.nan', 'noise_stddev is nan, allowed is 0 to 1000 N'),
        ('dropout_probability:=1.5', 'dropout_probability is 1.5, allowed is 0 to 1'),
        ('slack_length:=0', 'slack_length is 0, allowed is 1 to 1000000'),
        ('tension_source:=can', "tension_source is 'can', allowed is array or joint_state"),
        ('wrench_component:=w', "wrench_component is 'w', allowed is z or x or y or norm"),
        ('cable_names:=[a]', "cable_names is ['a'], two different names are needed"),
        ('cable_names:=[a, a]', "cable_names is ['a', 'a'], two different names"),
        (
            'cable_s.gain:=0',
            '1000000 N per unit, not 0',
        ),
        ('cable_l.bias:=.inf', 'cable_l.bias is inf, allowed is'),
        ('repeated_stamp_probability:=0.1', 'but tension_source is array, of which no message'),
    ],
)
def test_what_it_cannot_play_is_one_line_and_exit_code_1(argument, named):
    with driver(argument) as program:
        assert program.wait() == 1
        (line,) = program.output().splitlines()
        assert line.startswith('pulley_driver cannot start: ')
        assert named in line


@pytest.mark.parametrize(
    ('more', 'titles'),
    [((), 'tension_l, tension_s'), ((f'arm_file:={ARM_FILE}',), ', '.join(ARM_CABLES))],
)
def test_where_an_error_names_options_it_says_what_a_driver_needs(tmp_path, more, titles):
    path = tmp_path / 'run.csv'
    path.write_text('time,Fz1,Fz2\n0,1,1.5\n')
    with driver(f'file:={path}', *more) as program:
        assert program.wait() == 1
        (line,) = program.output().splitlines()
        assert 'has no such options' in line
        assert f'a table with the columns {titles} in N' in line
