"""What acts beside the cables, from the command line: tilt, gravity, a force at the tip."""

import csv
import json
import math
from dataclasses import replace

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import assert_refused, run, run_installed

from tendon_statics import (
    Load,
    StickSlipTracker,
    admissible_angles,
    save_design,
    solve,
    solve_batch,
    tensions_for,
)

PAIR = ('--tension-l', '1', '--tension-s', '2')
TILT = ('--base-tilt-deg', '10')
TILTED = Load.tilted(math.radians(10.0))
LOADED = ('--gravity-direction', '0.1', '0.2', '-0.9', '--tip-force', '-0.05', '-1e-1')
LOADED += ('--tip-distance', '0.03')
ALL = Load((0.1, 0.2, -0.9), (-0.05, -0.1), 0.03)


def as_json(*arguments):
    return json.loads(run(*arguments, '--format', 'json').stdout)


def test_ten_degrees_of_tilt_are_ten_degrees_of_bend():
    done = run_installed('solve', *PAIR, *TILT)
    assert '7.1400 deg' in done.stdout
    assert 'base tilted by 10 deg towards cable s' in done.stdout
    assert 'by base tilt -1.00 deg/deg' in done.stdout


@pytest.mark.parametrize(('options', 'load'), [(TILT, TILTED), (LOADED, ALL)], ids=['tilt', 'all'])
def test_solve_and_admissible_and_invert_take_it(options, load):
    answer = as_json('solve', *PAIR, *options)
    expected = solve(PRELIMINARY, 1.0, 2.0, load)
    assert answer['bend_angle'] == expected.bend_angle
    assert answer['load']['gravity_direction'] == list(load.gravity_direction)
    assert answer['load']['base_tilt'] == load.base_tilt
    assert answer['load']['tip_force'] == list(load.tip_force)
    assert answer['load']['tip_distance'] == load.tip_distance
    intervals = as_json('admissible', *PAIR, *options)['admissible_angles']
    assert [tuple(ends) for ends in intervals] == admissible_angles(PRELIMINARY, 1.0, 2.0, load)
    tensions = as_json('invert', '--bend-angle', '0.1', '--total-tension', '3', *options)
    assert tuple(tensions.values()) == tensions_for(PRELIMINARY, 0.1, total_tension=3.0, load=load)


def test_sweep_takes_it(tmp_path):
    path = tmp_path / 'map.npz'
    done = run('sweep', '--points', '9', '--output', path, *LOADED)
    assert done.returncode == 0, done.stderr
    swept = np.load(path)
    expected = solve_batch(
        PRELIMINARY, swept['tension_l'][:, None], swept['tension_s'][None, :], ALL
    )
    np.testing.assert_array_equal(swept['regime'], expected.regime_names)
    np.testing.assert_array_equal(swept['bend_angle'], expected.bend_angle)


def test_track_and_replay_take_it(tmp_path):
    path, replayed = tmp_path / 'run.csv', tmp_path / 'replayed.csv'
    pairs = [(1.0, 1.5), (1.0, 2.0), (1.0, 2.04), (2.1, 1.0)]
    path.write_text('tension_l,tension_s\n' + ''.join(f'{a},{b}\n' for a, b in pairs))
    tracker = StickSlipTracker(PRELIMINARY)
    expected = [tracker.update(*pair, TILTED) for pair in pairs]
    rows = list(csv.DictReader(run('track', path, *TILT).stdout.splitlines()))
    assert [float(row['bend_angle']) for row in rows] == [s.bend_angle for s in expected]
    assert [row['regime'] for row in rows] == [str(state.regime) for state in expected]
    done = run('replay', path, '--output', replayed, *TILT)
    assert 'base tilted by 10 deg towards cable s' in done.stdout
    with replayed.open(newline='') as file:
        rows = list(csv.DictReader(file))
    for row, pair in zip(rows, pairs, strict=True):
        answer = solve(PRELIMINARY, *pair, TILTED)
        assert row['regime'] == answer.regime
        if answer.bend_angle is not None:
            assert float(row['estimated_bend_angle']) == pytest.approx(answer.bend_angle, abs=1e-9)
            assert float(row['slip_margin']) == pytest.approx(answer.slip_margin, abs=1e-9)


@pytest.mark.parametrize('figure', ['residual', 'map', 'hysteresis', 'unit'])
def test_figures_say_it(tmp_path, figure):
    pictures = [tmp_path / f'{i}.svg' for i in range(2)]
    few = ('--points', '11') if figure == 'map' else ()
    for picture, options in zip(pictures, ((), TILT), strict=True):
        done = run('plot', figure, '--output', picture, *few, *options)
        assert done.returncode == 0, done.stderr
    # Texts are drawn as paths, but written beside them as comments.
    upright, tilted = (picture.read_text(encoding='utf-8') for picture in pictures)
    assert 'base tilted by 10 deg' in tilted
    assert 'tilted' not in upright


def test_the_unit_is_drawn_with_its_base_and_its_tip_force(tmp_path):
    picture = tmp_path / 'unit.svg'
    assert run('plot', 'unit', '--output', picture, *LOADED).returncode == 0
    text = picture.read_text(encoding='utf-8')
    assert '<!-- γ -->' in text
    assert '<!-- F = 0.112 N -->' in text


def test_the_law_is_said_where_it_is_not_the_papers(tmp_path):
    path = tmp_path / 'unit.yaml'
    save_design(path, replace(PRELIMINARY, contact_law='friction_circle'))
    options = ('--tension-l', '1', '--tension-s', '4.5', '--design', path)
    text = run('solve', *options).stdout
    assert 'friction_circle, for a ball with play' in text
    assert '+0.000 N in X, +0.000 N in Z' in text
    assert "the paper's law" not in text
    assert as_json('solve', *options)['contact_law'] == 'friction_circle'


def test_the_papers_law_says_why_there_is_a_remainder():
    text = run('solve', *PAIR).stdout
    assert '-0.386 N in X' in text
    assert 'only has their squares add up' in text


def test_the_design_file_says_what_options_leave_open(tmp_path):
    path = tmp_path / 'unit.yaml'
    direction = [math.sin(math.radians(10.0)), 0.0, -math.cos(math.radians(10.0))]
    beside = {'gravity_direction': direction, 'tip_distance': 0.03}
    save_design(path, PRELIMINARY, parameters=beside)
    file = ('--design', path)
    assert '7.1400 deg' in run('solve', *PAIR, *file).stdout
    upright = run('solve', *PAIR, *file, '--base-tilt-deg', '0').stdout
    assert '17.1400 deg' in upright
    assert '-30.0000 deg to +7.1400 deg' in run('admissible', *PAIR, *file).stdout
    with_tip = as_json('solve', *PAIR, *file, '--tip-force', '0', '-0.1')
    assert with_tip['load']['tip_distance'] == 0.03
    assert with_tip['load']['gravity_direction'] == pytest.approx(direction)
    samples = tmp_path / 'run.csv'
    samples.write_text('tension_l,tension_s\n1.0,2.0\n1.0,2.0\n')
    assert 'base tilted by 10 deg' in run('replay', samples, *file).stdout
    (row, _) = csv.DictReader(run('track', samples, *file).stdout.splitlines())
    tracked = StickSlipTracker(PRELIMINARY).update(1.0, 2.0, TILTED)
    assert float(row['bend_angle']) == tracked.bend_angle
    assert float(row['slip_margin']) == pytest.approx(tracked.slip_margin)


def test_a_recording_with_a_tilt_of_its_own_is_tracked_by_that(tmp_path):
    samples = tmp_path / 'run.csv'
    samples.write_text('tension_l,tension_s,base_tilt [deg]\n1.0,2.0,10\n1.0,2.0,10\n')
    (row, _) = csv.DictReader(run('track', samples).stdout.splitlines())
    tracked = StickSlipTracker(PRELIMINARY).update(1.0, 2.0, TILTED)
    assert float(row['slip_margin']) == pytest.approx(tracked.slip_margin)
    assert_refused(run('track', samples, *TILT), 'has the tilt of the base in it')


@pytest.mark.parametrize(
    ('options', 'named'),
    [
        (('--base-tilt-deg', 'nan'), "--base-tilt-deg: it is 'nan', allowed is a finite number"),
        (('--base-tilt-deg', 'steep'), "'steep'"),
        ((*TILT, '--gravity-direction', '0', '0', '-1'), 'not allowed with'),
        (('--gravity-direction', '0', '0', '0'), 'length zero'),
        (('--gravity-direction', '0', '-1'), '3 arguments'),
        (('--tip-force', '0.1', '0'), 'say --tip-distance'),
        (('--tip-distance', '0.1'), '--tip-distance is given without --tip-force'),
        (('--tip-force', '0', '5', '--tip-distance', '0'), 'the pull of weight and tip force'),
        (('--tip-force', '1e10', '5', '--tip-distance', '0'), 'allowed is up to 1e+09'),
    ],
)
def test_a_load_that_cannot_be_is_refused_in_one_line(options, named):
    assert_refused(run('solve', *PAIR, *options), named)
