"""``tendon-statics`` as a program: output, exit codes, one-line errors."""

import csv
import json
import math
import subprocess
import sys
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path

import pytest
from designs import PRELIMINARY
from make_docs import ROOT
from programs import PROGRAM, TIME_LIMIT, assert_refused, run, run_installed

from tendon_statics import default_design_path, solve
from tendon_statics.command_line.main import VERBS
from tendon_statics.files.installed_files import installed_config
from tendon_statics.physics import admissible_angles

CASE = ['solve', '--tension-l', '1', '--tension-s', '2']


def test_solve_as_text_gives_the_published_case():
    done = run_installed(*CASE)
    assert done.returncode == 0
    assert done.stderr == ''
    assert '17.1400 deg' in done.stdout
    assert '405.6000 Pa' in done.stdout
    assert 'equilibrium' in done.stdout


def test_solve_as_json_has_the_fields_of_equilibrium():
    done = run(*CASE, '--format', 'json')
    answer = json.loads(done.stdout)
    equilibrium = solve(PRELIMINARY, 1.0, 2.0)
    expected = equilibrium.as_dict()
    assert {key: answer[key] for key in expected} == json.loads(json.dumps(expected))
    assert list(answer) == [
        *('contact_law', 'load'),
        *expected,
        *('bend_angle_derivatives', 'pressure_derivatives'),
    ]
    assert answer['contact_law'] == 'merged'
    assert answer['load']['base_tilt'] == 0.0
    for name in ('bend_angle_derivatives', 'pressure_derivatives'):
        assert answer[name] == getattr(equilibrium, name)
    assert math.degrees(answer['bend_angle']) == pytest.approx(17.14, abs=1e-5)


def test_what_is_not_determined_is_null_in_json_and_left_out_in_text():
    tensions = ('solve', '--tension-l', '1', '--tension-s', '1.5')
    answer = json.loads(run(*tensions, '--format', 'json').stdout)
    assert answer['regime'] == 'held'
    assert answer['bend_angle'] is None
    text = run(*tensions)
    assert text.returncode == 0
    assert 'held' in text.stdout
    assert 'deg' not in text.stdout


def test_a_design_file_is_used(tmp_path):
    path = tmp_path / 'unit.yaml'
    text = default_design_path().read_text().replace('max_bend_angle: 0.5', 'max_bend_angle: 0.4')
    path.write_text(text)
    stop = ('solve', '--tension-l', '1', '--tension-s', '3', '--format', 'json')
    one, other = (
        json.loads(run(*stop, *more).stdout)['bend_angle']
        for more in ((), ('--design', str(path)))
    )
    assert one - other == pytest.approx(0.1)


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        ([], 'VERB'),
        (['tie'], 'tie'),
        (['solve', '--tension-l', '1'], '--tension-s'),
        (['solve', '--tension-l', 'one', '--tension-s', '2'], "'one'"),
        (['solve', '--tension-l', 'nan', '--tension-s', '2'], 'nan'),
        (['solve', '--tension-l', '-1', '--tension-s', '2'], '-1.0'),
        (['solve', '--tension-l', '0.05', '--tension-s', '0.1'], 'weight'),
        ([*CASE, '--design', 'missing.yaml'], 'missing.yaml'),
        ([*CASE, '--format', 'xml'], 'xml'),
        *(
            ([*CASE, f'--tension-stddev={value}'], f"--tension-stddev: it is '{value}'")
            for value in ('0', '-0.01', 'nan', 'inf', 'some')
        ),
        (['plot', 'residual', '--output', 'figure.doc'], 'figure.doc'),
        (['plot', 'residual', '--output', '/no/such/folder/figure.svg'], 'cannot be written'),
        (['plot'], 'FIGURE'),
        (['plot', 'residual', '--tension-l', '0', '--output', 'figure.svg'], 'slack'),
        (['paper', '--section', 'none'], 'none'),
        (['track', 'missing.csv'], 'missing.csv'),
        (['invert', '--bend-angle', '0.1'], '--total-tension'),
        (['invert', '--bend-angle', '3', '--pressure', '400'], 'bend_angle is 3.0'),
        (['invert', '--bend-angle', '0.1', '--pressure', '-4'], 'pressure is -4.0'),
        (['admissible', '--tension-l', '0', '--tension-s', '1'], 'slack'),
    ],
)
def test_an_error_is_one_line_and_exit_code_2(arguments, named):
    assert_refused(run(*arguments), named)


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        ([], 'VERB'),
        (['solve', '--tension-l', '-1', '--tension-s', '2'], '-1.0'),
        (['plot', 'residual', '--output', '/no/such/folder/figure.svg'], 'cannot be written'),
    ],
)
def test_so_it_is_of_the_installed_program(arguments, named):
    assert_refused(run_installed(*arguments), named)


def test_admissible_prints_the_intervals():
    tensions = ('admissible', '--tension-l', '1', '--tension-s')
    assert '-30.0000 deg to +17.1400 deg' in run(*tensions, '2').stdout
    assert 'none' in run(*tensions, '3').stdout
    answer = json.loads(run(*tensions, '2', '--format', 'json').stdout)
    assert [tuple(pair) for pair in answer['admissible_angles']] == admissible_angles(
        PRELIMINARY, 1.0, 2.0
    )
    assert run(*tensions, '0').returncode == 2


@pytest.mark.parametrize(
    'load', [('--pressure', '405.6'), ('--total-tension', '3')], ids=lambda load: load[0]
)
def test_invert_gives_the_tensions_back(load):
    done = run('invert', '--bend-angle-deg', '17.14', *load, '--format', 'json')
    assert list(json.loads(done.stdout).values()) == pytest.approx([1.0, 2.0], abs=1e-8)
    assert '1.000000' in run('invert', '--bend-angle-deg', '17.14', *load).stdout


def test_track_follows_a_file_with_memory(tmp_path):
    path = tmp_path / 'run.csv'
    rows = ['0.0,1.0,1.5', '0.1,1.0,3.0', '0.2,nan,3.0', '0.3,1.0,1.5', '0.4,0.0,1.5', '0.5,1,1.5']
    path.write_text('time,tension_l,tension_s\n' + '\n'.join(rows) + '\n')
    done = run('track', str(path), '--initial-bend-angle', '0.1')
    assert done.stderr.count('\n') == 1
    assert 'counts as slack up to 0.03 N' in done.stderr
    assert 'tensions up to 1000 N are believed' in done.stderr
    table = list(csv.DictReader(done.stdout.splitlines()))
    stop = str(PRELIMINARY.max_bend_angle)
    assert [row['bend_angle'] for row in table] == ['0.1', stop, '', stop, '', stop]
    assert [row['regime'] for row in table] == [
        *('held', 'driven_to_stop', 'invalid', 'held', 'slack', 'held')
    ]
    assert [row['time'] for row in table] == ['0.0', '0.1', '0.2', '0.3', '0.4', '0.5']
    assert [row['angle_assured'] for row in table] == [
        *('True', 'True', 'False', 'False', 'False', 'False')
    ]
    assert -1.0 < float(table[0]['slip_margin']) < 1.0 < float(table[1]['slip_margin'])


def test_help_names_every_verb():
    done = run_installed('--help')
    assert done.returncode == 0
    for verb in VERBS:
        assert verb in done.stdout
        assert run(verb, '--help').returncode == 0


def test_design_shows_what_else_is_set_and_names_what_is_ignored(tmp_path):
    file = tmp_path / 'unit.yaml'
    text = (ROOT / 'config/preliminary_design.yaml').read_text(encoding='utf-8')
    values = ('estimation: filtering', 'tension_stddev: 0.02', 'colour: red', 'input_timout: 1.0')
    more = ''.join(f'    {value}\n' for value in values)
    file.write_text(text.replace('ros__parameters:\n', f'ros__parameters:\n{more}', 1))
    done = run('design', '--design', file)
    assert done.returncode == 0
    assert 'The file is sound: estimation filtering, noise of 0.02 N' in done.stdout
    assert 'colour is no parameter of the estimator, which ignores it' in done.stderr
    assert 'is input_timeout meant?' in done.stderr
    assert 'nobody gave' not in done.stdout
    file.write_text(file.read_text(encoding='utf-8').replace('tension_stddev: 0.02', ''))
    unsaid = 'noise of 0.01 N on each tension, which nobody gave: set tension_stddev'
    assert unsaid in run('design', '--design', file).stdout


def test_design_shows_every_value():
    shown = run('design').stdout
    for name, value in asdict(PRELIMINARY).items():
        assert f'`design.{name}`' in shown
        assert (value if isinstance(value, str) else f'{value:.7g}') in shown


SVGS = {'residual': (), 'unit': (), 'hysteresis': (), 'map': ('--points', '31')}
"""Figures and their options"""


@pytest.fixture(scope='module')
def installed_svgs(tmp_path_factory):
    """All figures as the installed program draws them, in one process with other hashes."""
    folder = tmp_path_factory.mktemp('svgs')
    calls = [
        ['plot', figure, '--output', str(folder / f'{figure}.svg'), *options]
        for figure, options in SVGS.items()
    ]
    code = (
        'import runpy, sys\n'
        f'for call in {calls!r}:\n'
        '    sys.argv[1:] = call\n'
        '    try:\n'
        f'        runpy.run_path({PROGRAM[0]!r}, run_name="__main__")\n'
        '    except SystemExit as end:\n'
        '        assert not end.code, call\n'
    )
    subprocess.run([sys.executable, '-c', code], check=True, timeout=TIME_LIMIT, cwd=folder)
    return folder


@pytest.mark.parametrize(
    ('figure', 'ending'),
    [
        *(('residual', ending) for ending in ('svg', 'png', 'pdf')),
        *((figure, 'svg') for figure in ('unit', 'hysteresis', 'map')),
    ],
)
def test_a_figure_is_written_the_same_each_time(request, tmp_path, figure, ending):
    files = [tmp_path / f'{i}.{ending}' for i in range(2)]
    if ending == 'svg':
        # In two ways, so that what is compared does not depend on the order of sets either.
        files[1] = request.getfixturevalue('installed_svgs') / f'{figure}.svg'
    for file in files:
        if not file.exists():
            done = run('plot', figure, '--output', str(file), *SVGS[figure])
            assert done.returncode == 0, done.stderr
        assert file.stat().st_size > 2000
    if ending == 'svg':
        assert files[0].read_bytes() == files[1].read_bytes()


def test_a_reader_that_stops_reading_is_no_error():
    done = subprocess.run(
        ['bash', '-c', f'{" ".join(PROGRAM)} design | head -n 1; echo ${{PIPESTATUS[0]}}'],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT,
        check=True,
    )
    assert done.stdout.splitlines()[-1] == '0'
    assert done.stderr == ''


def test_an_output_that_cannot_be_written_is_an_error_in_one_line():
    with Path('/dev/full').open('w') as full:
        done = subprocess.run(
            [*PROGRAM, *CASE], stdout=full, stderr=subprocess.PIPE, text=True, check=False
        )
    assert done.returncode == 2
    assert done.stderr.count('\n') == 1
    assert 'No space left' in done.stderr


@pytest.mark.parametrize(
    ('library', 'arguments'),
    [
        ('scipy', ['calibrate', 'config/published_point.csv']),
        ('scipy', ['report', 'config/published_point.csv', '--output', 'report.html']),
        ('mcap', ['replay', 'config/recorded_session.mcap']),
        ('rosbags', ['replay', 'config/recorded_session.mcap']),
        ('pyarrow', ['sweep', '--points', '3', '--output', 'map.parquet']),
        ('matplotlib', ['plot', 'residual', '--output', 'figure.svg']),
    ],
)
def test_a_library_that_is_missing_is_named_with_what_to_install(tmp_path, library, arguments):
    code = (
        f'import sys; sys.modules[{library!r}] = None\n'
        'from tendon_statics.command_line.main import main\n'
        f'sys.exit(main({[str(ROOT / a) if "/" in a else a for a in arguments]!r}))'
    )
    done = subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=False, cwd=tmp_path
    )
    assert_refused(done, f'pip install {library}')
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    'arguments', [('--version',), ('solve', '--version'), ('--version', 'plot', 'residual')]
)
def test_the_version_is_the_packages(arguments):
    assert run_installed(*arguments).stdout == f'tendon-statics {version("tendon_statics")}\n'


ARM = (installed_config('arm.yaml'), installed_config('arm_tensions.csv'))


def test_options_count_in_every_place(tmp_path):
    design = ('--design', str(default_design_path()))
    usual = run(*CASE, *design).stdout
    assert run(*design, *CASE).stdout == run('--tension-l=1', *CASE, *design).stdout == usual
    # Though the file is called as a verb.
    named_as_a_verb = tmp_path / 'paper'
    named_as_a_verb.write_text(default_design_path().read_text())
    assert run('--design', str(named_as_a_verb), *CASE).stdout == usual
    assert run('--help', 'solve').stdout == run('solve', '--help').stdout
    figure = tmp_path / 'figure.svg'
    assert run('--output', str(figure), 'plot', *design, 'residual').returncode == 0
    assert figure.exists()
    for verb, word in (('plot', 'unit'), ('arm', 'track')):
        for asked in (('--help', verb, word), (verb, '--help', word), (verb, word, '--help')):
            assert run(*asked).stdout.startswith(f'usage: tendon-statics {verb} {word}')
    tilt = ('--base-tilt-deg', '20')
    (tilted, *others) = (
        run(*tilt, 'arm', 'track', *ARM).stdout,
        run('arm', *tilt, 'track', *ARM).stdout,
        run('arm', 'track', *ARM, *tilt).stdout,
    )
    assert others == [tilted, tilted] != [run('arm', 'track', *ARM).stdout] * 2


RECORDING = installed_config('recorded_session.mcap')


@pytest.mark.parametrize(
    ('arguments', 'name'),
    [
        (('plot', 'unit'), 'unit.svg'),
        (('arm', 'plot', *ARM), 'arm.svg'),
        (('sweep', '--points', '3'), 'map.csv'),
        (('replay', RECORDING), 'replay.csv'),
        (('calibrate', RECORDING, '--motion-step-deg', '3'), 'fitted.yaml'),
        (('report', RECORDING, '--motion-step-deg', '3'), 'report.html'),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else '',
)
def test_every_verb_that_writes_says_so(arguments, name, tmp_path):
    done = run(*arguments, '--output', tmp_path / name)
    assert done.returncode == 0, done.stderr
    assert f'wrote {tmp_path / name}\n' in done.stdout


def test_where_json_is_printed_it_is_alone_and_what_was_written_is_said_beside_it(tmp_path):
    path = tmp_path / 'slack.csv'
    rows = (f'{0.01 * index},{0.001 * (-1) ** index},0.002' for index in range(50))
    path.write_text('\n'.join(['time,tension_l,tension_s', *rows]))
    output = tmp_path / 'unit.yaml'
    assert f'wrote {output}\n' in run('tare', path, '--output', output).stdout
    done = run('tare', path, '--output', output, '--format', 'json')
    assert 'cable_l.bias' in json.loads(done.stdout)
    assert done.stderr.endswith(f'wrote {output}\n')


def test_the_physics_needs_neither_ros_nor_files_nor_the_command_line():
    """It is imported alone, with all of these made to fail."""
    barred = ['rclpy', 'yaml', 'std_msgs', 'argparse', 'json', 'numpy', 'scipy', 'matplotlib']
    code = (
        f'import sys; sys.modules.update(dict.fromkeys({barred!r}))\n'
        'from tendon_statics.physics import JointDesign, solve\n'
        'ours = [name for name in sys.modules if name.startswith("tendon_statics.")]\n'
        'assert not [n for n in ours if ".node" in n or ".command_line" in n], ours\n'
    )
    subprocess.run([sys.executable, '-c', code], check=True, timeout=TIME_LIMIT)
