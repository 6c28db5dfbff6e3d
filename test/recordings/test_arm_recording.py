"""Recordings of an arm: tables and bags with all its cables, and what a replay makes of them."""

import bags
import numpy as np
import pytest
from bags import ORIGIN, write_bag
from make_docs import ROOT
from programs import assert_refused, run

from tendon_statics import Arm, ArmTracker, Cable, load_arm
from tendon_statics.estimation.arm_settings import ArmSettings
from tendon_statics.recordings.arm_recording import ArmRecording
from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.hints import arm_hints
from tendon_statics.recordings.reading.load import load_arm_recording
from tendon_statics.recordings.reading.table_options import TableOptions
from tendon_statics.recordings.reading.topics import BagTopics
from tendon_statics.recordings.reading.units import of_arm
from tendon_statics.recordings.replay.arm_estimates import replay_arm

FILE = ROOT / 'config/arm.yaml'
TABLE = ROOT / 'config/arm_tensions.csv'
ARM = load_arm(FILE)
NAMES = ARM.cable_names
JOINTS = tuple(f'arm_joint_{number}' for number in range(1, 6))
SETTINGS = ArmSettings(ARM, JOINTS)


def efforts(index):
    return [1.0, 1.0, 1.0, 1.0 + 0.1 * index]


def session(count=12, *, reverse=True):
    """All cables by name every 10 ms, in another order than the arm's; two joints' encoders."""
    names = NAMES[::-1] if reverse else NAMES
    for index in range(count):
        time = 0.01 * index
        effort = efforts(index)[:: -1 if reverse else 1]
        yield '/tensions', time, bags.joint_state(['motor', *names], [7.0, *effort], time=time)
        position = [0.01 * index, 0.5]
        measured = bags.joint_state(['arm_joint_5', 'arm_joint_1'], position=position, time=time)
        yield '/measured_joint_states', time + 0.001, measured


@pytest.mark.parametrize('plugin', ['MCAP', 'SQLITE3'])
def test_a_bag_has_all_cables_in_one_joint_state_and_measured_angles(tmp_path, plugin):
    recording = load_arm_recording(write_bag(tmp_path / 'bag', session(), plugin), ARM)
    assert list(recording.cable_tensions) == list(NAMES)
    assert recording.tensions() == [tuple(efforts(index)) for index in range(12)]
    assert recording.time == pytest.approx(0.01 * np.arange(12))
    assert recording.time_origin == ORIGIN
    assert list(recording.bend_angles) == [1, 5]
    assert recording.bend_angles[5] == pytest.approx(0.01 * np.arange(12))
    assert recording.clock == 'stamp'


def test_messages_with_a_part_of_the_cables_are_joined(tmp_path):
    messages = []
    for index in range(5):
        time, effort = 0.01 * index, efforts(index)
        for names, values, late in ((NAMES[:2], effort[:2], 0.0), (NAMES[2:], effort[2:], 0.001)):
            if (index, late) != (2, 0.001):  # one part is lost
                message = bags.joint_state(names, values, time=time + late)
                messages.append(('/tensions', time + late, message))
    path = write_bag(tmp_path / 'bag', messages)
    recording = load_arm_recording(path, ARM, BagTopics(tension_skew=0.004))
    assert recording.faults == ['', '', 'unpaired', '', '']
    assert recording.cable_tensions['s_tip'][3] == pytest.approx(1.3)
    assert np.isnan(recording.cable_tensions['s_tip'][2])


def test_an_array_stands_in_the_order_of_the_arm(tmp_path):
    messages = [('/drives', 0.1, bags.array(1.0, 2.0, 3.0, 4.0))]
    messages += [('/drives', 0.2, bags.array(1.0, 2.0))]
    path = write_bag(tmp_path / 'bag', messages)
    recording = load_arm_recording(path, ARM, BagTopics(tensions=('drives',)))
    assert recording.tensions()[0] == (1.0, 2.0, 3.0, 4.0)
    assert recording.faults == ['', 'wrong length']
    with pytest.raises(RecordingError, match='there is no topic /tensions; there are: /drives'):
        load_arm_recording(path, ARM)


def test_a_cable_that_no_message_names_is_said(tmp_path):
    messages = [('/tensions', 0.1, bags.joint_state(NAMES[:3], [1.0, 1.0, 1.0], time=0.1))]
    path = write_bag(tmp_path / 'bag', messages)
    with pytest.raises(RecordingError, match='effort of l_mid, s_mid, l_tip and s_tip; there is'):
        load_arm_recording(path, ARM)


def test_a_replay_of_a_bag_is_what_the_tracker_says_row_by_row(tmp_path):
    path = write_bag(tmp_path / 'bag', session(20))
    replayed = replay_arm(SETTINGS, load_arm_recording(path, ARM))
    tracker = ArmTracker(ARM)
    for place in range(20):
        state = tracker.update(dict(zip(NAMES, efforts(place), strict=True)))
        for joint, of in zip(state.joints, replayed.joints, strict=True):
            assert of.bend_angle[place] == joint.bend_angle
            assert of.regime[place] == joint.regime.value
            assert of.slip_margin[place] == joint.slip_margin
        assert [of[place] for of in replayed.tip] == pytest.approx(state.tip)
        deviation = state.tip_stddev(SETTINGS.tension_stddev)
        assert [of[place] for of in replayed.tip_stddev] == pytest.approx(deviation, abs=1e-15)
    error = replayed.joints[4].error
    assert error == pytest.approx(replayed.joints[4].bend_angle - 0.01 * np.arange(20))
    assert replayed.joints[1].error is None


def test_the_verb_reads_the_bag_and_its_options(tmp_path):
    path = write_bag(tmp_path / 'bag', session())
    done = run('arm', 'replay', FILE, path)
    assert done.returncode == 0, done.stderr
    assert '12 samples' in done.stdout
    names = ('--joint-names', 'a,b,c,d,e')
    assert 'measured' not in run('arm', 'replay', FILE, path, *names).stdout
    assert_refused(run('arm', 'replay', FILE, path, '--tensions-topic', 'x'), 'no topic /x')


def test_a_replay_as_a_table_is_read_again_as_what_was_recorded(tmp_path):
    path, output = write_bag(tmp_path / 'bag', session()), tmp_path / 'replay.parquet'
    assert run('arm', 'replay', FILE, path, '--output', output).returncode == 0
    again, first = load_arm_recording(output, ARM), load_arm_recording(path, ARM)
    assert again.tensions() == first.tensions()
    assert again.bend_angles[5] == pytest.approx(first.bend_angles[5])
    assert list(again.bend_angles) == [1, 5]


def test_units_and_titles_of_an_arms_table_are_said_by_its_quantities(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text('Fz1;s_mid;l_tip;s_tip;Enc\n1000;1000;1000;1500;5,5\n')
    columns, units = {'l_mid': 'Fz1', 'bend_angle_5': 'Enc'}, {'tension': 'mN'}
    options = TableOptions(
        columns=columns, units=units | {'bend_angle': 'deg'}, rate=10.0, quantities=of_arm(ARM)
    )
    recording = load_arm_recording(path, ARM, table=options)
    assert recording.tensions() == [(1.0, 1.0, 1.0, 1.5)]
    assert recording.bend_angles[5] == pytest.approx(np.radians([5.5]))
    assert recording.in_newtons
    assert recording.time.tolist() == [0.0]


def test_a_filtered_replay_has_intervals_of_joints_and_tip():
    arm = Arm(ARM.units[3:], [Cable('l', 'l', 2), Cable('s', 's', 2)])
    ones, pulled = np.ones(8), 1.0 + 0.15 * np.arange(8)
    recording = ArmRecording({'l': ones, 's': pulled}, {2: 0.0 * ones}, time=0.02 * np.arange(8))
    settings = ArmSettings(arm, ('a', 'b'), tension_stddev=0.02)
    replayed = replay_arm(settings, recording, 'filtering')
    for joint in replayed.joints:
        low, high = joint.interval
        assert (low <= joint.bend_angle).all()
        assert (joint.bend_angle <= high).all()
        assert np.sum([*joint.regime_probabilities.values()], axis=0) == pytest.approx(ones)
    (low, high), *_ = replayed.tip_interval
    assert (low <= replayed.tip[0]).all()
    assert (replayed.tip[0] <= high).all()
    names = replayed.columns()
    assert {'tip_x_low', 'estimated_bend_angle_high_2', 'probability_held_1'} <= names.keys()
    untimed = ArmRecording({'l': ones, 's': pulled})
    with pytest.raises(RecordingError, match='filtering needs the time'):
        replay_arm(settings, untimed, 'filtering')


def test_filtering_asks_for_the_noise_of_the_load_cells():
    asked = ('--estimation', 'filtering')
    assert_refused(run('arm', 'replay', FILE, TABLE, *asked), 'give --tension-stddev')


def test_an_arms_recording_is_of_one_length():
    with pytest.raises(RecordingError, match='tensions of 2 samples, and 3 values of s'):
        ArmRecording({'l': [1.0, 1.0], 's': [1.0, 1.0, 1.0]})


def test_what_looks_wrong_with_an_arms_recording_is_hinted_at():
    ones = np.ones(4)
    pulled = ArmRecording(dict.fromkeys(NAMES, 5000.0 * ones), {2: 40.0 * ones})
    angle, tensions = arm_hints(pulled, SETTINGS)
    assert '--units bend_angle_2=deg' in angle
    assert 'cables.l_mid.gain' in tensions
    assert 'weight of the arm' in tensions
    assert 'the parameter file has to have' in tensions
    assert arm_hints(ArmRecording(dict.fromkeys(NAMES, ones)), SETTINGS) == []


def test_a_recording_whose_time_goes_back_is_not_followed():
    ones = np.ones(2)
    recording = ArmRecording(dict.fromkeys(NAMES, ones), time=[1.0, 0.0])
    with pytest.raises(RecordingError, match='time goes back'):
        replay_arm(SETTINGS, recording)
