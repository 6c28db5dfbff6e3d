"""`tare`: biases from slack and still cables, and from nothing else."""

import math
import random

import pytest
from programs import assert_refused, run

from tendon_statics.files.unit_file import load_unit
from tendon_statics.tensions.tare import FEWEST, TareError, tare

STDDEV = 0.01


def still(mean, count=200, seed=1, stddev=STDDEV):
    rng = random.Random(seed)
    return [rng.gauss(mean, stddev) for _ in range(count)]


def pair(tensions_l, tensions_s, biases=(0.0, 0.0)):
    return tare({'cable_l': tensions_l, 'cable_s': tensions_s}, biases, STDDEV)


def test_with_the_new_biases_the_mean_is_zero():
    slack_l, slack_s = still(0.12), still(-0.03, seed=2)
    of_l, of_s = pair(slack_l, slack_s, (-0.1, 0.0))
    assert of_l.bias == pytest.approx(-0.22, abs=4 * STDDEV / math.sqrt(200))
    assert of_s.bias == pytest.approx(0.03, abs=4 * STDDEV / math.sqrt(200))
    again = [value + of_l.bias + 0.1 for value in slack_l]
    of_l, _ = pair(again, slack_s, (of_l.bias, 0.0))
    assert abs(of_l.mean) < 1e-12


def test_readings_that_are_none_do_not_count():
    values = [math.nan, math.inf, *still(0.1)]
    of_l, _ = pair(values, still(0.0))
    assert of_l.readings == 200
    assert of_l.bias == pytest.approx(-0.1, abs=0.01)


@pytest.mark.parametrize('seed', range(50))
def test_noise_as_it_is_stated_is_still(seed):
    pair(still(0.3, seed=seed), still(-0.3, seed=1000 + seed))


@pytest.mark.parametrize(
    ('moving', 'named'),
    [
        (still(0.0, stddev=0.2), 'its readings scatter by 0.'),
        ([0.0002 * step + value for step, value in enumerate(still(0.0))], 'the second half'),
        (still(0.0, FEWEST - 1), f'19 readings; {FEWEST} are needed'),
        ([], '0 readings'),
        ([math.nan] * 100, '0 readings'),
        ([*still(0.0, 100), *still(1.0, 100)], 'was not still'),
    ],
)
def test_what_is_not_still_is_refused_for_either_cable(moving, named):
    with pytest.raises(TareError, match=f'cable_l .*{named}'):
        pair(moving, still(0.0))
    with pytest.raises(TareError, match=f'cable_s .*{named}'):
        pair(still(0.0), moving)


@pytest.fixture
def slack(tmp_path):
    """Counts of slack cables for 2 s, and then a pull."""
    rows = list(zip(still(103.0, stddev=5.0), still(-20.0, seed=2, stddev=5.0), strict=True))
    rows += [(1000.0 + 10.0 * step, 900.0) for step in range(50)]
    text = ''.join(f'{0.01 * i:.2f},{at_l},{at_s}\n' for i, (at_l, at_s) in enumerate(rows))
    path = tmp_path / 'slack.csv'
    path.write_text(f'time,tension_l,tension_s\n{text}')
    return path


@pytest.fixture
def unit(tmp_path):
    from tendon_statics import default_design_path

    path = tmp_path / 'unit.yaml'
    text = default_design_path().read_text()
    gains = '    cable_l: {gain: 0.001, bias: -0.1}\n    cable_s.gain: 0.001\n'
    path.write_text(text.replace('    design:', f'{gains}    design:'))
    return path


def test_the_verb_says_what_it_found_and_writes_the_file_with_it(slack, unit, tmp_path):
    output = tmp_path / 'tared.yaml'
    done = run('tare', slack, '--design', unit, '--end', 1.995, '--output', output)
    assert done.returncode == 0, done.stderr
    before, after = load_unit(unit), load_unit(output)
    assert after.design == before.design
    assert after.cable_l.gain == 0.001
    assert after.cable_l.bias == pytest.approx(-0.103, abs=0.002)
    assert after.cable_s.bias == pytest.approx(0.020, abs=0.002)
    assert f'    cable_l.bias: {after.cable_l.bias!r}\n' in done.stdout
    assert '| cable_l |      200 |' in done.stdout


def test_the_rest_of_the_file_stays_to_the_last_character(slack, unit):
    text = f'# Robot 3\n{unit.read_text()}/other:\n  ros__parameters: {{speed: 010}}  # rpm\n'
    text = text.replace('bias: -0.1', 'bias: -0.1   ').replace('010', '10')
    unit.write_text(text, encoding='utf-8')
    for _ in range(2):
        done = run('tare', slack, '--design', unit, '--end', 1.995, '--output', unit)
        assert done.returncode == 0, done.stderr
        tared = load_unit(unit)
        comment, *lines = unit.read_text(encoding='utf-8').splitlines(keepends=True)
        assert comment.startswith('# Biases of ')
        bias = f'cable_s.bias: {tared.cable_s.bias!r}'
        expected = text.replace('-0.1', repr(tared.cable_l.bias))
        expected = expected.replace('ros__parameters:\n', f'ros__parameters:\n    {bias}\n', 1)
        assert ''.join(lines) == expected


def test_the_verb_refuses_what_is_not_still_and_writes_nothing(slack, unit, tmp_path):
    output = tmp_path / 'tared.yaml'
    done = run('tare', slack, '--design', unit, '--output', output)
    assert_refused(done, 'slack.csv: cable_l was not still')
    assert '--start and --end choose a time' in done.stderr
    assert not output.exists()
    assert_refused(run('tare', slack, '--start', 99), 'it has those from 0 s to 2.49 s')


def test_the_verb_warns_of_cables_that_may_have_been_taut(tmp_path):
    path = tmp_path / 'taut.csv'
    pairs = zip(still(1.0), still(0.0, seed=3), strict=True)
    rows = ''.join(f'{at_l},{at_s}\n' for at_l, at_s in pairs)
    path.write_text('tension_l,tension_s\n' + rows)
    done = run('tare', path)
    assert 'warning       cable_l read 1' in done.stdout
    assert 'cable_s read' not in done.stdout
    assert_refused(run('tare', path, '--start', 1), 'it has no times')


@pytest.mark.parametrize(
    ('titles', 'is_warned'),
    [
        ('tension_l,tension_s', False),
        ('tension_l [N],tension_s [N]', True),
        ('tension_l [mN],tension_s [mN]', True),
    ],
)
def test_the_verb_warns_where_the_columns_are_in_newtons_and_take_no_bias(
    titles, is_warned, tmp_path
):
    path = tmp_path / 'slack.csv'
    rows = ''.join(f'{of},{of}\n' for of in still(0.01))
    path.write_text(f'{titles}\n{rows}')
    done = run('tare', path)
    assert done.returncode == 0, done.stderr
    assert ('a bias counts only for what the node reads' in done.stdout) == is_warned
