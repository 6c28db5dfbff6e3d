"""Node and replay say the same of the same readings, with the same unit's file."""

import math
import random
from collections import Counter

import bags
import numpy as np
import pytest
from builtin_interfaces.msg import Time
from programs import run
from ros_programs import wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from tendon_statics import BagTopics, default_design_path
from tendon_statics.node.inputs.sources import JointStateSource
from tendon_statics.recordings.reading.load import load_recording

GAINS = {
    'cable_l.gain': 0.001,
    'cable_s.gain': 0.002,
    'cable_l.bias': -0.1,
    'cable_s.max_tension': 5.0,
}
READINGS = [
    *((1100.0, 1000.0), (1100.0, 750.0), (1100.0, 1400.0), (100.0, 1000.0), (2100.0, 300.0)),
    *((1100.0, -50.0), (1100.0, 2501.0), (math.nan, 500.0), (50.0, 9000.0), (150.0, 20.0)),
    *((math.inf, -1.0), (-9e9, 500.0), (3100.0, 2000.0)),
]


def test_of_the_same_readings_node_and_replay_say_the_same(listener, tmp_path):
    data, unit, output = (tmp_path / name for name in ('run.csv', 'unit.yaml', 'out.csv'))
    rows = '\n'.join(f'{at_l},{at_s}' for at_l, at_s in READINGS)
    data.write_text(f'tension_l,tension_s\n{rows}\n')
    lines = ''.join(f'    {name}: {value}\n' for name, value in GAINS.items())
    design = default_design_path().read_text()
    unit.write_text(design.replace('    design:', f'{lines}    design:'))
    done = run('replay', data, '--design', unit, '--output', output)
    assert done.returncode == 0, done.stderr
    rows = [line.split(',') for line in output.read_text().splitlines()]
    replayed = dict(zip(rows[0], zip(*rows[1:], strict=True), strict=True))

    with listener.estimator('--params-file', str(default_design_path())):
        changed = {name.replace('.', '__'): value for name, value in GAINS.items()}
        assert listener.set_estimator_parameters(**changed).successful
        reasons = [word for word in set(replayed['validity']) if word != 'valid']
        wait_for('a report', lambda: listener.diagnostics)
        regimes = [listener.answer(*pair) for pair in READINGS]
        wait_for(
            'all drops in a report',
            lambda: (
                sum(listener.count(f'dropped: {word}') for word in reasons)
                == regimes.count('invalid')
            ),
        )
        dropped = {word: listener.count(f'dropped: {word}') for word in reasons}
        valid = [regime != 'invalid' for regime in regimes]
        wait_for('all estimates', lambda: len(listener.estimates) == sum(valid))
        estimates = list(listener.estimates)

    assert regimes == list(replayed['regime'])
    assert dropped == {word: replayed['validity'].count(word) for word in reasons}
    assert set(reasons) == {'negative', 'implausible', 'not finite', 'below the weight'}
    again = load_recording(output)
    for name in ('tension_l', 'tension_s'):
        of_node = [getattr(estimate, name) for estimate in estimates]
        np.testing.assert_array_equal(of_node, getattr(again, name)[valid])
    angles = [float(text or 'nan') for text in np.array(replayed['estimated_bend_angle'])[valid]]
    of_node = [estimate.bend_angle for estimate in estimates]
    np.testing.assert_allclose(of_node, angles, rtol=0.0, atol=1e-12)


BOTH = ['cable_l', 'cable_s']
KINDS = [
    *((BOTH, [1.0, 2.0]), (BOTH[:1], [1.0]), (BOTH[1:], [2.0]), (['wheel'], [1.0])),
    *(([*BOTH, 'wheel'], [1.0, 2.0]), (['wheel', *BOTH[::-1]], [9.0, 2.0, 1.0])),
]
"""Names and efforts of joint states"""


@pytest.mark.parametrize('skew', [None, 0.02])
@pytest.mark.parametrize('seed', range(6))
def test_of_the_same_messages_node_and_replay_make_the_same_pairs(seed, skew, tmp_path):
    """Of several publishers, with equal stamps, one cable a message, wrong lengths and others'."""
    chosen, stamp, sent = random.Random(seed), 1, []
    for number in range(60):
        stamp += chosen.choice([0, 0, 2, 4, 6, 10])
        names, efforts = chosen.choice(KINDS)
        sent.append((stamp, names, [effort + 0.01 * number for effort in efforts]))
    recording, pairs, drops = read_and_heard(
        [(0.001 * number, 0.001 * at, *of) for number, (at, *of) in enumerate(sent)],
        tmp_path,
        skew,
    )
    found = list(zip(recording.tensions(), recording.known_faults, strict=True))
    assert [pair for pair, fault in found if not fault] == pairs
    assert Counter(fault for _, fault in found if fault) == Counter(drops)
    assert {'repeated stamp', 'unpaired', 'wrong length'} >= set(drops) >= {'repeated stamp'}


def read_and_heard(sent, folder, skew=None):
    """A bag's recording, and the pairs and drops of the node, of joint states.

    Each with its arrival and stamp in s, names and efforts.
    """
    messages = [
        ('/tensions', arrival, bags.joint_state(names, effort=efforts, time=stamp))
        for arrival, stamp, names, efforts in sent
    ]
    recording = load_recording(
        bags.write_bag(folder / 'bag', messages), BagTopics(tension_skew=skew)
    )
    pairs, drops = [], []
    source = JointStateSource(
        lambda reading: pairs.append(reading.values),
        lambda reason, _: drops.append(reason.value),
        ('cable_l', 'cable_s'),
        lambda: skew or 0.005,  # as the parameter has it by default
    )
    for arrival, stamp, names, efforts in sent:
        seconds, rest = divmod(bags.ORIGIN + round(1e9 * stamp), 10**9)
        header = Header(stamp=Time(sec=seconds, nanosec=rest))
        message = JointState(header=header, name=names, effort=efforts)
        if not source.is_foreign(message):
            source.inputs['tensions'][1](message, bags.ORIGIN + round(1e9 * arrival))
    source.forget()
    return recording, pairs, drops


def one_cable_a_message(arrivals):
    """Both cables at 100 Hz with equal stamps.

    Of each: the messages by cable, when each arrives in s, and what is added to its tension.
    """
    sent = [
        (arrival, 0.01 * number, BOTH[cable : cable + 1], [1.0 + cable + 0.01 * number + more])
        for number, of in enumerate(arrivals)
        for cable, arrival, more in of
    ]
    return sorted(sent, key=lambda message: message[0])


def test_publishers_of_one_cable_each_that_send_many_at_once_lose_nothing(tmp_path):
    """As a bus or the network delivers them: ten of one, and then ten of the other."""
    late = [0.1 * (number // 10) + 0.0001 * number for number in range(60)]
    sent = one_cable_a_message([[(0, at, 0.0), (1, at + 0.03, 0.0)] for at in late])
    recording, pairs, drops = read_and_heard(sent, tmp_path)
    assert (recording.clock, recording.disorder, drops) == ('stamp', '', [])
    assert recording.tensions() == pairs
    assert pairs == [(1.0 + 0.01 * number, 2.0 + 0.01 * number) for number in range(60)]
    assert recording.time == pytest.approx([0.01 * number for number in range(60)])


def test_of_two_that_send_each_cable_with_equal_stamps_the_first_counts(tmp_path):
    twice = [(0, 0.0, 0.0), (1, 0.001, 0.0), (0, 0.002, 0.5), (1, 0.003, 0.5)]
    sent = one_cable_a_message(
        [[(cable, 0.01 * number + at, more) for cable, at, more in twice] for number in range(20)]
    )
    recording, pairs, drops = read_and_heard(sent, tmp_path)
    believed = [not fault for fault in recording.known_faults]
    assert [pair for pair, of in zip(recording.tensions(), believed, strict=True) if of] == pairs
    assert len(pairs) == 20
    assert Counter(filter(None, recording.known_faults)) == Counter(drops)
    assert set(drops) == {'repeated stamp'}
    assert (
        'of cable_l are that of the message before, which counts (--clock log'
        in recording.notes[0]
    )
