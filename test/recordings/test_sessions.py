"""`calibrate` takes no session for a list of slips, and writes no design it cannot believe."""

import dataclasses

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import assert_refused, run
from slips import TRUTH, measured, recording, session, slipping_samples

from tendon_statics import CalibrationError, calibrate
from tendon_statics.physics.calibration.sessions import follow_each_other
from tendon_statics.recordings.replay.table_output import write_table


def written(path, samples):
    names = ('tension_l', 'tension_s', 'bend_angle', 'pressure')
    write_table(path, dict(zip(names, samples.T, strict=False)))
    return path


@pytest.mark.parametrize('seed', range(20))
def test_a_list_of_slips_is_none_that_follows_itself_in_time(seed):
    rng = np.random.default_rng(seed)
    for count in (12, 40, 200):
        samples = measured(slipping_samples(count, rng), rng)
        assert follow_each_other(recording(samples)) == ''


@pytest.mark.parametrize('seed', range(20))
def test_a_session_is_known_by_its_samples_without_any_times(seed):
    rng = np.random.default_rng(seed)
    samples = session(slipping_samples(6, rng), rng)
    assert follow_each_other(samples)
    assert follow_each_other(samples.part(np.arange(len(samples)) < 60))


@pytest.mark.parametrize('count', [9, 12, 20, 29, 40])
def test_a_short_ramp_without_times_is_refused_in_python_as_on_the_command_line(tmp_path, count):
    rng = np.random.default_rng(count)
    strong = np.linspace(1.2, 2.1, count)
    rows = measured(np.stack([0 * strong + 1.0, strong, 0.1 * strong, 200 * strong], axis=1), rng)
    with pytest.raises(CalibrationError, match='tension_s changes little from one to the next'):
        calibrate(PRELIMINARY, recording(rows))
    done = run('calibrate', written(tmp_path / 'run.csv', rows))
    assert_refused(done, 'tension_s changes little from one to the next')


def test_that_all_are_taken_to_slip_is_said(tmp_path):
    rng = np.random.default_rng(2)
    path = written(tmp_path / 'run.csv', measured(slipping_samples(20, rng, TRUTH), rng))
    said = 'all slipping, as is taken of a list without states and times'
    assert said in run('calibrate', path).stdout
    output = tmp_path / 'fitted.yaml'
    assert said not in run('calibrate', path, '--all-slipping', '--output', output).stdout
    assert '# States: all slipping, as was said.' in output.read_text(encoding='utf-8')


def test_a_long_table_is_no_list_that_anybody_has_written():
    rng = np.random.default_rng(1)
    rows = measured(np.tile([1.0, 1.5, 0.1, 400.0], (600, 1)), rng)
    assert follow_each_other(recording(rows)) == 'there are 600 of them'


@pytest.mark.parametrize('verb', ['calibrate', 'report'])
def test_a_session_without_states_and_times_is_not_fitted_as_slips(tmp_path, verb):
    rng = np.random.default_rng(5)
    whole = session(slipping_samples(6, rng), rng)
    path, output = tmp_path / 'run.csv', tmp_path / 'out.html'
    rows = np.stack(
        [whole.tension_l, whole.tension_s, whole.bend_angle, np.full(len(whole), 400.0)]
    )
    written(path, rows.T)
    done = run(verb, path, *(('--output', output) if verb == 'report' else ()))
    if verb == 'calibrate':
        assert_refused(done, 'say that all are (--all-slipping)')
    else:
        assert 'has no calibration: ' in done.stderr
        assert '--all-slipping' in done.stderr


def test_a_fit_that_ends_at_its_bound_is_shown_but_not_written(tmp_path):
    """Held samples that are said to slip ask for a friction that no joint has, or none."""
    rng = np.random.default_rng(2)
    samples = slipping_samples(20, rng)
    samples[:, 1] = samples[:, 0] + 0.02 * (samples[:, 1] - samples[:, 0])
    path, output = written(tmp_path / 'run.csv', samples[:, :3]), tmp_path / 'fitted.yaml'
    options = ('--all-slipping', '--fit', 'friction_coefficient', '--output', output)
    done = run('calibrate', path, *options)
    assert done.returncode == 2
    assert 'no design is written, since friction_coefficient = ' in done.stderr
    assert '| friction_coefficient |' in done.stdout
    assert not output.exists()


def test_a_sound_fit_is_written(tmp_path):
    rng = np.random.default_rng(2)
    path = written(tmp_path / 'run.csv', measured(slipping_samples(20, rng, TRUTH), rng))
    output = tmp_path / 'fitted.yaml'
    done = run('calibrate', path, '--output', output)
    assert done.returncode == 0, done.stderr
    assert output.exists()


def test_a_value_at_the_end_of_its_range_is_not_written(tmp_path):
    """Pressures of a unit whose cables run through the socket's edge, with noise below it."""
    rng = np.random.default_rng(4)
    truth = dataclasses.replace(TRUTH, cable_offset=0.0)
    samples = slipping_samples(20, rng, truth)
    samples[:, 1] += 0.1 * (samples[:, 1] - samples[:, 0])
    samples[:, 3] *= 0.9
    path, output = written(tmp_path / 'run.csv', samples), tmp_path / 'fitted.yaml'
    options = ('--all-slipping', '--fit', 'cable_offset', '--output', output)
    done = run('calibrate', path, *options)
    assert done.returncode == 2
    assert 'no design is written, since cable_offset = ' in done.stderr
    assert 'is at the end of its range' in done.stderr
    assert not output.exists()
