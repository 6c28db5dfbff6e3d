"""What acts on a unit beside its cables, in recordings: read, replayed, calibrated with."""

import dataclasses
import math

import bags
import numpy as np
import pytest
from bags import write_bag
from designs import PRELIMINARY
from law_sessions import SessionPlan, session_of, unit_of
from programs import assert_refused, run

from tendon_statics import (
    Load,
    Recording,
    load_design,
    load_design_uncertainty,
    load_recording,
    save_design,
    solve,
)
from tendon_statics.physics import StickSlipTracker
from tendon_statics.recordings.reading.topics import BagTopics
from tendon_statics.recordings.replay.bag_output import write_bag as write_replay
from tendon_statics.recordings.replay.estimates import replay
from tendon_statics.recordings.replay.table_output import write_table

TEN = math.radians(10.0)


def about_y(angle):
    """The orientation of a base that is tilted towards cable s, which is along X."""
    return bags.quaternion(0.0, math.sin(0.5 * angle), 0.0, math.cos(0.5 * angle))


def about_x(angle):
    return bags.quaternion(math.sin(0.5 * angle), 0.0, 0.0, math.cos(0.5 * angle))


def bag(tmp_path, *messages):
    tensions = [('/tensions', 0.1 * index, bags.array(1.0, 2.0)) for index in range(4)]
    return write_bag(tmp_path / 'bag', sorted([*tensions, *messages], key=lambda one: one[1]))


def test_a_column_of_tilts_gives_the_angle_of_the_tilted_unit(tmp_path):
    path = tmp_path / 'data.csv'
    path.write_text('tension_l,tension_s,base_tilt [deg]\n1,2,0\n1,2,10\n1,2,\n')
    recording = load_recording(path)
    assert recording.base_tilt == pytest.approx([0.0, TEN, math.nan], nan_ok=True)
    found = replay(PRELIMINARY, recording)
    angles = np.degrees(found.bend_angle)
    assert angles == pytest.approx([17.14, 7.14, 7.14], abs=1e-3)  # as it was before
    done = run('replay', path, '--output', tmp_path / 'out.csv')
    assert done.returncode == 0, done.stderr
    again = load_recording(tmp_path / 'out.csv')
    assert again.base_tilt == pytest.approx(recording.base_tilt, nan_ok=True)


@pytest.mark.parametrize('estimation', ['equilibrium', 'tracking'])
def test_a_replay_solves_every_sample_under_its_own_load(estimation):
    rng = np.random.default_rng(1)
    count = 40
    recording = Recording(
        rng.uniform(0.8, 2.4, count),
        rng.uniform(0.8, 2.4, count),
        base_tilt=rng.uniform(-0.5, 0.5, count),
        base_roll=rng.uniform(-0.3, 0.3, count),
        tip_force_x=rng.normal(size=count) * 0.02,
        tip_force_z=rng.normal(size=count) * 0.02,
    )
    found = replay(PRELIMINARY, recording, estimation, load=Load(tip_distance=0.03))
    tracker = StickSlipTracker(PRELIMINARY)
    for index in range(count):
        roll, tilt = recording.base_roll[index], recording.base_tilt[index]
        share = math.cos(roll)
        load = Load(
            (share * math.sin(tilt), -math.sin(roll), -share * math.cos(tilt)),
            (float(recording.tip_force_x[index]), float(recording.tip_force_z[index])),
            0.03,
        )
        pair = recording.tensions()[index]
        if estimation == 'tracking':
            answer = tracker.update(*pair, load)
        else:
            answer = solve(PRELIMINARY, *pair, load)
        assert found.regime[index] == answer.regime.value
        if answer.bend_angle is not None:
            assert found.bend_angle[index] == pytest.approx(answer.bend_angle, abs=1e-9)


@pytest.mark.parametrize(
    'message',
    [
        lambda time: bags.pose(about_y(TEN), time),
        lambda time: bags.imu(time, about_y(TEN)),
        lambda time: bags.imu(time, None, (-9.81 * math.sin(TEN), 0.0, 9.81 * math.cos(TEN))),
        lambda _time: bags.number(TEN),
    ],
    ids=['pose', 'imu', 'acceleration', 'number'],
)
def test_a_topic_tells_the_tilt_of_the_base(tmp_path, message):
    """An accelerometer at rest measures up: against X where the base is tilted to X."""
    path = bag(tmp_path, *(('/holder', time, message(time)) for time in (0.0, 0.1, 0.2, 0.3)))
    recording = load_recording(path, BagTopics(base='/holder'))
    assert recording.base_tilt == pytest.approx([TEN] * 4)
    assert np.degrees(replay(PRELIMINARY, recording).bend_angle) == pytest.approx(7.14, abs=1e-3)


def test_a_roll_takes_gravity_out_of_the_plane(tmp_path):
    path = bag(tmp_path, ('/base_pose', 0.0, bags.pose(about_x(math.radians(60.0)), 0.0)))
    recording = load_recording(path, BagTopics(gravity_source='pose'))
    load = recording.loads(Load())[0].on(PRELIMINARY)
    assert load.size == pytest.approx(0.5 * PRELIMINARY.weight)
    assert load.force_x == pytest.approx(0.0, abs=1e-15)


def test_an_orientation_that_is_none_is_left_out_and_said(tmp_path):
    nothing = bags.quaternion(math.nan, 0.0, 0.0, 1.0)
    path = bag(
        tmp_path,
        ('/base_pose', 0.1, bags.pose(about_y(TEN), 0.1)),
        ('/base_pose', 0.2, bags.pose(nothing, 0.2)),
        ('/base_pose', 0.3, bags.pose(bags.quaternion(0.0, 0.0, 0.0, 2.0), 0.3)),
    )
    recording = load_recording(path, BagTopics(base='base_pose'))
    assert recording.base_tilt == pytest.approx([TEN] * 4)
    assert any('2 of 3 messages on /base_pose are left out' in note for note in recording.notes)


def test_the_file_of_the_unit_says_where_gravity_and_tip_force_come_from(tmp_path):
    """An IMU on its side, as ``imu_mounting`` has it, and a wrench at the tip."""
    unit = tmp_path / 'unit.yaml'
    parameters = {
        'gravity_source': 'imu',
        'imu_mounting': [0.0, math.pi / 2, 0.0],
        'tip_wrench': True,
        'tip_distance': 0.03,
    }
    save_design(unit, PRELIMINARY, parameters=parameters)
    # Its Z is along the joint's X, its X along the joint's -Z.
    acceleration = (-9.81 * math.cos(TEN), 0.0, -9.81 * math.sin(TEN))
    path = bag(
        tmp_path,
        ('/imu', 0.1, bags.imu(0.1, None, acceleration)),
        ('/tip_wrench', 0.1, bags.wrench(0.01, 5.0, -0.02, 0.1)),
    )
    done = run('replay', path, '--design', unit, '--output', tmp_path / 'out.csv')
    assert done.returncode == 0, done.stderr
    recording = load_recording(tmp_path / 'out.csv')
    assert recording.base_tilt == pytest.approx([TEN] * 4)
    assert recording.tip_force_x == pytest.approx([0.01] * 4)
    load = Load.tilted(TEN, (0.01, -0.02), 0.03)
    angle = solve(PRELIMINARY, 1.0, 2.0, load).bend_angle
    assert replay(PRELIMINARY, recording, load=Load(tip_distance=0.03)).bend_angle == (
        pytest.approx([angle] * 4, abs=1e-7)
    )


@pytest.mark.parametrize('ending', ['csv', 'mcap'])
def test_what_a_replay_writes_of_the_load_is_read_again(tmp_path, ending):
    recording = Recording(
        [1.0, 1.0],
        [2.0, 2.0],
        time=[0.0, 0.1],
        base_tilt=[0.1, 0.2],
        base_roll=[0.0, 0.3],
        tip_force_x=[0.01, 0.02],
        tip_force_z=[-0.1, -0.2],
    )
    path = tmp_path / f'out.{ending}'
    found = replay(PRELIMINARY, recording)
    if ending == 'mcap':
        write_replay(path, found)
    else:
        write_table(path, found.columns())
    again = load_recording(path)
    for name in ('base_tilt', 'base_roll', 'tip_force_x', 'tip_force_z'):
        assert getattr(again, name) == pytest.approx(getattr(recording, name))


@pytest.mark.parametrize(
    ('titles', 'options', 'named'),
    [
        ('tip_force_x', (), 'say where it acts'),
        ('tip_force_x', ('--tip-force', '0', '1', '--tip-distance', '1'), 'has the force at the'),
        ('base_tilt', ('--base-tilt-deg', '10'), 'has the tilt of the base in it'),
        ('base_tilt_deg', (), 'write base_tilt'),
    ],
)
def test_a_load_that_is_said_twice_or_by_half_is_refused(tmp_path, titles, options, named):
    path = tmp_path / 'data.csv'
    path.write_text(f'tension_l,tension_s,{titles}\n1,2,0\n')
    assert_refused(run('replay', path, *options), named)


def table_of(recording, path):
    names = ['tension_l', 'tension_s', 'bend_angle', 'pressure', 'base_tilt']
    there = [name for name in names if getattr(recording, name) is not None]
    rows = zip(*(getattr(recording, name).tolist() for name in there), strict=True)
    lines = [','.join(there), *(','.join(map(repr, row)) for row in rows)]
    path.write_text('\n'.join(lines) + '\n')
    return path


def test_calibrate_takes_the_tilts_and_writes_cells_and_covariance(tmp_path):
    truth = unit_of('elastic_seat', cable_offset=PRELIMINARY.cable_offset)
    plan = SessionPlan(slips=40, tilts=(0.0, 1.0, -1.0))
    recording, _ = session_of(truth, plan, np.random.default_rng(5))
    biased = Recording(
        (recording.tension_l - 0.05) / 0.002,  # as a load cell reads it
        recording.tension_s,
        recording.bend_angle,
        base_tilt=recording.base_tilt,
    )
    start = tmp_path / 'start.yaml'
    save_design(start, PRELIMINARY, parameters={'cable_l.gain': 0.002, 'cable_l.bias': 0.01})
    output = tmp_path / 'fitted.yaml'
    done = run(
        *('calibrate', table_of(biased, tmp_path / 'data.csv'), '--design', start),
        *('--contact-law', 'elastic_seat', '--fit', 'mass,friction_coefficient,bias_l'),
        *('--output', output),
    )
    assert (done.returncode, done.stderr) == (0, '')
    assert 'load cells    cable_l.bias: ' in done.stdout
    fitted = load_design(output)
    assert fitted.contact_law == 'elastic_seat'
    assert fitted.friction_coefficient == pytest.approx(truth.friction_coefficient, rel=0.1)
    text = output.read_text()
    (line,) = [line for line in text.splitlines() if line.strip().startswith('cable_l.bias:')]
    assert float(line.split(':')[1]) == pytest.approx(0.05, abs=0.03)
    assert '    cable_l.gain: 0.002\n' in text
    uncertainty = load_design_uncertainty(output)
    assert uncertainty.parameters == ('mass', 'friction_coefficient')
    assert 0.0 < uncertainty.stddev('mass') < 0.5 * fitted.mass


def test_calibrate_says_that_it_cannot_tell_the_law_and_writes_none(tmp_path):
    truth = unit_of('merged', cable_offset=PRELIMINARY.cable_offset)
    recording, _ = session_of(truth, SessionPlan(), np.random.default_rng(6))
    data = table_of(recording, tmp_path / 'data.csv')
    asked = ('calibrate', data, '--fit', 'mass,friction_coefficient', '--contact-law', 'all')
    output = tmp_path / 'fitted.yaml'
    done = run(*asked, '--output', output)
    assert done.returncode == 2
    assert 'contact law   the data cannot tell' in done.stdout
    assert 'would tell    a friction_coefficient that is measured otherwise' in done.stdout
    assert 'no design is written, since the data cannot tell' in done.stderr
    assert done.stderr.count('\n') == 1
    assert not output.exists()


def test_calibrate_writes_the_law_that_the_data_tell(tmp_path):
    truth = unit_of('friction_circle', cable_offset=PRELIMINARY.cable_offset)
    recording, _ = session_of(truth, SessionPlan(), np.random.default_rng(7))
    start = tmp_path / 'start.yaml'
    known = {'friction_coefficient': truth.friction_coefficient}
    save_design(start, dataclasses.replace(PRELIMINARY, **known))
    output = tmp_path / 'fitted.yaml'
    done = run(
        *('calibrate', table_of(recording, tmp_path / 'data.csv'), '--design', start),
        *('--fit', 'mass', '--contact-law', 'all', '--output', output),
    )
    assert done.returncode == 0, done.stderr
    assert 'contact law   the data tell friction_circle' in done.stdout
    assert load_design(output).contact_law == 'friction_circle'
