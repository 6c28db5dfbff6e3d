"""Replays that take tensions for noisy, or the design for uncertain: as the node says it."""

import csv
import math
import re

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import assert_refused, run
from rosbags.highlevel import AnyReader

from tendon_statics import (
    DesignUncertainty,
    Recording,
    RecordingError,
    StickSlipFilter,
    StickSlipTracker,
    save_design,
    solve,
)
from tendon_statics.estimation.settings import Settings
from tendon_statics.recordings.replay.estimates import replay

NOISE = 0.01
UNSURE = DesignUncertainty(('friction_coefficient',), ((1e-4,),))


@pytest.fixture(scope='module')
def session():
    """A ramp to a rest below slip, across it and back, with the true angle."""
    count = 400
    time = 0.01 * np.arange(count)
    tension_s = np.interp(time, [0.0, 1.0, 2.0, 3.0, 4.0], [1.2, 2.02, 2.02, 3.0, 1.5])
    tracker = StickSlipTracker(PRELIMINARY)
    truth = [tracker.update(1.0, tension).bend_angle for tension in tension_s.tolist()]
    noise = np.random.default_rng(5).normal(0.0, NOISE, (2, count))
    return Recording(1.0 + noise[0], tension_s + noise[1], bend_angle=truth, time=time)


@pytest.fixture
def data(session, tmp_path):
    path = tmp_path / 'run.csv'
    with path.open('w', newline='') as file:
        writer = csv.writer(file)
        writer.writerow(['time', 'tension_l', 'tension_s', 'bend_angle'])
        columns = (session.time, session.tension_l, session.tension_s, session.bend_angle)
        writer.writerows(zip(*(column.tolist() for column in columns), strict=True))
    return path


def test_each_sample_is_as_the_filter_says_it(session):
    settings = Settings(PRELIMINARY, tension_stddev=NOISE, confidence=0.8, filter_lag=0.095)
    found = replay(PRELIMINARY, session, 'filtering', settings=settings)
    expected = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE, lag=0.095)
    time = 0.001
    for place, pair in enumerate(session.tensions()):
        state = expected.update(*pair, time)
        time += 0.01
        assert found.regime[place] == state.regime.value
        assert found.bend_angle[place] == pytest.approx(state.bend_angle, abs=1e-9)
        low, high = state.interval(0.8)
        assert found.interval[0][place] == pytest.approx(low, abs=1e-9)
        assert found.interval[1][place] == pytest.approx(high, abs=1e-9)
    total = sum(found.regime_probabilities.values())
    assert total == pytest.approx(np.ones(len(session)))
    assert found.noise_risks == 0
    tracked = replay(PRELIMINARY, session, 'tracking', settings=settings)
    assert tracked.noise_risks > 5
    assert (tracked.interval, tracked.regime_probabilities) == (None, None)
    # It was at rest below slip for a second, which noise alone ends for who believes it.
    rest = slice(100, 200)
    assert np.abs(found.error[rest]).max() < math.radians(1.0)
    assert np.abs(tracked.bend_angle - session.bend_angle)[rest].max() > math.radians(10.0)
    # It does not say that it is sure, at the stop to which noise has slipped it either.
    assert not tracked.angle_assured[rest].any()


def test_it_needs_times(session):
    untimed = Recording(session.tension_l, session.tension_s)
    with pytest.raises(RecordingError, match='filtering needs the time of each sample'):
        replay(PRELIMINARY, untimed, 'filtering')


def test_the_verb_asks_for_the_noise_and_says_how_wide_the_band_is(data, tmp_path):
    asked = run('replay', data, '--estimation', 'filtering')
    assert_refused(asked, 'give --tension-stddev, in N, or tension_stddev in the design file')
    output = tmp_path / 'out.csv'
    options = ('--estimation', 'filtering', '--tension-stddev', NOISE)
    done = run('replay', data, *options, '--output', output)
    assert (done.returncode, done.stderr) == (0, '')
    assert re.search(r'^95 % interval +[\d.]+ deg wide in the mean$', done.stdout, re.MULTILINE)
    within = re.search(r'([\d.]+) % of the measured angles', done.stdout)
    assert float(within[1]) > 90.0
    with output.open(newline='') as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        low, high = (float(row[f'estimated_bend_angle_{end}']) for end in ('low', 'high'))
        assert low <= float(row['estimated_bend_angle']) <= high
        shares = [float(text) for name, text in row.items() if name.startswith('probability_')]
        assert sum(shares) == pytest.approx(1.0)


def test_the_unit_s_file_says_all_of_it(data, tmp_path):
    unit = tmp_path / 'unit.yaml'
    said = {'estimation': 'filtering', 'tension_stddev': NOISE, 'confidence': 0.5}
    save_design(unit, PRELIMINARY, parameters=said)
    done = run('replay', data, '--design', unit)
    assert done.returncode == 0, done.stderr
    assert '\n50 % interval' in done.stdout
    save_design(unit, PRELIMINARY, parameters={**said, 'tension_stddev': 0.0})
    assert_refused(run('replay', data, '--design', unit), 'needs the noise of each tension')


def test_a_bag_has_the_band_too(data, tmp_path):
    output = tmp_path / 'out.mcap'
    options = ('--estimation', 'filtering', '--tension-stddev', NOISE)
    assert run('replay', data, *options, '--output', output).returncode == 0
    with AnyReader([output]) as reader:
        topics = {connection.topic for connection in reader.connections}
    names = ('bend_angle_low', 'bend_angle_high', 'probability_held', 'probability_slipping')
    assert {f'/replay/{name}' for name in names} <= topics


@pytest.mark.parametrize('verb', ['report', 'plot'])
def test_report_and_figure_have_the_band(data, tmp_path, verb):
    output = tmp_path / ('page.html' if verb == 'report' else 'figure.svg')
    what = () if verb == 'report' else ('recording',)
    options = ('--estimation', 'filtering', '--tension-stddev', NOISE, '--output', output)
    done = run(verb, *what, data, *options)
    assert done.returncode == 0, done.stderr
    text = output.read_text(encoding='utf-8')
    assert '95 % interval' in text
    assert 'measured' in text


def test_deviations_of_each_sample_cover_a_design_that_is_not_exact(session):
    settings = Settings(PRELIMINARY, tension_stddev=NOISE)
    unsure = Settings(PRELIMINARY, tension_stddev=NOISE, design_uncertainty=UNSURE)
    one, other = (replay(PRELIMINARY, session, settings=of) for of in (settings, unsure))
    assert one.regime.tolist() == other.regime.tolist()
    assert one.angle_assured.tolist() == other.angle_assured.tolist()
    np.testing.assert_allclose(one.bend_angle, other.bend_angle, rtol=0.0, atol=1e-9)
    for place, pair in enumerate(session.tensions()):
        if one.regime[place] == 'equilibrium':
            expected = solve(PRELIMINARY, *pair).bend_angle_stddev(NOISE, UNSURE)
            assert other.bend_angle_stddev[place] == pytest.approx(expected)
            assert expected > one.bend_angle_stddev[place]


def test_solve_says_that_its_deviation_covers_the_design(tmp_path):
    unit = tmp_path / 'unit.yaml'
    save_design(unit, PRELIMINARY, uncertainty=UNSURE)
    pair = ('--tension-l', 1, '--tension-s', 2)
    one, other = run('solve', *pair).stdout, run('solve', *pair, '--design', unit).stdout
    assert "and the design's tolerance" not in one
    assert "N of noise on each tension and the design's tolerance" in other
    before, after = (re.search(r'deviation +([\d.]+) deg', text)[1] for text in (one, other))
    assert float(after) > float(before)
