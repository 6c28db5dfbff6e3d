"""``arm replay`` and ``arm report`` with a force at the tip that is looked for."""

import csv
import random

import numpy as np
import pytest
from programs import run

from tendon_statics import ArmTracker, Load, load_arm
from tendon_statics.files.installed_files import installed_config

FILE = installed_config('arm.yaml')
ARM = load_arm(FILE)
FORCE = 0.02
COUNT = 40
ASKED = ('--direction', '1', '0', '--bend-angle-stddev-deg', '0.05')


def recorded(path, joints=(1, 2, 3, 4, 5), **more):
    """Write a session in which cable s_tip pulls, while something pushes that is measured."""
    tracker, draw = ArmTracker(ARM), random.Random(5)
    titles = ['time', *ARM.cable_names, 'tip_force_x', 'tip_force_z']
    titles += [f'bend_angle_{joint}' for joint in joints]
    rows = []
    for index in range(COUNT):
        tensions = dict.fromkeys(ARM.cable_names, 1.0) | {'s_tip': 1.2 + 0.45 * index / COUNT}
        tensions |= more
        angles = (0.0,) * 5
        if all(tensions.values()):
            angles = tracker.update(tensions, Load(tip_force=(FORCE, 0.0))).bend_angles
        noisy = [value + draw.gauss(0.0, 0.002) for value in tensions.values()]
        rows.append([0.05 * index, *noisy, FORCE, 0.0, *(angles[joint - 1] for joint in joints)])
    with path.open('w', encoding='utf-8', newline='') as file:
        csv.writer(file).writerows([titles, *rows])
    return path


def columns(path):
    with path.open(encoding='utf-8') as file:
        rows = list(csv.DictReader(line for line in file if line[0] != '#'))
    return {name: [row[name] for row in rows] for name in rows[0]}


def test_a_replay_writes_what_every_sample_tells_and_holds_it_against_what_was_measured(tmp_path):
    path, output = recorded(tmp_path / 'arm.csv'), tmp_path / 'replay.csv'
    done = run(
        'arm', 'replay', FILE, path, *ASKED, '--tension-stddev', '0.002', '--output', output
    )
    assert done.returncode == 0, done.stderr
    found = columns(output)
    low, high = (np.array(found[f'tip_force_{end}'], dtype=float) for end in ('low', 'high'))
    assert (low <= high).all()
    inside = (low <= FORCE) & (high >= FORCE)
    assert inside.mean() > 0.8
    assert f'force inside in {inside.sum()} of {COUNT} samples' in done.stdout
    assert f'{COUNT} intervals at 95 %' in done.stdout
    slips = np.array(found['tip_force_at_limit']) == 'True'
    assert 0 < slips.sum() < COUNT
    assert (high - low)[slips].max() < np.median((high - low)[~slips])
    free = np.array(found['tip_force_probability_free'], dtype=float)
    assert ((free >= 0.0) & (free <= 1.0)).all()
    assert 'not measured' not in done.stdout


def test_without_times_and_without_an_angle_for_a_while(tmp_path):
    path, output = recorded(tmp_path / 'arm.csv'), tmp_path / 'replay.csv'
    titles, *rows = csv.reader(path.read_text(encoding='utf-8').splitlines())
    third = titles.index('bend_angle_3')
    gap = [
        [*row[:third], '', *row[third + 1 :]] if 15 <= n < 35 else row
        for n, row in enumerate(rows)
    ]
    for columns_from, told in ((0, 30), (1, 20)):  # with times it holds for half a second
        with path.open('w', encoding='utf-8', newline='') as file:
            csv.writer(file).writerows([row[columns_from:] for row in (titles, *gap)])
        done = run('arm', 'replay', FILE, path, *ASKED, '--output', output)
        assert done.returncode == 0, done.stderr
        low = [value for value in columns(output)['tip_force_low'] if value not in ('', 'nan')]
        assert len(low) == pytest.approx(told, abs=1), columns_from


def test_joints_that_were_not_measured_are_named(tmp_path):
    done = run('arm', 'replay', FILE, recorded(tmp_path / 'arm.csv', (1, 2, 3, 4)), *ASKED)
    assert done.returncode == 0, done.stderr
    assert 'the angle of arm_joint_5: the estimated one takes the force' in done.stdout


def test_without_being_asked_for_there_is_none_of_it(tmp_path):
    output = tmp_path / 'replay.csv'
    done = run('arm', 'replay', FILE, recorded(tmp_path / 'arm.csv'), '--output', output)
    assert done.returncode == 0, done.stderr
    assert 'free tip' not in done.stdout
    assert 'tip_force_low' not in columns(output)


@pytest.mark.parametrize(
    ('direction', 'reason'), [(('0', '0'), 'length zero'), (('0', '1', '0'), 'out of the plane')]
)
def test_a_direction_that_is_none_is_refused_in_one_line(tmp_path, direction, reason):
    done = run('arm', 'replay', FILE, recorded(tmp_path / 'arm.csv'), '--direction', *direction)
    assert done.returncode != 0
    assert reason in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_a_recording_without_measured_angles_tells_nothing(tmp_path):
    done = run('arm', 'replay', FILE, recorded(tmp_path / 'arm.csv', ()), *ASKED)
    assert done.returncode != 0
    assert 'there is no measured bend angle' in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_of_a_slack_arm_nothing_is_told(tmp_path):
    path = recorded(tmp_path / 'arm.csv', s_mid=0.0, s_tip=0.0)
    done = run('arm', 'replay', FILE, path, *ASKED)
    assert done.returncode == 0, done.stderr
    assert 'no sample tells anything of it' in done.stdout


def test_the_report_has_the_figure_beside_what_was_measured(tmp_path):
    path, page = recorded(tmp_path / 'arm.csv'), tmp_path / 'report.html'
    done = run('arm', 'report', FILE, path, *ASKED, '--output', page)
    assert done.returncode == 0, done.stderr
    text = page.read_text(encoding='utf-8')
    for part in (
        *('Force at the tip', 'force inside in', 'forces that explain it', 'P(free tip)'),
        *('at the limit of friction', 'measured'),
    ):
        assert part in text, part
