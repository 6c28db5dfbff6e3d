"""``tendon-statics tip-force``, and the force at the tip in replays, figures and reports."""

import csv
import dataclasses
import json
import math
import random

import brute
import pytest
from designs import PRELIMINARY
from programs import assert_refused, run

from tendon_statics import (
    UPRIGHT,
    Recording,
    RecordingError,
    save_design,
    solve,
    tensions_for,
    tip_force,
    tip_force_intervals,
)
from tendon_statics.estimation.settings import Settings
from tendon_statics.recordings.replay.tip_forces import tip_forces

PAIR = ('--tension-l', '1', '--tension-s', '1.9', '--bend-angle-deg', '5')
LINE = ('--direction', '1', '0', '--distance', '0.02')
ACROSS = {'direction': (1.0, 0.0), 'distance': 0.02}


def test_it_prints_the_set_of_a_pair_and_that_under_noise():
    found = json.loads(run('tip-force', *PAIR, *LINE, '--format', 'json').stdout)
    pair = {'bend_angle': math.radians(5.0), **ACROSS}
    assert found['exact_intervals'] == [
        list(one) for one in tip_force_intervals(PRELIMINARY, 1.0, 1.9, **pair)
    ]
    noise = {'tension_stddev': 0.01, 'bend_angle_stddev': math.radians(0.5)}
    noisy = tip_force(PRELIMINARY, 1.0, 1.9, **pair, **noise)
    assert found['intervals'] == [list(one) for one in noisy.intervals]
    assert found['probability_free'] == noisy.probability_free


def test_of_a_slipping_unit_it_prints_a_number_with_its_deviation():
    text = run('tip-force', *PAIR, *LINE, '--slipping', 's').stdout
    assert 'force         +0.0592 N, deviation 0.0095 N' in text


def test_a_ray_has_words_and_null_in_json(tmp_path):
    smooth = tmp_path / 'smooth.yaml'
    save_design(smooth, dataclasses.replace(PRELIMINARY, contact_law='friction_circle'))
    down = ('--direction', '0', '-1', '--distance', '0.02', '--design', smooth)
    found = json.loads(run('tip-force', *PAIR, *down, '--format', 'json').stdout)
    assert found['exact_intervals'][-1][1] is None
    assert 'any force from' in run('tip-force', *PAIR, *down).stdout


@pytest.mark.parametrize(
    ('changed', 'reason'),
    [
        (('--direction', '0', '1', '0'), 'out of the plane'),
        (('--direction', '0', '0'), 'length zero'),
        (('--bend-angle-deg', '31'), 'allowed is'),
        (('--tension-l', '0'), 'slack'),
        (('--level', '1'), 'below 1'),
    ],
)
def test_bad_input_is_refused_in_one_line(changed, reason):
    assert_refused(run('tip-force', *PAIR, *LINE, *changed), reason)


def test_where_the_force_acts_has_to_be_said():
    assert_refused(run('tip-force', *PAIR, '--direction', '1', '0'), '--distance')


@pytest.fixture(scope='module')
def session(tmp_path_factory):
    """A table of tensions, measured angles and forces, held and on the verge of slipping."""
    draw = random.Random(3)
    path = tmp_path_factory.mktemp('session') / 'session.csv'
    with path.open('w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file)
        writer.writerow(('time', 'tension_l', 'tension_s', 'bend_angle', 'tip_force_x', 'state'))
        for index in range(200):
            angle = draw.uniform(-0.4, 0.4)
            case = brute.Case(PRELIMINARY, UPRIGHT, 1.5, draw.uniform(1.2, 1.8))
            pair = {'bend_angle': angle, **ACROSS}
            ((low, high),) = tip_force_intervals(PRELIMINARY, *case[2:], **pair)
            noisy = [tension + draw.gauss(0.0, 0.01) for tension in case[2:]]
            force = draw.uniform(low, high)
            measured = angle + draw.gauss(0.0, math.radians(0.5))
            writer.writerow((0.01 * index, *noisy, measured, force, 'held'))
    return path


def test_a_replay_says_how_often_the_measured_force_is_inside(session, tmp_path):
    written = tmp_path / 'replay.csv'
    done = run('replay', session, *LINE, '--tip-distance', '0.02', '--output', written)
    assert done.returncode == 0, done.stderr
    with written.open(encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    inside = sum(
        float(row['tip_force_low']) <= float(row['tip_force_x']) <= float(row['tip_force_high'])
        for row in rows
    )
    assert inside >= 0.95 * len(rows)
    assert f'inside in {inside} of {len(rows)} samples' in done.stdout


def test_a_figure_and_a_report_show_it(session, tmp_path):
    figure, page = tmp_path / 'force.svg', tmp_path / 'report.html'
    done = run('plot', 'tip-force', session, *LINE, '--output', figure)
    assert done.returncode == 0, done.stderr
    assert figure.read_text(encoding='utf-8').startswith('<?xml')
    done = run('report', session, *LINE, '--tip-distance', '0.02', '--output', page)
    assert done.returncode == 0, done.stderr
    text = page.read_text(encoding='utf-8')
    assert 'Force at the tip' in text
    assert 'force inside in' in text


def test_without_a_measured_angle_a_recording_tells_nothing():
    recording = Recording([1.0, 1.0], [1.5, 1.6])
    with pytest.raises(RecordingError, match='no measured bend angle'):
        tip_forces(
            *(recording, Settings(PRELIMINARY)), load=UPRIGHT, bend_angle_stddev=0.01, **ACROSS
        )


def test_a_sample_before_a_motion_is_at_the_limit_to_the_side_of_it():
    angle = 0.2
    tensions = tensions_for(PRELIMINARY, angle, total_tension=3.0)
    assert solve(PRELIMINARY, *tensions).bend_angle == pytest.approx(angle)
    recording = Recording(
        *([tension] * 2 for tension in tensions),
        bend_angle=[angle, angle + 0.2],
        state=['slipping', 'moving'],
    )
    found = tip_forces(
        *(recording, Settings(PRELIMINARY)), load=UPRIGHT, bend_angle_stddev=0.01, **ACROSS
    )
    assert found.at_limit.tolist() == [True, False]
    assert found.low[0] < 0.0 < found.high[0]
    assert found.high[0] - found.low[0] < 0.2
