"""A unit's parameter file: one reading of it by `tendon-statics` and by the node."""

import math
import re

import bags
import pytest
from bags import write_bag
from forked_programs import ForkedProgram
from programs import assert_refused, run
from ros_programs import wait_for

from tendon_statics import default_design_path
from tendon_statics.files.design_file import save_design
from tendon_statics.files.installed_files import installed_config
from tendon_statics.files.unit_file import load_unit
from tendon_statics.physics import DesignError
from tendon_statics.tensions.cable_scale import CableScale

DESIGN = default_design_path().read_text().partition('    design:')[2]


@pytest.fixture
def unit(tmp_path):
    """Writes a file with these lines before the design."""

    def write(*lines, node='/**', design=DESIGN):
        path = tmp_path / 'unit.yaml'
        before = ''.join(f'    {line}\n' for line in lines)
        path.write_text(f'{node}:\n  ros__parameters:\n{before}    design:{design}')
        return path

    return write


def test_what_is_not_given_has_the_estimators_defaults(unit):
    found = load_unit(unit('cable_l.gain: 2', 'cable_s: {bias: -0.5}', 'tension_stddev: 0.02'))
    assert found.cable_l == CableScale(2.0, 0.0, 1000.0, slack_threshold=0.06)
    assert found.cable_s == CableScale(1.0, -0.5, 1000.0, slack_threshold=0.06)
    assert found.get('tension_stddev') == 0.02
    assert found.get('tension_source') is None
    assert found.unknown == []


@pytest.mark.parametrize(
    ('line', 'named'),
    [
        ('cable_l.gain: 0.0', 'cable_l.gain is 0.0'),
        ('cable_l.gain: lots', "cable_l.gain is 'lots', which is not a number"),
        ('cable_s.max_tension: -1.0', 'cable_s.max_tension is -1.0, allowed is 0.001 to'),
        ('tension_source: serial', "tension_source is 'serial', allowed is array or"),
        ('wrench_component: w', 'allowed is z or x or y or norm'),
        ('cable_names: [a]', r"cable_names is \['a'\], two different names"),
        ('cable_names: [a, a]', 'two different names'),
        ('cable_names: winch', 'two different names'),
        ('initial_bend_angle: 1.0', 'initial_bend_angle is 1.0'),
        ('max_skew: true', 'max_skew is True'),
    ],
)
def test_a_value_that_the_node_does_not_take_is_refused_in_the_same_words(unit, line, named):
    path = unit(line)
    with pytest.raises(DesignError, match=f'^{path}: .*{named}'):
        load_unit(path)


def test_the_file_of_an_arm_is_told_from_that_of_a_unit():
    with pytest.raises(DesignError, match=r'it is the file of an arm, .* tendon-statics arm'):
        load_unit(installed_config('arm.yaml'))


def test_the_node_takes_the_last_of_its_blocks_and_so_does_every_verb(unit):
    path = unit('cable_l.gain: 2.0', 'cable_s.gain: 3.0')
    path.write_text(
        path.read_text()
        + '/left/estimator:\n  ros__parameters: {cable_l.gain: 4.0, design.mass: 0.5}\n'
        + '/driver:\n  ros__parameters: {cable_l.gain: 9.0}\n'
    )
    found = load_unit(path)
    assert (found.cable_l.gain, found.cable_s.gain, found.design.mass) == (4.0, 3.0, 0.5)
    assert load_unit(path, '/driver').cable_l.gain == 9.0
    path.write_text(path.read_text() + '/right/estimator:\n  ros__parameters: {rate: 1.0}\n')
    with pytest.raises(DesignError, match=r'each of /left/estimator, /right/estimator; .*--node'):
        load_unit(path)
    assert load_unit(path, '/right/estimator').cable_l.gain == 2.0
    assert run('design', '--design', path, '--node', 'right/estimator').returncode == 0


def test_what_nobody_takes_is_named_with_what_may_be_meant(unit):
    """What another program or ROS takes from the same file is left alone, as the node does."""
    path = unit(
        *('cable_l.gian: 2.0', 'something: 1', 'rate: 20.0', 'port: 0', 'arm_name: arm'),
        *('use_sim_time: true', 'qos_overrides: {/tensions: {subscription: {depth: 5}}}'),
    )
    said = [
        'cable_l.gian is no parameter of the estimator; is cable_l.gain meant?',
        'something is no parameter of the estimator, which ignores it',
    ]
    assert load_unit(path).unknown == said
    data = path.with_name('run.csv')
    data.write_text('tension_l,tension_s\n1,1.5\n')
    for verb in ('replay', 'track'):
        done = run(verb, data, '--design', path)
        assert all(line in done.stdout + done.stderr for line in said)


OF_ROS = {
    'use_sim_time: "yes"': "use_sim_time is 'yes', but true or false is needed",
    'use_sim_time: 1': 'use_sim_time is 1, but',
    'start_type_description_service: [true]': 'start_type_description_service is [True]',
    'qos_overrides: {/tensions: {subscription: {depth: 5.0}}}': 'depth is 5.0, a whole number',
    'qos_overrides: {/tensions: {subscription: {depth: -5}}}': 'depth is -5, a whole number',
    'qos_overrides: {/tensions: {subscription: {reliability: yes}}}': 'allowed is reliable or',
}


@pytest.mark.parametrize('line', OF_ROS)
def test_what_ros_does_not_take_of_its_own_parameters_no_verb_takes(unit, line):
    with pytest.raises(DesignError) as error:
        load_unit(unit(line))
    assert OF_ROS[line] in str(error.value)


def test_the_node_refuses_the_same_values_of_ros_own_parameters(unit):
    for line in OF_ROS:
        path = unit(line)
        with ForkedProgram.running(
            'estimator', '--ros-args', '--params-file', str(path)
        ) as program:
            assert program.wait() == 1, line


AMBIGUOUS = {
    'octal': (DESIGN.replace('mass: 0.01955579994', 'mass: 010'), 'is another number to ROS, 8'),
    'hexadecimal': (DESIGN.replace('mass: 0.01955579994', 'mass: 0x1'), 'another number to ROS'),
    'twice': (DESIGN + '      mass: 0.02\n', 'mass is given a second time'),
    'twice by dots': (DESIGN + '    design.mass: 0.02\n', 'design.mass is given twice'),
}


@pytest.mark.parametrize('case', AMBIGUOUS)
def test_what_two_readers_take_for_two_things_is_refused_by_verb_and_node_alike(unit, case):
    design, named = AMBIGUOUS[case]
    assert design != DESIGN
    path = unit(design=design)
    assert_refused(run('design', '--design', path), named)
    with ForkedProgram.running('estimator', '--ros-args', '--params-file', str(path)) as program:
        assert program.wait() == 1
        line = program.output().splitlines()[-1]
    assert line.startswith(f'estimator cannot start: {path}: ')
    assert named in line


def test_a_file_for_another_node_is_refused_by_verb_and_node_alike(unit):
    path = unit(node='/winch')
    named = 'it is addressed to /winch in line 1, so /estimator takes nothing from it'
    assert_refused(run('solve', '--tension-l', 1, '--tension-s', 2, '--design', path), named)
    assert run('design', '--design', path, '--node', '/winch').returncode == 0
    with ForkedProgram.running('estimator', '--ros-args', '--params-file', str(path)) as program:
        assert program.wait() == 1
        assert named in program.output().splitlines()[-1]


def test_design_says_that_a_file_is_for_an_estimator_in_another_place(unit):
    path = unit('tension_stdev: 0.1', node='/left/estimator')
    done = run('design', '--design', path)
    assert done.returncode == 0
    misspelt, addressed = done.stderr.splitlines()
    assert 'is tension_stddev meant?' in misspelt
    assert f'{path}: it is addressed to /left/estimator in line 1 alone' in addressed
    assert run('design', '--design', path, '--node', '/left/estimator').stderr == f'{misspelt}\n'
    assert run('design', '--design', unit()).stderr == ''


def test_a_file_for_an_estimator_in_a_namespace_is_taken(unit):
    assert load_unit(unit('cable_l.gain: 2.0', node='/left/estimator')).cable_l.gain == 2.0


def test_what_a_file_says_beside_the_design_is_written_again(unit, tmp_path):
    lines = (
        'cable_names: [a, "no"]',
        'cable_l.gain: 1.0e-05',
        'markers: true',
        'limits: [1.5, .inf, -.inf]',
        'tension_stddev: 1',
    )
    before = load_unit(unit(*lines))
    path = tmp_path / 'copy.yaml'
    save_design(path, before.design, 'a copy', before.parameters)
    assert load_unit(path) == before


RAW = (
    'time,tension_l,tension_s\n0,1100,2000\n0.1,1100,1500\n0.2,1100,-50\n'
    '0.3,1100,9000\n0.4,nan,1\n'
)
GAINS = (
    *('cable_l.gain: 0.001', 'cable_s.gain: 0.001', 'cable_l.bias: -0.1'),
    *(
        'cable_s.max_tension: 5.0',
        'tension_source: joint_state',
        'cable_names: [winch_l, winch_s]',
    ),
)
FAULTS = ['valid', 'valid', 'negative', 'implausible', 'not finite']


@pytest.mark.parametrize('ending', ['csv', 'mcap'])
def test_replay_takes_a_units_file_as_the_node_does_and_says_so(unit, tmp_path, ending):
    path = unit(*GAINS)
    data = tmp_path / 'run.csv'
    data.write_text(RAW)
    if ending == 'mcap':
        names = ['winch_l', 'winch_s']
        rows = [
            (0.001 * i, *map(float, row.split(',')[1:])) for i, row in enumerate(RAW.split()[1:])
        ]
        messages = [
            ('/tensions', time, bags.joint_state(names, effort=pair, time=time))
            for time, *pair in rows
        ]
        data = write_bag(tmp_path / 'bag', messages)
    output = tmp_path / 'out.csv'
    done = run('replay', data, '--design', path, '--output', output)
    assert done.returncode == 0, done.stderr
    assert 'cable_l: tension = 0.001 · reading -0.1 N, of the design file' in done.stdout
    assert 'invalid       implausible 1, negative 1, not finite 1\n' in done.stdout
    rows = [line.split(',') for line in output.read_text().splitlines()]
    columns = dict(zip(rows[0], zip(*rows[1:], strict=True), strict=True))
    assert list(columns['validity']) == FAULTS
    assert [float(value) for value in columns['tension_l'][:4]] == pytest.approx([1.0] * 4)
    assert columns['reading_l'][0] == '1100.0'
    assert columns['regime'][:2] == ('equilibrium', 'held')
    # Read again with the same file, gains do not apply a second time.
    again = run('replay', output, '--design', path)
    assert 'not applied: the tensions were recorded in N' in again.stdout
    assert 'regimes       invalid 3 (60 %), equilibrium 1' in again.stdout


@pytest.mark.parametrize('verb', ['track', 'report', 'calibrate'])
def test_the_other_verbs_apply_and_say_the_same(unit, tmp_path, verb):
    data, output = tmp_path / 'run.csv', tmp_path / 'out.html'
    data.write_text('tension_l,tension_s,bend_angle\n1100,2000,0.3\n1100,-2000,-0.3\n')
    options = {'report': ('--output', output), 'calibrate': ('--fit', 'mass')}.get(verb, ())
    done = run(verb, data, '--design', unit(*GAINS), *options)
    assert done.returncode == 0, done.stderr
    said = done.stdout + done.stderr + (output.read_text() if output.exists() else '')
    assert 'cable_l: tension = 0.001 · reading -0.1 N, of the design file' in said
    if verb == 'track':
        assert done.stdout.splitlines()[1].startswith('1.0,2.0,0')
    if verb == 'calibrate':
        assert 'of invalid tensions: 1' in done.stdout


def test_tensions_that_are_marked_as_newtons_are_left_as_they_are(unit, tmp_path):
    data = tmp_path / 'run.csv'
    data.write_text('tension_l [mN],tension_s [N]\n1000,2\n')
    done = run('track', data, '--design', unit(*GAINS))
    assert done.stdout.splitlines()[1].startswith('1.0,2.0,')
    assert 'gain and bias of cable_l and cable_s in the design file are not applied' in done.stderr


def test_estimation_and_noise_of_the_file_are_taken_unless_an_option_says_otherwise(
    unit, tmp_path
):
    data = tmp_path / 'run.csv'
    data.write_text('tension_l,tension_s\n1,2\n')
    path = unit('estimation: tracking', 'initial_bend_angle: 0.25', 'tension_stddev: 0.05')
    done = run('track', data, '--design', path)
    assert float(done.stdout.splitlines()[1].split(',')[2]) == 0.25
    assert 'estimation    tracking\n' in run('replay', data, '--design', path).stdout
    said = run('replay', data, '--design', path, '--estimation', 'equilibrium').stdout
    assert 'estimation    equilibrium\n' in said
    assert math.isfinite(load_unit(path).get('tension_stddev'))


def test_a_fitted_file_keeps_what_the_start_says_of_the_cables(unit, tmp_path):
    import numpy as np
    from slips import TRUTH, slipping_samples

    rows = slipping_samples(12, np.random.default_rng(3), TRUTH)
    data, output = tmp_path / 'run.csv', tmp_path / 'fitted.yaml'
    lines = [
        f'{(at_l + 0.1) / 0.001!r},{at_s / 0.001!r},{angle!r},{p!r}'
        for at_l, at_s, angle, p in rows.tolist()
    ]
    data.write_text('tension_l,tension_s,bend_angle,pressure\n' + '\n'.join(lines) + '\n')
    start = unit(*GAINS)
    done = run('calibrate', data, '--design', start, '--output', output)
    assert done.returncode == 0, done.stderr
    fitted, before = load_unit(output), load_unit(start)
    assert (fitted.cable_l, fitted.cable_s) == (before.cable_l, before.cable_s)
    assert fitted.get('cable_names') == ['winch_l', 'winch_s']
    assert fitted.design.mass == pytest.approx(TRUTH.mass, rel=1e-3)


def test_the_text_of_a_number_is_taken_for_it_as_by_the_node(unit):
    """Which `ros2 param set` sends, and which a file may have in quotes."""
    path = unit('tension_stddev: "2e-2"', 'cable_l.gain: "1e-3"', 'joint_name: "7"')
    path.write_text(re.sub('mass: .*', 'mass: "0.0196"', path.read_text()))
    taken = load_unit(path)
    assert (taken.design.mass, taken.cable_l.gain) == (0.0196, 0.001)
    assert taken.settings.tension_stddev == 0.02
    assert taken.parameters['joint_name'] == '7'
    with ForkedProgram.running('estimator', '--ros-args', '--params-file', str(path)) as program:
        wait_for('it to be ready', lambda: 'Ready: ' in program.output())
