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
            assert float(row[f'bend_angle_{number}']) == joint.bend_angle
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
        (['track', FILE, 'none.csv'], 'none.csv: it cannot be read'),
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
        ('', 'there is no row'),
        (HEADER, 'there is no row'),
        ('l_mid,s_mid,l_tip\n1,1,1\n', 'there is no column s_tip'),
        (f'tip,{HEADER}1,1,1,1,1\n', "column 'tip' is no cable of the arm"),
        (f'l_mid,{HEADER}1,1,1,1,1\n', 'column l_mid is there twice'),
        (f'# said\n{HEADER}1,1,1,1\n1,1,x,1\n', "line 4: l_tip is 'x', not a number"),
        (f'{HEADER}1,1,nan,1\n', "l_tip is 'nan', not a number"),
        (f'{HEADER}1,1,1\n', 'line 2 has 3 fields, but there are 4 columns'),
        (f'{HEADER}1,1,1,1\n1,1,1,-1\n', 'row 2: the tension of cable s_tip is -1.0 N'),
    ],
)
def test_a_table_that_is_none_is_refused_with_its_place(tmp_path, text, named):
    path = tmp_path / 'tensions.csv'
    path.write_text(text, encoding='utf-8')
    assert_refused(run('arm', 'track', FILE, path), named)


def test_a_slack_arm_leaves_its_fields_empty(tmp_path):
    path = tmp_path / 'tensions.csv'
    path.write_text(f'{HEADER}1,1,0,1\n2,2,2,2\n', encoding='utf-8')
    first, second = csv.DictReader(io.StringIO(run('arm', 'track', FILE, path).stdout))
    assert first['regime_1'] == 'slack'
    assert first['bend_angle_1'] == first['tip_x'] == ''
    assert second['angle_assured_1'] == 'False'
    assert second['tip_x_stddev'] == ''
