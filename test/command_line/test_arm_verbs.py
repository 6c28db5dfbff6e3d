"""``tendon-statics arm``: output, exit codes, one-line errors."""

import csv
import io
import json
import math

import pytest
from make_docs import ROOT
from programs import assert_refused, run, run_installed

from tendon_statics import ArmTracker, Load, arm_margins, arm_tip_force, load_arm

FILE = ROOT / 'config/arm.yaml'
TABLE = ROOT / 'config/arm_tensions.csv'
ARM = load_arm(FILE)
EVEN = {'l_mid': 1.0, 's_mid': 1.0, 'l_tip': 1.0, 's_tip': 1.5}
RANGE = ('--side', 's', '--tension-range', 1, 6)
TENSIONS = [f'{name}={tension}' for name, tension in EVEN.items()]


def test_track_follows_the_arm_row_by_row():
    done = run_installed('arm', 'track', FILE, TABLE)
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    tracker = ArmTracker(ARM)
    given = [line for line in TABLE.read_text(encoding='utf-8').splitlines() if line[0] != '#']
    assert len(rows) == len(given) - 1
    for row in rows:
        state = tracker.update({name: float(row[name]) for name in ARM.cable_names})
        assert float(row['tip_x']) == state.tip.x
        for number, joint in enumerate(state.joints, start=1):
            assert float(row[f'estimated_bend_angle_{number}']) == joint.bend_angle
            assert row[f'regime_{number}'] == joint.regime.value
    assert rows[-1]['time'] == '27.0'


def test_margins_are_those_of_the_library_under_the_load_that_is_said():
    options = (
        '--bend-angles-deg',
        5,
        0,
        0,
        -5,
        0,
        '--base-tilt-deg',
        20,
        '--tip-force',
        0.1,
        -0.1,
    )
    done = run('arm', 'margins', FILE, '--tensions', *TENSIONS, *options, '--format', 'json')
    angles = [math.radians(degrees) for degrees in (5.0, 0.0, 0.0, -5.0, 0.0)]
    expected = arm_margins(ARM, angles, EVEN, Load.tilted(math.radians(20.0), (0.1, -0.1)))
    assert json.loads(done.stdout)['slip_margins'] == list(expected)


def test_margins_say_in_words_what_slips():
    text = run('arm', 'margins', FILE, '--tensions', *TENSIONS).stdout
    assert text.count('held') == 3
    assert text.count('slips to s') == 2


PUSHED = ('tip-force', FILE, '--tensions', *TENSIONS, '--direction', 1, 0)


def test_tip_force_prints_the_set_of_the_library():
    options = ('--bend-angles-deg', 5, 0, 0, 0, 30, '--at-stop', 5, '--tip-force', 0.01, 0)
    found = json.loads(run('arm', *PUSHED, *options, '--format', 'json').stdout)
    angles = [math.radians(degrees) for degrees in (5.0, 0.0, 0.0, 0.0, 30.0)]
    expected = arm_tip_force(
        *(ARM, EVEN),
        bend_angles=angles,
        direction=(1.0, 0.0),
        load=Load(tip_force=(0.01, 0.0)),
        at_stop=[5],
    )
    assert found['intervals'] == [list(one) for one in expected.intervals]
    assert found['bounding_joints'] == [list(one) for one in expected.bounding_joints]
    assert len(found['joint_intervals']) == 5
    along = ('tip-force', FILE, '--tensions', *TENSIONS, '--direction', 0, -1)
    ray = json.loads(run('arm', *along, '--format', 'json').stdout)
    assert ray['intervals'][0][1] is ray['bounding_joints'][0][1] is None


def test_tip_force_widens_the_set_by_noise_where_that_is_said():
    noise = ('--tension-stddev', 0.02, '--bend-angle-stddev-deg', 0.5, '--level', 0.9)
    found = json.loads(run('arm', *PUSHED, *noise, '--format', 'json').stdout)
    expected = arm_tip_force(
        *(ARM, EVEN),
        bend_angles=[0.0] * 5,
        direction=(1.0, 0.0),
        tension_stddev=0.02,
        bend_angle_stddev=math.radians(0.5),
        level=0.9,
    )
    assert found['intervals'] == [list(one) for one in expected.intervals]
    assert found['intervals'] != found['exact_intervals']
    assert found['probability_free'] == expected.probability_free
    text = run('arm', *PUSHED, *noise).stdout
    assert 'at 90 %' in text
    assert 'at 90 %' not in run('arm', *PUSHED).stdout


def test_tip_force_of_a_joint_that_slips_is_a_number():
    slips = ('--slipping', '4=s', '--tension-stddev', 0.02)
    found = json.loads(run('arm', *PUSHED, *slips, '--format', 'json').stdout)
    expected = arm_tip_force(
        *(ARM, EVEN),
        bend_angles=[0.0] * 5,
        direction=(1.0, 0.0),
        slipping={4: 's'},
        tension_stddev=0.02,
    )
    assert found['at_limit']
    assert found['force'] == expected.force
    assert found['force_stddev'] == expected.force_stddev
    text = run('arm', *PUSHED, *slips).stdout
    assert f'force         {expected.force:+.4f} N, deviation' in text
    refused = run('arm', *PUSHED, '--slipping', '1=x')
    assert "it is '1=x', needed is N=SIDE" in refused.stderr


def test_tip_force_takes_how_well_designs_are_known_from_their_files(tmp_path):
    design = (FILE.parent / 'preliminary_design.yaml').read_text(encoding='utf-8')
    uncertain = (
        '    design_uncertainty:\n'
        '      parameters: [friction_coefficient]\n'
        '      covariance: [0.01]\n'
    )
    (tmp_path / 'exact.yaml').write_text(design, encoding='utf-8')
    (tmp_path / 'fitted.yaml').write_text(design + uncertain, encoding='utf-8')
    cables = '[{name: l, side: l, last_unit: 2}, {name: s, side: s, last_unit: 2}]'
    found = []
    for name in ('exact', 'fitted'):
        arm = tmp_path / f'{name}_arm.yaml'
        units = ', '.join(2 * [f'{{design_file: {name}.yaml, length: 0.02}}'])
        arm.write_text(f'units: [{units}]\ncables: {cables}\n', encoding='utf-8')
        asked = ('tip-force', arm, '--tensions', 'l=1', 's=1.2', *PUSHED[-3:])
        done = run('arm', *asked, '--slipping', '1=s')
        assert ('the uncertainty of the designs' in done.stdout) == (name == 'fitted')
        printed = run('arm', *asked, '--slipping', '1=s', '--format', 'json').stdout
        found.append(json.loads(printed))
    exact, fitted = found
    assert fitted['force'] == exact['force']
    assert exact['force_stddev'] == 0.0
    assert fitted['force_stddev'] > 0.01


def test_tip_force_says_which_joint_bounds_the_set_where():
    text = run('arm', *PUSHED[:-2], 0, -1).stdout
    assert 'explained by  any force from' in text
    assert 'bounded by    joint 5 below\n' in text
    angles = ('--bend-angles-deg', 30, 30, 30, -30, -30)
    assert 'no force: the model does not explain this state' in run('arm', *PUSHED, *angles).stdout


def test_order_and_invert_print_what_they_find():
    end = [*TENSIONS[:3], 's_tip=2.4']
    order = run('arm', 'order', FILE, '--start', *TENSIONS[:3], 's_tip=1', '--end', *end)
    rows = [line.split('|')[1].strip() for line in order.stdout.splitlines()[2:]]
    assert rows == ['5', '4', '3', '2', '1']
    found = run('arm', 'invert', FILE, '--joint', 5, *RANGE)
    assert '+1.0000' in found.stdout
    assert found.returncode == 0


@pytest.mark.parametrize('ending', ['svg', 'png'])
def test_plot_draws_the_arm(tmp_path, ending):
    figure = tmp_path / f'arm.{ending}'
    done = run('arm', 'plot', FILE, TABLE, '--output', figure)
    assert done.returncode == 0, done.stderr
    assert figure.stat().st_size > 10_000


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        (['margins', 'none.yaml', '--tensions', *TENSIONS], 'none.yaml: it cannot be read'),
        (['margins', FILE, '--tensions', *TENSIONS[1:]], 'the tension of cable l_mid is missing'),
        (['margins', FILE, '--tensions', *TENSIONS, 'x=1'], "there is no cable 'x'"),
        (['margins', FILE, '--tensions', *TENSIONS, TENSIONS[0]], 'is given twice'),
        (['margins', FILE, '--tensions', 'l_mid'], 'needed is CABLE=N'),
        (['margins', FILE, '--tensions', *TENSIONS, '--bend-angles-deg', '1'], 'has 5 joints'),
        (['margins', FILE, '--tensions', 'l_mid=1,5'], 'decimals take a point: l_mid=1.5'),
        (['track', FILE, 'none.csv'], 'none.csv: it cannot be read'),
        (['replay', FILE, TABLE, '--output', 'arm.txt'], 'arm.txt: a replay of an arm is written'),
        (['replay', FILE, TABLE, '--output', TABLE], 'it is the recording itself'),
        (['report', FILE, TABLE, '--output', 'arm.pdf'], 'a report is written to'),
        (['replay', FILE, TABLE, '--columns', 'tension_l=a'], "'tension_l' is no quantity"),
        (['replay', FILE, TABLE, '--tension-stddev', '0'], 'allowed is a finite number above 0'),
        (['replay', FILE, TABLE, '--parameters', FILE], 'arm.yaml: '),
        (['invert', FILE, '--joint', 9, *RANGE], 'joints 1 to 5'),
        (['invert', FILE, '--joint', 1, *RANGE], 'slips before'),
        ([*PUSHED[:-2], 1, 1], 'a unit vector is needed'),
        ([*PUSHED[:-2], 0, 1, 0], 'out of the plane of bending'),
        ([*PUSHED, '--at-stop', 6], 'joints 1 to 5'),
        (['plot', FILE, TABLE, '--output', 'arm.txt'], 'arm.txt: a figure is written to'),
    ],
)
def test_errors_are_one_line(arguments, named):
    assert_refused(run('arm', *arguments), named)


HEADER = 'l_mid,s_mid,l_tip,s_tip\n'


@pytest.mark.parametrize(
    ('text', 'named'),
    [
        ('', 'there is no column l_mid'),
        (HEADER, 'there is no row'),
        ('l_mid,s_mid,l_tip\n1,1,1\n', 'there is no column s_tip'),
        (f'l_mid,{HEADER}1,1,1,1,1\n', 'there are two columns of l_mid'),
        ('L_mid,s_mid,l_tip,s_tip\n1,1,1,1\n', "'L_mid', which would be overlooked"),
        ('l_mid [kg],s_mid,l_tip,s_tip\n1,1,1,1\n', 'the unit of l_mid'),
    ],
)
def test_a_table_that_is_none_is_refused_with_its_place(tmp_path, text, named):
    path = tmp_path / 'tensions.csv'
    path.write_text(text, encoding='utf-8')
    assert_refused(run('arm', 'track', FILE, path), named)


def rows_of(done):
    assert done.returncode in (0, 1), done.stderr
    return list(csv.DictReader(io.StringIO(done.stdout)))


def test_a_slack_arm_leaves_its_fields_empty(tmp_path):
    path = tmp_path / 'tensions.csv'
    path.write_text(f'{HEADER}1,1,0,1\n2,2,2,2\n', encoding='utf-8')
    first, second = rows_of(run('arm', 'track', FILE, path))
    assert first['regime_1'] == 'slack'
    assert first['estimated_bend_angle_1'] == first['tip_x'] == ''
    assert second['angle_assured_1'] == 'False'
    assert second['tip_x_stddev'] == ''


def test_a_row_that_is_not_valid_says_why_and_casts_doubt(tmp_path):
    path = tmp_path / 'tensions.csv'
    path.write_text(f'{HEADER}1,1,1,1\n1,1,1,-1\n1,1,nan,1\n1,1,1,1\nx,1,1,1\n')
    done = run('arm', 'track', FILE, path)
    rows = rows_of(done)
    assert [row['validity'] for row in rows] == ['valid', 'negative', 'not finite', 'valid']
    assert [row['regime_3'] for row in rows] == ['held', 'invalid', 'invalid', 'held']
    assert [row['angle_assured_3'] for row in rows] == ['True', 'False', 'False', 'False']
    assert done.returncode == 1
    assert 'line 6' in done.stderr


def german(path, *more):
    """The load cycle as a German spreadsheet writes it, with columns of constant value."""
    lines = [line for line in TABLE.read_text().splitlines() if not line.startswith('#')]
    titles = 'Zeit;Fz1;s_mid [mN];l_tip;s_tip'
    rows = [line.split(',') for line in lines[1:]]
    for row in rows:
        row[2] = f'{1000.0 * float(row[2]):.1f}'
    text = [';'.join([titles, *(title for title, _ in more)])]
    text += [';'.join([*row, *(value for _, value in more)]).replace('.', ',') for row in rows]
    path.write_text('\n'.join(text) + '\n', encoding='utf-8')
    return path


def test_a_german_table_with_other_titles_and_units_is_the_same_arm(tmp_path):
    path = german(tmp_path / 'messung.csv', ('Bemerkung', 'gut'))
    read = ('--columns', 'time=Zeit,l_mid=Fz1')
    rows, plain = (
        rows_of(run('arm', 'track', FILE, path, *read)),
        rows_of(run('arm', 'track', FILE, TABLE)),
    )
    assert len(rows) == len(plain)
    for row, other in zip(rows, plain, strict=True):
        assert float(row['tip_x']) == pytest.approx(float(other['tip_x']), abs=1e-9)
        assert row['regime_1'] == other['regime_1']


def test_measured_angles_are_compared_joint_by_joint(tmp_path):
    path = german(tmp_path / 'run.csv', ('bend_angle_1 [deg]', '3.5'), ('bend_angle_5', '0.1'))
    read = ('--columns', 'time=Zeit,l_mid=Fz1', '--output', tmp_path / 'out.csv')
    done = run('arm', 'replay', FILE, path, *read)
    assert 'decimals are written with a comma' in done.stdout
    table = [[cell.strip() for cell in line.split('|')] for line in done.stdout.splitlines()]
    titles = next(cells for cells in table if 'rms error [deg]' in cells)
    errors = {
        cells[1]: cells[titles.index('rms error [deg]')]
        for cells in table
        if len(cells) == len(titles)
    }
    with (tmp_path / 'out.csv').open() as file:
        rows = list(csv.DictReader(file))
    off = [float(row['estimated_bend_angle_5']) - 0.1 for row in rows]
    rms = math.degrees(math.sqrt(sum(value**2 for value in off) / len(off)))
    assert float(errors['5']) == pytest.approx(rms, rel=1e-2)
    assert errors['1'] != '-'
    assert errors['2'] == '-'
    assert float(rows[0]['bend_angle_1']) == pytest.approx(math.radians(3.5))


def test_a_gap_in_time_casts_doubt_until_a_stop(tmp_path):
    path = tmp_path / 'gap.csv'
    path.write_text(f'time,{HEADER}0,1,1,1,1\n0.1,1,1,1,1\n3,1,1,1,1\n3.1,1,1,1,2.4\n')
    rows = rows_of(run('arm', 'track', FILE, path))
    assert [row['angle_assured_1'] for row in rows] == ['True', 'True', 'False', 'True']
    assert rows[3]['regime_1'] == 'driven_to_stop'


def test_the_parameter_file_of_the_node_says_how_cables_are_measured(tmp_path):
    table, parameters = tmp_path / 'counts.csv', tmp_path / 'parameters.yaml'
    table.write_text(f'{HEADER}100,100,100,250\n100,100,100,950\n')
    parameters.write_text(
        'arm_estimator:\n  ros__parameters:\n    initial_bend_angles: [0.1, 0.0, 0.0, 0.0, 0.0]\n'
        '    cables:\n'
        + ''.join(f'      {name}: {{gain: "1e-2", max_tension: 9}}\n' for name in ARM.cable_names)
    )
    first, second = rows_of(run('arm', 'track', FILE, table, '--parameters', parameters))
    state = ArmTracker(ARM, [0.1, 0, 0, 0, 0]).update(
        dict.fromkeys(ARM.cable_names, 1.0) | {'s_tip': 2.5}
    )
    assert float(first['reading_s_tip']) == 250.0
    assert float(first['s_tip']) == 2.5
    assert float(first['tip_x']) == pytest.approx(state.tip.x)
    assert second['validity'] == 'implausible'
    refused = run('arm', 'track', FILE, table, '--parameters', parameters, '--node', 'other')
    assert_refused(refused, 'addressed to /arm_estimator')


def test_a_recorded_tilt_counts_and_is_not_said_twice(tmp_path):
    path = tmp_path / 'tilted.csv'
    path.write_text(f'base_tilt [deg],{HEADER}0,1,1,1,1\n90,1,1,1,1\n')
    rows = rows_of(run('arm', 'track', FILE, path))
    margins = arm_margins(
        ARM, [0.0] * 5, dict.fromkeys(ARM.cable_names, 1.0), Load.tilted(math.pi / 2)
    )
    assert float(rows[1]['slip_margin_1']) == pytest.approx(min(margins[0], 1.0))
    assert_refused(
        run('arm', 'track', FILE, path, '--base-tilt-deg', 5), 'has the tilt of the base'
    )


def test_the_report_has_figures_joints_and_what_it_was_made_from(tmp_path):
    path = german(tmp_path / 'run.csv', ('bend_angle_1 [deg]', '3.5'))
    page = tmp_path / 'report.html'
    done = run('arm', 'report', FILE, path, '--columns', 'time=Zeit,l_mid=Fz1', '--output', page)
    assert done.returncode == 0, done.stderr
    text = page.read_text(encoding='utf-8')
    assert text.count('<svg') == 2
    for said in (
        'SHA-256 of run.csv',
        'SHA-256 of arm.yaml',
        'tendon-statics arm report',
        'rms error',
        's_tip',
    ):
        assert said in text
    assert '<script' not in text
