"""`replay` and its verb: every sample as `solve` and the tracker answer it."""

import csv
import math

import bags
import numpy as np
import pytest
from bags import ORIGIN, write_bag
from designs import PRELIMINARY
from programs import assert_refused, run
from pyarrow import parquet

from tendon_statics import Recording, RecordingError, TensionError, solve
from tendon_statics.files.installed_files import installed_config
from tendon_statics.files.output_file import OutputError
from tendon_statics.physics import StickSlipTracker, slip_margin
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.topics import BagTopics
from tendon_statics.recordings.replay import bag_output
from tendon_statics.recordings.replay import estimates as replay_module
from tendon_statics.recordings.replay.estimates import replay
from tendon_statics.recordings.replay.table_output import write_table

WRITERS = {
    'csv': lambda path, replayed: write_table(path, replayed.columns()),
    'parquet': lambda path, replayed: write_table(path, replayed.columns()),
    'mcap': bag_output.write_bag,
}
DEMO = installed_config('every_regime.csv')


def _estimated(output):
    """Column → what an output says of it, where it says something."""
    if output.suffix == '.mcap':
        from rosbags.highlevel import AnyReader

        there = {}
        with AnyReader([output]) as reader:
            for connection, _, data in reader.messages():
                if connection.topic.startswith(bag_output.PREFIX):
                    name = connection.topic.removeprefix(bag_output.PREFIX)
                    message = reader.deserialize(data, connection.msgtype)
                    there.setdefault(COLUMN_OF.get(name, name), []).append(message.data)
        return there
    if output.suffix == '.parquet':
        table = parquet.read_table(output).to_pydict()
    else:
        rows = list(csv.reader(output.read_text().splitlines()))
        table = {
            name: [_read(text) for text in fields] for name, *fields in zip(*rows, strict=True)
        }
    first = list(table).index('regime')
    return {name: [v for v in values if v == v] for name, values in [*table.items()][first:]}


COLUMN_OF = {
    'bend_angle': 'estimated_bend_angle',
    'bend_angle_stddev': 'estimated_bend_angle_stddev',
    'joint_pressure': 'estimated_pressure',
    'joint_pressure_stddev': 'estimated_pressure_stddev',
}


def _read(text):
    """A field of a CSV file as what it is: a truth, a number or a word."""
    if text in ('True', 'False'):
        return text == 'True'
    try:
        return float(text or 'nan')
    except ValueError:
        return text


@pytest.fixture
def walk():
    """Tensions over all regimes, with invalid and slack ones between them."""
    rng = np.random.default_rng(1)
    tensions = rng.uniform(0.2, 3.0, (200, 2))
    tensions[::2] = rng.choice([[1.0, 2.0], [2.0, 1.0], [1.0, 1.97]], 100)
    tensions[5], tensions[50], tensions[51] = (math.nan, 1.0), (0.0, 1.0), (0.05, 0.05)
    return Recording(*tensions.T, bend_angle=np.zeros(200))


@pytest.mark.parametrize('chunk', [7, 1000])
def test_each_sample_by_itself_is_as_solve_answers(walk, monkeypatch, chunk):
    monkeypatch.setattr(replay_module, 'CHUNK', chunk)
    replayed = replay(PRELIMINARY, walk, tension_stddev=0.008)
    for index, tensions in enumerate(walk.tensions()):
        try:
            answer = solve(PRELIMINARY, *tensions)
        except TensionError:
            assert replayed.regime[index] == 'invalid'
            assert math.isnan(replayed.bend_angle[index])
            continue
        assert replayed.regime[index] == answer.regime.value
        if answer.bend_angle is None:
            assert math.isnan(replayed.bend_angle[index])
            assert math.isnan(replayed.slip_margin[index])
            continue
        assert replayed.bend_angle[index] == pytest.approx(answer.bend_angle, abs=1e-9)
        assert replayed.pressure[index] == pytest.approx(answer.pressure, rel=1e-9)
        assert replayed.bend_angle_stddev[index] == pytest.approx(answer.bend_angle_stddev(0.008))
        assert replayed.pressure_stddev[index] == pytest.approx(answer.pressure_stddev(0.008))
        margin = slip_margin(PRELIMINARY, *tensions, answer.bend_angle)
        assert replayed.slip_margin[index] == pytest.approx(margin, abs=1e-6)
    assert replayed.error[0] == replayed.bend_angle[0]


@pytest.mark.parametrize('chunk', [7, 1000])
def test_with_memory_each_sample_is_as_the_tracker_answers(walk, monkeypatch, chunk):
    monkeypatch.setattr(replay_module, 'CHUNK', chunk)
    replayed = replay(PRELIMINARY, walk, 'tracking', initial_bend_angle=0.1)
    tracker = StickSlipTracker(PRELIMINARY, 0.1)
    for index, tensions in enumerate(walk.tensions()):
        try:
            state = tracker.update(*tensions)
        except TensionError:
            assert replayed.regime[index] == 'invalid'
            assert not replayed.angle_assured[index]
            tracker.doubt()
            continue
        assert replayed.regime[index] == state.regime.value
        assert replayed.angle_assured[index] == state.angle_assured
        if state.bend_angle is not None:
            assert replayed.bend_angle[index] == state.bend_angle
            assert replayed.slip_margin[index] == state.slip_margin
    unsure = np.isfinite(replayed.bend_angle) & ~replayed.angle_assured
    assert np.isnan(replayed.error[unsure]).all()


@pytest.mark.parametrize('deviation', [0.0, -0.01, math.nan, math.inf])
def test_a_deviation_that_is_none_is_refused(walk, deviation):
    with pytest.raises(ValueError, match=r'tension_stddev is .* N, allowed is'):
        replay(PRELIMINARY, walk, tension_stddev=deviation)


def test_the_verb_sums_up_regimes_and_error(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text(
        'time,tension_l,tension_s,bend_angle [deg]\n'
        '0,1,2,16.14\n0.1,1,3,31\n0.2,1,1.5,0\n0.3,nan,1,\n0.4,0,1,0\n'
    )
    done = run('replay', path)
    assert (done.returncode, done.stderr) == (0, '')
    for named in (
        *('run.csv: 5 samples', '10 Hz over 0.4 s', 'held 1 (20 %)', 'invalid 1', 'slack 1'),
        *('determined in 2 samples', 'root mean square 1 deg', 'in 2 samples'),
    ):
        assert named in done.stdout
    done = run('replay', path, '--estimation', 'tracking', '--initial-bend-angle', '0.1')
    assert 'estimation    tracking' in done.stdout


@pytest.mark.parametrize(
    ('times', 'named'),
    [
        ([0.0, 1.0, 1.0, 2.0], ''),
        ([0.0, math.nan, 0.5, 2.0], ''),
        ([0.0, 1.0, math.nan, 0.5], 'from 1 s to 0.5 s at sample 4 of 4'),
        ([3.0, 2.0, 1.0, 4.0], 'from 3 s to 2 s at sample 2 of 4, and back at 1 more'),
    ],
)
def test_only_where_time_does_not_go_back_a_unit_is_tracked(times, named):
    ones = np.ones(4)
    recording = Recording(ones, ones, time=times, name='run')
    assert (named in recording.disorder) if named else (recording.disorder == '')
    assert len(replay(PRELIMINARY, recording).regime) == 4
    if not named:
        replay(PRELIMINARY, recording, 'tracking')
        return
    with pytest.raises(RecordingError, match=f'^run: time goes back {named}'):
        replay(PRELIMINARY, recording, 'tracking')


def test_the_verb_says_that_time_goes_back_or_is_missing(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text('time,tension_l,tension_s\n0,1,2\n2,1,2\n,1,2\n1,1,2\n')
    done = run('replay', path)
    assert (done.returncode, done.stderr) == (0, '')
    assert 'without time  1 samples' in done.stdout
    assert 'order         time goes back from 2 s to 1 s at sample 4 of 4\n' in done.stdout
    assert 'Hz' not in done.stdout
    for verb in (['replay', path, '--estimation', 'tracking'], ['track', path]):
        assert_refused(run(*verb), 'run.csv: time goes back from 2 s to 1 s')


@pytest.mark.parametrize('ending', ['csv', 'parquet'])
def test_the_verb_writes_every_sample(tmp_path, ending):
    output = tmp_path / f'out.{ending}'
    assert run('replay', DEMO, '--output', output).returncode == 0
    replayed = replay(PRELIMINARY, load_recording(DEMO))
    if ending == 'csv':
        rows = list(csv.DictReader(output.read_text().splitlines()))
        assert list(rows[0]) == list(replayed.columns())
        angles = [float(row['estimated_bend_angle'] or 'nan') for row in rows]
        regimes = [row['regime'] for row in rows]
    else:
        table = parquet.read_table(output)
        assert table.column_names == list(replayed.columns())
        angles = table['estimated_bend_angle'].to_pylist()
        regimes = table['regime'].to_pylist()
    assert regimes == replayed.regime.tolist()
    assert angles == pytest.approx(replayed.bend_angle.tolist(), nan_ok=True)
    # What was estimated is not taken for measured when the output is read again.
    assert load_recording(output).bend_angle is None


def test_the_verb_writes_a_bag_that_other_readers_take(tmp_path):
    from rosbags.highlevel import AnyReader

    file = write_bag(
        tmp_path / 'bag',
        [
            ('/tensions', 0.0, bags.array(1.0, 2.0)),
            ('/measured_bend_angle', 0.0, bags.number(0.25)),
            ('/tensions', 0.5, bags.array(1.0, 1.5)),
            ('/tensions', 1.0, bags.array(math.nan, 1.5)),
        ],
    )
    output = tmp_path / 'out.mcap'
    assert run('replay', file, '--output', output).returncode == 0
    messages = []
    with AnyReader([output]) as reader:
        for connection, time, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            messages.append((connection.topic, (time - ORIGIN) * 1e-9, message.data))
    of = {topic: [m[1:] for m in messages if m[0] == topic] for topic, *_ in messages}
    assert [regime for _, regime in of['/replay/regime']] == ['equilibrium', 'held', 'invalid']
    ((time, angle),) = of['/replay/bend_angle']
    assert time == 0.0
    assert math.degrees(angle) == pytest.approx(17.14, abs=1e-4)
    assert len(of['/replay/joint_pressure']) == len(of['/replay/slip_margin']) == 1
    again = load_recording(output)
    assert again.time.tolist() == [0.0, 0.5, 1.0]
    assert again.bend_angle[0] == 0.25
    assert again.tensions()[1] == (1.0, 1.5)


def test_of_a_truncated_recording_the_beginning_is_replayed_and_the_rest_is_named(tmp_path):
    messages = (('/tensions', 0.01 * i, bags.array(1.0, 1.5)) for i in range(30000))
    file = write_bag(tmp_path / 'bag', messages)
    file.write_bytes(file.read_bytes()[:-2000])
    output = tmp_path / 'out.csv'
    done = run('replay', file, '--output', output)
    assert done.returncode == 1
    assert done.stderr.count('\n') == 1
    assert 'not all of it could be read' in done.stderr
    assert 'bag.mcap: ' in done.stdout
    assert len(output.read_text().splitlines()) > 10000


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        (['missing.mcap'], 'missing.mcap: it cannot be read'),
        ([DEMO, '--output', 'out.doc'], '.csv, .parquet, .mcap'),
        ([DEMO, '--output', '/no/such/folder/out.csv'], 'cannot be written'),
        ([DEMO, '--output', 'out.mcap'], 'needs the time of every sample'),
        ([DEMO, '--estimation', 'guessing'], 'guessing'),
        ([DEMO, '--estimation', 'tracking', '--initial-bend-angle', '3'], 'bend_angle is 3.0'),
        ([DEMO, '--initial-bend-angle', 'nan'], 'bend_angle is nan'),
        ([DEMO, '--tension-stddev', '-1'], "--tension-stddev: it is '-1'"),
    ],
)
def test_an_error_is_one_line(arguments, named):
    assert_refused(run('replay', *arguments), named)


def test_a_recording_is_never_overwritten_by_its_own_replay(tmp_path):
    path = tmp_path / 'session.csv'
    path.write_text('tension_l,tension_s\n1,2\n')
    before = path.read_bytes()
    assert_refused(run('replay', str(path), '--output', str(path)), 'it is the recording itself')
    assert path.read_bytes() == before


def test_degrees_without_their_unit_are_noticed(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text('tension_l,tension_s,bend_angle\n1,2,17.14\n1,2,0.1\n1,2,-12\n')
    assert 'named bend_angle [deg]' in run('replay', path).stdout
    path.write_text('tension_l,tension_s,bend_angle [deg]\n1,2,17.14\n1,2,0.1\n1,2,-12\n')
    assert 'bend_angle [deg]' not in run('replay', path).stdout


def test_a_folder_that_is_a_recording_gets_no_further_file(tmp_path):
    file = write_bag(tmp_path / 'bag', [('/tensions', 0.0, bags.array(1.0, 2.0))])
    before = sorted((tmp_path / 'bag').iterdir())
    for name in ('bag.mcap', 'out.mcap'):
        output = tmp_path / 'bag' / name
        for data in (tmp_path / 'bag', file):
            assert_refused(run('replay', data, '--output', output), 'or lies in it')
    assert sorted((tmp_path / 'bag').iterdir()) == before


@pytest.mark.parametrize('ending', ['csv', 'parquet', 'mcap'])
def test_an_output_holds_what_was_recorded_and_all_that_was_estimated(tmp_path, ending):
    recording = Recording(
        tension_l=[1.0, 1.0, 0.0, math.nan],
        tension_s=[2.0, 1.5, 1.0, 1.0],
        bend_angle=[0.25, math.nan, 0.1, 0.0],
        pressure=[400.0, 300.0, math.nan, 0.0],
        state=['slipping', 'held', '', 'moving'],
        time=[3.0, 3.001, 3.002, 3.5],
    )
    replayed = replay(PRELIMINARY, recording)
    output = tmp_path / f'out.{ending}'
    WRITERS[ending](output, replayed)
    again = load_recording(output, BagTopics(state='/state')).whole()
    for name in ('tension_l', 'tension_s', 'bend_angle', 'pressure'):
        np.testing.assert_array_equal(getattr(again, name), getattr(recording, name))
    assert again.state == recording.state
    assert 1e-9 * again.time_origin + again.time == pytest.approx(recording.time, abs=1e-9)
    there = _estimated(output)
    expected = replayed.columns()
    for name in ('time', 'tension_l', 'tension_s', 'bend_angle', 'pressure', 'state'):
        del expected[name]
    assert there.keys() == expected.keys()
    for name, values in expected.items():
        assert there[name] == [v for v in values.tolist() if v == v]


def test_an_output_says_nothing_of_what_was_not_recorded(tmp_path):
    recording = Recording([1.0, 1.0], [2.0, 1.5], time=[0.0, 1.0])
    for ending, write in WRITERS.items():
        output = tmp_path / f'out.{ending}'
        write(output, replay(PRELIMINARY, recording))
        again = load_recording(output)
        assert again.bend_angle is again.pressure is again.state is None


@pytest.mark.parametrize(
    ('times', 'named'),
    [
        ([-1.0, 0.0], 'sample 1 is at -1 s'),
        ([0.0, 1e300], 'sample 2 is at 1e+300 s'),
        ([0.0, 9223372036.9], 'sample 2 is at 9223372037 s'),
        ([0.0, math.inf], 'needs the time of every sample'),
        ([0.0, math.nan], 'needs the time of every sample'),
    ],
)
def test_times_that_no_bag_can_hold_are_refused(tmp_path, times, named):
    data, output = tmp_path / 'run.csv', tmp_path / 'out.mcap'
    data.write_text('time,tension_l,tension_s\n' + ''.join(f'{time},1,2\n' for time in times))
    assert_refused(run('replay', data, '--output', output), named)
    assert not output.exists()


def test_times_count_from_their_origin(tmp_path):
    ones, output = np.ones(2), tmp_path / 'out.mcap'
    recording = Recording(ones, ones, time=[-1.0, 0.5], time_origin=ORIGIN)
    bag_output.write_bag(output, replay(PRELIMINARY, recording))
    assert load_recording(output).time_origin == ORIGIN - 1_000_000_000
    early = Recording(ones, ones, time=[-1.0, 0.5], time_origin=5)
    with pytest.raises(OutputError, match='a bag holds times from 0'):
        bag_output.write_bag(output, replay(PRELIMINARY, early))
