"""Every kind of thing that the field does to a recording: the right values, and one answer of all.

Of each kind there is an input of the project's own, and those that lie beside the clone are looked
at as well. `replay`, `report`, `track`, `calibrate` and the node have to say the same of all.
"""

import csv
import math
import re
import subprocess
import sys
from collections import Counter
from html import unescape

import field_cases
import numpy as np
import pytest
from bags import STORE
from builtin_interfaces.msg import Time
from field_cases import BAGS, CASES, DAMAGE, TABLES
from listener import Listener
from programs import TIME_LIMIT
from ros_programs import spinning, wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from tendon_statics import default_design_path, load_recording
from tendon_statics.command_line.main import main

LONG = 3000.0
"""s; an `input_timeout` that no test exceeds, but for an hour's gap"""

UNSEEN = (
    *('slack_tiny.csv', 'slack_reads_a_little_above_zero.csv', 'drive_off_nan.csv'),
    'hour_gap.csv',
)
"""In these the unit moves while no tensions can say so"""

TRACKED = (*UNSEEN, 'one_spike.csv')


@pytest.fixture(scope='module')
def own_cases(tmp_path_factory):
    return field_cases.write_cases(tmp_path_factory.mktemp('cases'))


@pytest.fixture(params=['own', 'beside the clone'])
def cases(request, own_cases):
    """Folder of the cases."""
    if request.param == 'own':
        return own_cases
    folder = field_cases.collected()
    if folder is None:
        pytest.skip('there is no folder of cases beside the clone')
    return folder


@pytest.fixture
def unit(tmp_path, cases):
    """Gives the unit's file of a case, with an `input_timeout`."""

    def with_timeout(case, timeout=LONG):
        path = cases / case.design if case.design else default_design_path()
        changed = tmp_path / f'unit_{timeout}.yaml'
        text = path.read_text(encoding='utf-8')
        line = f'    input_timeout: {timeout}\n'
        changed.write_text(text.replace('    design:', f'{line}    design:', 1), encoding='utf-8')
        return changed

    return with_timeout


@pytest.fixture
def verb(capsys):
    """Runs a verb; gives its exit code, output and errors."""

    def run(*arguments):
        capsys.readouterr()
        code = main([str(argument) for argument in arguments])
        return code, *capsys.readouterr()

    return run


@pytest.fixture
def replayed(verb, tmp_path):
    """Gives columns of the table that `replay` makes of a case, and what it prints."""

    def replay(path, *options):
        output = tmp_path / 'replayed.csv'
        code, text, errors = verb('replay', path, *options, '--output', output)
        assert code in (0, 1), errors
        with output.open(encoding='utf-8') as file:
            found = list(csv.DictReader(file))
        return {name: [row[name] for row in found] for name in found[0]}, text

    return replay


def design_of(cases, case):
    return ('--design', cases / case.design) if case.design else ()


def facts(text, *titles):
    """What is printed under some titles."""
    found = re.findall(r'^(\w[\w ]*?)  +(.*)$', text, flags=re.MULTILINE)
    return [(title, said) for title, said in found if title in titles]


def numbers(texts):
    return np.array([float(text or 'nan') for text in texts])


@pytest.mark.parametrize('name', CASES)
def test_a_case_gives_what_is_right(name, cases, verb, tmp_path):
    case, output = CASES[name], tmp_path / 'out.csv'
    given = (cases / name, *design_of(cases, case))
    code, text, errors = verb('replay', *given, '--output', output)
    assert code == case.code, errors
    if case.refused:
        assert case.refused in errors
        assert errors.count('\n') == 1
        return
    for part in case.says:
        assert part in text
    assert DAMAGE.get(name, '') in errors
    with output.open(encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    assert case.samples in (None, len(rows))
    for row, expected in zip(rows, case.tensions, strict=False):
        assert (float(row['tension_l']), float(row['tension_s'])) == pytest.approx(expected)
    valid = [row for row in rows if row['validity'] == 'valid']
    assert len(valid) == (len(rows) if case.valid is None else case.valid)


@pytest.mark.parametrize('name', [name for name in CASES if not CASES[name].refused])
def test_all_verbs_say_the_same_of_a_case(name, cases, verb, replayed, tmp_path):
    case, page = CASES[name], tmp_path / 'page.html'
    given = (cases / name, *design_of(cases, case))
    code, text, _ = verb('replay', *given, '--estimation', 'equilibrium')
    said = facts(text, 'recording', 'read', 'warning', 'regimes', 'invalid')
    assert said

    reported, _, errors = verb('report', *given, '--estimation', 'equilibrium', '--output', page)
    assert reported == code
    shown = unescape(re.sub(r'<[^>]*>', ' ', page.read_text(encoding='utf-8')))
    is_fitted = 'has no calibration' not in errors
    for title, what in said:
        assert what in shown or (is_fitted and title in ('regimes', 'warning'))

    calibrated, fit, refusal = verb('calibrate', *given)
    if is_fitted:
        assert calibrated == code
        assert facts(fit, 'read') == facts(text, 'read')
    else:
        assert calibrated == 2
        why = errors.split('has no calibration: ')[1].splitlines()[0]
        assert why in refusal

    columns, tracked_text = replayed(*given, '--estimation', 'tracking')
    tracked, table, notes = verb('track', *given)
    assert tracked == code
    rows = list(csv.DictReader(table.splitlines()))
    np.testing.assert_array_equal(
        numbers([row['bend_angle'] for row in rows]), numbers(columns['estimated_bend_angle'])
    )
    assert [row['regime'] for row in rows] == columns['regime']
    assert [row['angle_assured'] for row in rows] == columns['angle_assured']
    for _, note in facts(tracked_text, 'read', 'warning'):
        assert note in notes


@pytest.mark.parametrize('name', UNSEEN)
def test_no_angle_is_assured_of_a_unit_that_moved_unseen(name, cases, replayed):
    """A tracker that believes every sample may be some degrees off by noise, of which it warns."""
    columns, _ = replayed(cases / name, '--estimation', 'tracking')
    assured = np.array([text == 'True' for text in columns['angle_assured']])
    if name != 'slack_reads_a_little_above_zero.csv':  # which may come to a stop in the end
        assert not assured[-1]
    estimated = numbers(columns['estimated_bend_angle'])
    measured = numbers(columns['bend_angle'])
    wrong = assured & ~(abs(estimated - measured) < math.radians(10.0))
    assert not wrong.any()


def test_a_file_that_two_programs_would_read_differently_is_refused_by_all(cases, verb, own_cases):
    design = cases / 'mass_octal.yaml'
    for given in (
        ('replay', own_cases / 'tabs.csv', '--design', design),
        ('solve', '--tension-l', 1, '--tension-s', 1.5),
    ):
        options = given if '--design' in given else (*given, '--design', design)
        code, _, errors = verb(*options)
        assert code == 2
        assert '010' in errors
    with spinning(Listener) as listener:
        from forked_programs import ForkedProgram

        arguments = ('--ros-args', '--params-file', str(design))
        with ForkedProgram.running('estimator', *arguments) as program:
            assert program.process.wait(TIME_LIMIT) == 1
            assert '010' in program.output()
        assert listener.regimes == []


# The node


@pytest.fixture
def of_source():
    """A listener that publishes joint states."""
    with spinning(lambda context: Listener(context, 'joint_state')) as node:
        yield node


def begin_anew(listener):
    """Make the estimator forget stamps and pairs, and what came of it."""
    assert listener.change_state('deactivate')
    assert listener.change_state('activate')
    listener.reset()
    listener.forget()


def assert_same(columns, estimates, valid):
    """Assert that the node's estimates are those of a replay in these places."""
    # Of a slack cable the node has 0, and the table what was read.
    is_slack = np.array([estimate.regime == 'slack' for estimate in estimates], dtype=bool)
    for name, field in (
        *(('tension_l', 'tension_l'), ('tension_s', 'tension_s')),
        ('estimated_bend_angle', 'bend_angle'),
    ):
        expected = numbers(columns[name])[valid]
        found = np.array([getattr(estimate, field) for estimate in estimates])
        if field != 'bend_angle':
            found = np.where(is_slack & (found == 0.0), expected, found)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9, err_msg=name)
    assert [estimate.regime for estimate in estimates] == list(np.array(columns['regime'])[valid])
    assured = [str(estimate.angle_assured) for estimate in estimates]
    assert assured == list(np.array(columns['angle_assured'])[valid])


@pytest.mark.parametrize('estimation', ['equilibrium', 'tracking'])
def test_the_node_says_of_tables_what_replay_says(estimation, cases, listener, unit, replayed):
    names = [name for name in TABLES if not CASES[name].design] + ['topic_without_slash.mcap']
    if estimation == 'tracking':
        names = [*TRACKED]
    file = unit(CASES['tabs.csv'])
    with listener.estimator('--params-file', str(file), '-p', f'estimation:={estimation}'):
        for name in names:
            columns, _ = replayed(cases / name, '--design', file, '--estimation', estimation)
            begin_anew(listener)
            readings = load_recording(cases / name).tensions()
            wait = name == 'hour_gap.csv' and estimation == 'tracking'
            regimes = [answer_after(listener, pair, wait and n) for n, pair in enumerate(readings)]
            valid = np.array(columns['validity']) == 'valid'
            assert regimes == columns['regime'], name
            count = int(valid.sum())
            wait_for('all estimates', lambda n=count: len(listener.estimates) >= n)
            assert_same(columns, listener.estimates, valid)


def answer_after(listener, pair, gap):
    """Publish a pair, after a gap that is longer than `input_timeout` if that is asked."""
    if gap:
        before = len(listener.stale_regimes)
        assert listener.set_estimator_parameters(input_timeout=0.05).successful
        wait_for('stale', lambda: len(listener.stale_regimes) > before)
    try:
        return listener.answer(*pair)
    finally:
        if gap:
            assert listener.set_estimator_parameters(input_timeout=LONG).successful


def test_the_node_reads_a_units_file_as_the_verbs_do(cases, of_source, unit, replayed):
    name = 'raw_counts_for_unit_with_gains.csv'
    case = CASES[name]
    columns, _ = replayed(cases / name, '--design', cases / case.design)
    with of_source.estimator('--params-file', str(unit(case))):
        readings = load_recording(cases / name).tensions()

        def publish(number, pair):
            header = Header(stamp=Time(sec=100 + number))
            message = JointState(header=header, name=list(case.names), effort=list(pair))
            of_source.tension_publishers[0].publish(message)

        for number, pair in enumerate(readings):
            wait_for(
                'the estimate',
                lambda n=number, p=pair: publish(n, p) or len(of_source.estimates) > n,
            )
        estimates = list(of_source.estimates)
    assert_same(columns, estimates[: len(readings)], slice(None))


def messages_of(path):
    """The joint states on /tensions of a bag, in the order of recording, as ROS has them."""
    from mcap.reader import make_reader

    from tendon_statics.recordings.reading.bag_folder import bag_folder

    for file in bag_folder(path).files:
        with file.open('rb') as stream:
            for _, _, record in make_reader(stream).iter_messages('/tensions'):
                message = STORE.deserialize_cdr(record.data, 'sensor_msgs/msg/JointState')
                stamp = message.header.stamp
                yield JointState(
                    header=Header(stamp=Time(sec=stamp.sec, nanosec=stamp.nanosec)),
                    name=message.name,
                    effort=message.effort.tolist(),
                )


def test_the_node_says_of_bags_what_replay_says(cases, of_source, unit, replayed):
    """But for stamps that are no clock, of which the verbs have a note: the node drops them."""
    file = unit(CASES['tabs.csv'])
    with of_source.estimator('--params-file', str(file)):
        for name in BAGS:
            case = CASES[name]
            columns, _ = replayed(cases / name, '--design', file)
            begin_anew(of_source)
            before = of_source.report()
            sent = [*messages_of(cases / name)]
            for message in sent:
                of_source.tension_publishers[0].publish(message)
            is_new = np.ones(len(columns['regime']), dtype=bool)
            if 'out of order' in case.drops:
                is_new = in_order(sent)
            count = int(is_new.sum())
            wait_for('all estimates', lambda n=count: len(of_source.estimates) >= n)

            def difference(key, before=before):
                return count_of(of_source.report(), key) - count_of(before, key)

            for reason, number in case.drops.items():
                wait_for(reason, lambda r=reason, n=number: difference(f'dropped: {r}') == n)
            assert difference('messages about neither cable') == case.foreign
            assert_same(columns, of_source.estimates, is_new)


def in_order(messages):
    """Which messages have stamps that rise."""
    newest, found = -math.inf, []
    for message in messages:
        time = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
        found.append(time > newest)
        newest = max(newest, time)
    return np.array(found)


def count_of(status, key):
    (value,) = [item.value for item in status.values if item.key == key]
    return int(value)


KINDS = {
    'publish_foreign_joints.py': ([(['wheel'], [0.1]), (['cable_l', 'cable_s'], [1.0, 2.0])], ''),
    'publish_efforts_of_some.py': (
        [(['cable_l', 'cable_s', 'wheel'], [1.0, 2.0])],
        'wrong length',
    ),
}
"""Script → names and efforts of the messages that it publishes, and why they are dropped"""


@pytest.mark.parametrize('script', KINDS)
def test_what_others_publish_is_passed_over_and_nothing_is_guessed(script, of_source):
    messages, reason = KINDS[script]
    with of_source.estimator():
        begin_anew(of_source)
        before = of_source.report()
        for number in range(1, 51):
            for names, efforts in messages:
                header = Header(stamp=Time(sec=number))
                message = JointState(header=header, name=names, effort=efforts)
                of_source.tension_publishers[0].publish(message)
        if reason:
            key = f'dropped: {reason}'
            wait_for(
                reason, lambda: count_of(of_source.report(), key) - count_of(before, key) == 50
            )
            assert of_source.estimates == []
        else:
            wait_for('all estimates', lambda: len(of_source.estimates) == 50)
            after = of_source.report()
            assert Counter(estimate.tension_s for estimate in of_source.estimates) == {2.0: 50}
            for item in after.values:
                if item.key.startswith('dropped: '):
                    assert count_of(after, item.key) == count_of(before, item.key), item.key


@pytest.mark.parametrize('script', KINDS)
def test_the_scripts_that_users_sent_are_answered_as_they_should(script, of_source):
    folder = field_cases.collected()
    if folder is None:
        pytest.skip('there is no folder of cases beside the clone')
    _, reason = KINDS[script]
    with of_source.estimator():
        begin_anew(of_source)
        with subprocess.Popen([sys.executable, folder / script]) as process:
            if reason:
                key = f'dropped: {reason}'
                wait_for(reason, lambda: count_of(of_source.report(), key) > 100)
                assert of_source.estimates == []
            else:
                wait_for('estimates', lambda: len(of_source.estimates) > 100)
                assert {estimate.tension_s for estimate in of_source.estimates} == {2.0}
            process.wait(TIME_LIMIT)
        assert process.returncode == 0
