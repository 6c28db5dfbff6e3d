"""``tendon-statics calibrate``: from a file to a design file."""

import json
import math

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import assert_refused, run
from slips import TRUTH, measured, slipping_samples

from tendon_statics import load_design, solve


@pytest.fixture
def point(tmp_path):
    """The paper's one published point."""
    path = tmp_path / 'point.csv'
    path.write_text('tension_l,tension_s,bend_angle [deg],pressure\n1,2,17.14,405.6\n')
    return path


@pytest.fixture
def session(tmp_path):
    """Slips of a unit that is not as drawn, with held samples and two damaged lines."""
    path = tmp_path / 'session.csv'
    rng = np.random.default_rng(1)
    samples = measured(slipping_samples(40, rng), rng)
    rows = ['tension_l,tension_s,bend_angle,pressure,state']
    rows += [','.join(map(repr, row)) + ',slipping' for row in samples.tolist()]
    rows += ['1.0,1.1,0.1,,held', '1,2,', 'x', '0.0,1.0,0.1,,held', '1,1,0.1,,moving']
    path.write_text('\n'.join(rows) + '\n')
    return path


def test_the_published_point_gives_back_the_preliminary_design(tmp_path, point):
    start, output = tmp_path / 'start.yaml', tmp_path / 'fitted.yaml'
    done = run('calibrate', point, '--fit', 'mass,cable_offset', '--output', start)
    assert (done.returncode, done.stderr) == (0, '')
    text = start.read_text()
    start.write_text(text.replace('cable_offset: 0.0044', 'cable_offset: 0.0064'))
    assert load_design(start).cable_offset > 0.006
    run(
        *('calibrate', point, '--design', start, '--fit', 'mass,cable_offset'),
        *('--output', output),
    )
    fitted = load_design(output)
    assert fitted.mass == pytest.approx(PRELIMINARY.mass, rel=1e-8)
    assert fitted.cable_offset == pytest.approx(PRELIMINARY.cable_offset, rel=1e-8)
    answer = solve(fitted, 1.0, 2.0)
    assert math.degrees(answer.bend_angle) == pytest.approx(17.14, abs=1e-6)
    assert answer.pressure == pytest.approx(405.6, abs=1e-6)


def test_the_output_says_where_its_values_come_from(tmp_path, session):
    output = tmp_path / 'fitted.yaml'
    done = run('calibrate', session, '--output', output)
    assert done.returncode == 1
    assert done.stderr.count('\n') == 1
    assert 'session.csv: not all of it could be read: line 43' in done.stderr
    comment = [line for line in output.read_text().splitlines() if line.startswith('#')]
    *said, wrote = done.stdout.splitlines()
    assert wrote == f'wrote {output}'
    for line in said:
        assert f'# {line}'.rstrip() in comment
    for named in ('slipping: 40, with a pressure: 40, held: 1', 'slack: 1', 'known state: 1'):
        assert named in done.stdout
    assert 'tendon_statics 0.' in comment[0]
    design = load_design(output)
    assert design.friction_coefficient == pytest.approx(TRUTH.friction_coefficient, rel=0.1)
    assert design.ball_radius == PRELIMINARY.ball_radius


def test_json_holds_what_the_text_says(session):
    answer = json.loads(run('calibrate', session, '--format', 'json').stdout)
    assert answer['data'] == 'session.csv'
    names = [parameter['name'] for parameter in answer['parameters']]
    assert names == ['mass', 'cable_offset', 'friction_coefficient']
    assert all(parameter['standard_error'] > 0.0 for parameter in answer['parameters'])
    assert answer['design']['mass'] == answer['parameters'][0]['value']
    assert answer['counts']['slipping'] == 40
    assert np.array(answer['correlation']).shape == (3, 3)


def test_what_cannot_be_told_is_not_given_a_number(tmp_path, point):
    output = tmp_path / 'fitted.yaml'
    done = run('calibrate', point, '--output', output)
    assert done.stdout.count('not determined') == 3
    assert '2 equations cannot determine 3 parameters' in done.stdout
    assert done.returncode == 2
    assert done.stderr.count('\n') == 1
    assert 'do not determine mass and cable_offset and friction_coefficient' in done.stderr
    assert not output.exists()
    answer = json.loads(run('calibrate', point, '--format', 'json').stdout)
    assert answer['design'] is None
    for parameter in answer['parameters']:
        assert [parameter[key] for key in ('value', 'standard_error', 'interval')] == [None] * 3
    assert answer['correlation'] == [[None] * 3] * 3


@pytest.mark.parametrize('ending', ['csv', 'txt'])
def test_a_design_never_takes_the_place_of_the_recording(point, ending):
    before = point.read_text()
    output = point.with_suffix(f'.{ending}')
    done = run('calibrate', point, '--fit', 'mass', '--output', output)
    assert_refused(done, 'a design is written to a file ending in .yaml')
    assert point.read_text() == before


def test_the_design_file_says_what_the_fit_took(tmp_path, session):
    output = tmp_path / 'fitted.yaml'
    run('calibrate', session, '--output', output)
    assert '# States: those of the recording.\n' in output.read_text()
    assert '# Not all of the data could be read: line 43' in output.read_text()
    assert json.loads(run('calibrate', session, '--format', 'json').stdout)['damage']


def test_a_session_has_to_say_what_slips(tmp_path):
    path = tmp_path / 'session.csv'
    samples = measured(slipping_samples(20, np.random.default_rng(2)), np.random.default_rng(2))
    rows = [f'{index},' + ','.join(map(repr, row)) for index, row in enumerate(samples.tolist())]
    path.write_text('time,tension_l,tension_s,bend_angle,pressure\n' + '\n'.join(rows) + '\n')
    assert_refused(run('calibrate', path), 'say that all are (--all-slipping)')
    assert 'slipping: 20' in run('calibrate', path, '--all-slipping').stdout


def test_the_node_takes_the_fitted_file(tmp_path, session, listener):
    output = tmp_path / 'fitted.yaml'
    run('calibrate', session, '--output', output)
    with listener.estimator('--params-file', str(output)):
        for name in ('mass', 'friction_coefficient'):
            value = listener.estimator_parameter(f'design.{name}')
            assert value == getattr(load_design(output), name)


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        (['missing.csv'], 'missing.csv: it cannot be read'),
        (['POINT', '--fit', 'weight'], "'weight', which is no design parameter"),
        (['POINT', '--fit', ''], 'no parameter'),
        (['POINT', '--design', 'missing.yaml'], 'missing.yaml'),
        (
            ['POINT', '--fit', 'mass', '--output', '/no/such/folder/fitted.yaml'],
            'cannot be written',
        ),
        (['POINT', '--tension-stddev', '0'], "--tension-stddev: it is '0'"),
        (['POINT', '--motion-step-deg', '-1'], 'which must be above 0'),
        (['POINT', '--motion-step-deg', '1'], 'none of 1 samples is known to be slipping'),
    ],
)
def test_an_error_is_one_line_and_leaves_nothing(tmp_path, point, arguments, named):
    arguments = [str(point) if argument == 'POINT' else argument for argument in arguments]
    assert_refused(run('calibrate', *arguments), named)
    assert list(tmp_path.iterdir()) == [point]
