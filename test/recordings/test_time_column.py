"""Columns of times: the titles and units that exporters give them."""

import dataclasses
import datetime

import numpy as np
import pyarrow as pa
import pytest
import scipy.io
from designs import PRELIMINARY
from programs import assert_refused, run
from pyarrow import parquet

from tendon_statics import CalibrationError, Recording, RecordingError, calibrate
from tendon_statics.estimation.settings import Settings
from tendon_statics.recordings.hints import hints
from tendon_statics.recordings.motion import mark_motion
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.table_options import TableOptions
from tendon_statics.recordings.reading.time_titles import parse_time_title
from tendon_statics.recordings.replay.estimates import replay
from tendon_statics.recordings.replay.table_output import write_table

SECONDS = 1_795_737_600
"""Midnight of 27 November 2026, UTC, since 1970"""


def written(tmp_path, title, *times):
    path = tmp_path / 'run.csv'
    path.write_text(f'{title},tension_l,tension_s\n' + ''.join(f'{t},1,1.5\n' for t in times))
    return path


@pytest.mark.parametrize(
    'title',
    [
        *('time', 'timestamp', 'Timestamp', 't', 'stamp', '__time', '%time', 'header.stamp'),
        *('/tensions/header/stamp', 'field.header.stamp', 't [s]', 'timestamp_s', 't (s)'),
    ],
)
def test_a_column_of_times_is_found_by_the_titles_of_exporters(tmp_path, title):
    recording = load_recording(written(tmp_path, title, 1.5, 2.0)).whole()
    assert recording.time.tolist() == [1.5, 2.0]
    assert (recording.notes == ()) == (title == 'time')


@pytest.mark.parametrize('title', ['time_of_day', 'temperature', 'timestamp_note', 'T', 'lat'])
def test_what_is_no_time_is_left_alone(tmp_path, title):
    recording = load_recording(written(tmp_path, title, 1.5, 2.0))
    assert (recording.time is None) == (title != 'T')


@pytest.mark.parametrize(
    ('title', 'factor'),
    [('timestamp [ms]', 1e3), ('t_us', 1e6), ('stamp (ns)', 1e9), ('__time [ns]', 1e9)],
)
def test_a_unit_in_the_title_counts(tmp_path, title, factor):
    recording = load_recording(written(tmp_path, title, 1.5 * factor, 2.0 * factor))
    assert recording.time.tolist() == [1.5, 2.0]


@pytest.mark.parametrize('title', ['time', '%time', 'timestamp'])
@pytest.mark.parametrize('unit', ['s', 'ms', 'us', 'ns'])
def test_times_since_1970_tell_their_unit(tmp_path, title, unit):
    factor = {'s': 1, 'ms': 10**3, 'us': 10**6, 'ns': 10**9}[unit]
    times = [(SECONDS + step) * factor for step in range(3)]
    recording = load_recording(written(tmp_path, title, *times))
    assert recording.time == pytest.approx(SECONDS + np.arange(3.0), abs=1e-6)
    if unit != 's':
        assert f'in {unit} since 1970' in recording.notes[0]


@pytest.mark.parametrize('digits', ['', '000'])
def test_dates_and_times_without_marks_are_no_ms_since_1970(tmp_path, digits):
    path = written(tmp_path, 'time', f'20261127100000{digits}', f'20261127100001{digits}')
    with pytest.raises(
        RecordingError, match=r'20261127100000.* without marks: write it as in 2026'
    ):
        load_recording(path)
    assert len(load_recording(path, table=TableOptions(units={'time': 'ms'})).time) == 2


def test_a_unit_that_is_said_is_not_doubted(tmp_path):
    path = written(tmp_path, 'time', 1e12, 2e12)
    said = load_recording(path, table=TableOptions(units={'time': 's'}))
    assert said.time.tolist() == [1e12, 2e12]


@pytest.mark.parametrize(
    ('seconds', 'rest'),
    [
        ('header.stamp.sec', 'header.stamp.nanosec'),
        ('/x/header/stamp/secs', '/x/header/stamp/nsecs'),
    ],
)
def test_seconds_and_nanoseconds_that_stand_apart_are_added(tmp_path, seconds, rest):
    path = tmp_path / 'run.csv'
    path.write_text(
        f'{seconds},{rest},tension_l,tension_s\n{SECONDS},999999999,1,1.5\n{SECONDS + 1},1,1,1.5\n'
    )
    recording = load_recording(path).whole()
    assert recording.time_origin == SECONDS * 10**9
    assert recording.time.tolist() == [0.999999999, 1.000000001]


def test_of_several_times_that_of_measurement_counts(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text('t,__time,header.stamp,tension_l,tension_s\n7,8,9,1,1.5\n')
    assert load_recording(path).time.tolist() == [9.0]


@pytest.mark.parametrize(
    ('texts', 'steps'),
    [
        (['2026-11-27T00:00:00Z', '2026-11-27T00:00:00.250Z', ''], [0.0, 0.25, np.nan]),
        (['2026-11-27 00:00:00', '2026-11-27 00:01:00,5', ''], [0.0, 60.5, np.nan]),
        (['2026-11-27T01:00:00+01:00', '2026-11-27T00:00:00.000000001Z'], [0.0, 1e-9]),
    ],
)
def test_dates_and_times_of_iso_8601_are_read(tmp_path, texts, steps):
    path = tmp_path / 'run.csv'
    rows = ''.join(f'{text};1.0;1.5\n' for text in texts)
    path.write_text(f'time;tension_l;tension_s\n{rows}')
    recording = load_recording(path).whole()
    assert recording.time_origin == SECONDS * 10**9
    assert recording.time == pytest.approx(steps, rel=1e-12, abs=0.0, nan_ok=True)
    assert 'ISO 8601' in recording.notes[-1]
    assert ('taken as UTC' in recording.notes[-1]) == (' ' in texts[0])


def test_a_time_that_is_none_among_dates_is_damage(tmp_path):
    path = written(tmp_path, 'time', '2026-11-27T00:00:00', 'noon', '2026-11-27T00:00:01')
    recording = load_recording(path)
    assert recording.time.tolist() == [0.0, 1.0]
    assert 'line 3' in recording.damage_summary


MOMENTS = [datetime.datetime(2026, 11, 27), None, datetime.datetime(2026, 11, 27, 0, 0, 1)]


@pytest.mark.parametrize(
    ('title', 'values'),
    [
        ('time', pa.array(MOMENTS, pa.timestamp('ns'))),
        ('time', pa.array(MOMENTS, pa.timestamp('ms', tz='Europe/Berlin'))),
        ('timestamp', pa.array(MOMENTS, pa.timestamp('us'))),
        ('__index_level_0__', pa.array(MOMENTS, pa.timestamp('ns'))),
        ('stamp', pa.array(['2026-11-27T00:00:00', None, '2026-11-27T00:00:01Z'])),
    ],
)
def test_timestamps_in_parquet_are_read(tmp_path, title, values):
    path = tmp_path / 'run.parquet'
    parquet.write_table(
        pa.table({title: values, 'tension_l': [1.0] * 3, 'tension_s': [1.5] * 3}), path
    )
    recording = load_recording(path)
    assert recording.time_origin == SECONDS * 10**9
    assert recording.time[[0, 2]].tolist() == [0.0, 1.0]
    assert np.isnan(recording.time[1])
    assert not any(note.startswith('not used') for note in recording.notes)


def test_durations_in_parquet_are_read(tmp_path):
    path = tmp_path / 'run.parquet'
    values = pa.array([0, 1500], pa.duration('ms'))
    parquet.write_table(
        pa.table({'t': values, 'tension_l': [1.0] * 2, 'tension_s': [1.5] * 2}), path
    )
    assert load_recording(path).time.tolist() == [0.0, 1.5]


@pytest.mark.parametrize(
    'title', ['timestamp', 't', 'stamp', '__time', '%time', 'header.stamp.sec']
)
def test_a_whole_session_is_not_fitted_as_slips_whatever_its_time_is_called(tmp_path, title):
    path = tmp_path / 'run.csv'
    rest = 'header.stamp.nanosec,' if title == 'header.stamp.sec' else ''
    rows = ''.join(f'{i},{"0," if rest else ""}1,{1.5 + 0.1 * i},0.1\n' for i in range(8))
    path.write_text(f'{title},{rest}tension_l,tension_s,bend_angle\n{rows}')
    assert_refused(run('calibrate', path), '--motion-step-deg')


@pytest.mark.parametrize(
    ('title', 'factor'),
    [
        *(('elapsed_time', 1.0), ('datetime', 1.0), ('header.stamp.sec', 1.0), ('sec', 1.0)),
        *(('_time', 1.0), ('rosbagTimestamp', 1.0), ('Zeit', 1.0), ('Elapsed Time (s)', 1.0)),
        *(('Time', 1.0), ('time_s', 1.0), ('Time (ms)', 1e3), ('time_ms', 1e3), ('TimeUS', 1e6)),
        *(('Zeit [ms]', 1e3), ('Zeit in s', 1.0), ('t/s', 1.0), ('Uhrzeit', 1.0), ('millis', 1e3)),
        *(('Time Stamp', 1.0), ('timestamp (µs)', 1e6), ('Time [min]', 1 / 60), ('log_time', 1.0)),
        *(('header_stamp_sec', 1.0), ('Relative Time [ms]', 1e3), ('time [seconds]', 1.0)),
        *(('tout', 1.0), ('Time (UTC)', 1.0), ('.header.stamp.secs', 1.0)),
    ],
)
def test_what_exporters_call_the_time_is_read_so_that_gaps_are_seen(tmp_path, title, factor):
    path = written(tmp_path, title, 0.0, 0.1 * factor, 3600.0 * factor)
    recording = load_recording(path).whole()
    assert recording.time == pytest.approx([0.0, 0.1, 3600.0], rel=1e-12)
    assert followed(recording).tolist() == [True, True, False]


def followed(recording):
    return replay(PRELIMINARY, recording, 'tracking').angle_assured


@pytest.mark.parametrize(
    'title',
    ['t_min', 'settling_time', 's', 'nanosec', 'header.stamp.nanosec', 'time_index', 't0', 'lat'],
)
def test_what_only_looks_like_a_title_of_times_is_none(title):
    assert parse_time_title(title) is None


@pytest.mark.parametrize(
    ('title', 'values'),
    [
        ('tick', [0.0, 0.1, 3600.0, 3600.1]),
        ('tick', [5.0, 5.0, 6.0, 6.0]),
        ('Messpunkt', [0, 100, 200, 300]),
        # What speaks of times, whatever else it says.
        *(
            (title, [0.0, 0.1, 3600.0, 3600.1])
            for title in ('sample_time', 'raw_time', 't_motor', 'X_Value', 'Messung')
        ),
    ],
)
def test_a_column_that_behaves_like_a_clock_casts_doubt_until_somebody_says_what_it_is(
    tmp_path, title, values
):
    path = written(tmp_path, title, *values)
    recording = load_recording(path)
    assert recording.time is None
    assert followed(recording).tolist() == [True, False, False, False]
    (hint,) = hints(recording, Settings(PRELIMINARY))
    assert f'--columns time="{title}"' in hint
    with pytest.raises(RecordingError, match=f'{title}.*--columns time='):
        replay(PRELIMINARY, recording, 'filtering')
    with pytest.raises(RecordingError, match=f'{title}.*--columns time='):
        mark_motion(dataclasses.replace(recording, bend_angle=[0.0] * 4), 0.1)
    named = load_recording(path, table=TableOptions(columns={'time': title}))
    assert named.time.tolist() == values
    assert followed(load_recording(path, table=TableOptions(rate=100.0))).all()


def test_a_unit_of_time_in_a_title_makes_it_a_clock_perhaps(tmp_path):
    for title in ('DAQ time [s]', 'Trigger Time [ms]', 'Time load cell (s)'):
        recording = load_recording(written(tmp_path, title, 0.0, 0.1, 3600.0, 3600.1))
        assert recording.time is not None or title in recording.unknown_times
        assert not followed(recording).all()


@pytest.mark.parametrize(
    ('title', 'values'),
    [
        ('tick', [0.0, 0.1, 0.05]),
        ('tick', [1.0, 1.0, 1.0]),
        ('', [0, 1, 2]),
        *((title, [0.0, 0.1, 3600.0]) for title in ('header.seq', 'motor_position', 'x [mm]')),
        ('tick', ['a', 'b', 'c']),
    ],
)
def test_what_does_not_behave_like_a_clock_casts_none(tmp_path, title, values):
    recording = load_recording(written(tmp_path, title, *values))
    assert recording.unknown_times == ''
    assert followed(recording).all()


def test_the_columns_of_a_replay_are_no_clocks(tmp_path):
    path = tmp_path / 'again.csv'
    rows = Recording([1.0, 1.1], [1.5, 1.7], bend_angle=[0.1, 0.2], pressure=[1.0, 2.0])
    write_table(path, replay(PRELIMINARY, rows, 'tracking').columns())
    assert load_recording(path).unknown_times == ''


@pytest.mark.parametrize('kind', ['parquet', 'mat'])
def test_clocks_are_seen_in_other_tables_too(tmp_path, kind):
    columns = {
        'tick': np.array([0.0, 0.1, 3600.0]),
        'tension_l': np.ones(3),
        'tension_s': np.full(3, 1.5),
    }
    path = tmp_path / f'run.{kind}'
    if kind == 'parquet':
        parquet.write_table(pa.table(columns), path)
    else:
        scipy.io.savemat(path, columns)
    recording = load_recording(path)
    assert '--columns time="tick"' in recording.unknown_times
    assert followed(recording).tolist() == [True, False, False]


def test_a_session_with_a_clock_that_is_not_known_is_not_fitted_as_slips(tmp_path):
    path = tmp_path / 'run.csv'
    rows = ''.join(f'{0.1 * i},1,{1.5 + 0.1 * (i * 5 % 8)},{0.1 * (i % 3)}\n' for i in range(8))
    path.write_text(f'tick,tension_l,tension_s,bend_angle\n{rows}')
    assert_refused(run('calibrate', path), '--columns time="tick"')
    with pytest.raises(CalibrationError, match='a column that rises as times do'):
        calibrate(PRELIMINARY, load_recording(path))


@pytest.mark.parametrize('cell', ['', 'nan', 'NA', 'inf'])
def test_a_row_without_a_time_casts_doubt_and_so_does_the_one_after_it(tmp_path, cell):
    path = tmp_path / 'run.csv'
    rows = ('0,1,1.5', f'{cell},1,1.5', '0.1,1,1.5', '0.2,1,3', f'{cell},1,1.5', '0.3,1,1.5')
    path.write_text('time,tension_l,tension_s\n' + '\n'.join(rows) + '\n')
    # A stop tells where it is until the next row without a time.
    assert followed(load_recording(path)).tolist() == [True, False, False, True, False, False]


@pytest.mark.parametrize('cells', [['5', '5', '5'], ['', '', '']])
def test_times_that_do_not_advance_are_none(tmp_path, cells):
    recording = load_recording(written(tmp_path, 'time', *cells))
    assert recording.time is None
    assert '--columns time=TITLE' in hints(recording, Settings(PRELIMINARY))[0]
    assert followed(recording).tolist() == [True, False, False]


def test_dates_and_times_as_a_german_spreadsheet_has_them_are_read(tmp_path):
    path = tmp_path / 'run.csv'
    for head, rows in (
        ('Datum;Uhrzeit', ('27.11.2026;23:59:59,9', '28.11.2026;0:00:00,1')),
        ('Zeit', ('27.11.2026 23:59:59,9', '28.11.2026 00:00:00,1')),
    ):
        path.write_text(f'{head};tension_l;tension_s\n' + ''.join(f'{r};1,0;1,5\n' for r in rows))
        recording = load_recording(path).whole()
        assert recording.time == pytest.approx([0.0, 0.2], abs=1e-12)
        assert recording.time_origin == (SECONDS + 86_400) * 10**9 - 10**8


def test_times_of_day_are_read_and_dates_of_which_the_day_is_not_sure_are_refused(tmp_path):
    recording = load_recording(written(tmp_path, 'Time', '9:59:59.5', '10:00:00'))
    assert recording.time.tolist() == [0.0, 0.5]
    with pytest.raises(RecordingError, match=r'is no time: .*--columns time='):
        load_recording(written(tmp_path, 'Time', '11/12/2026 10:00:00'))


def test_an_index_of_moments_without_a_title_is_the_time(tmp_path):
    path = written(tmp_path, '', '2026-11-27 00:00:00', '2026-11-27 00:00:00.5')
    assert load_recording(path).time.tolist() == [0.0, 0.5]


def test_a_unit_of_time_that_is_none_is_refused_with_the_options(tmp_path):
    path = written(tmp_path, 'Time (ticks)', 0, 1)
    with pytest.raises(RecordingError, match=r'--columns time="Time \(ticks\)".*--units time='):
        load_recording(path)
    said = TableOptions(columns={'time': 'Time (ticks)'}, units={'time': 'ms'})
    assert load_recording(path, table=said).time.tolist() == [0.0, 0.001]
    with pytest.raises(RecordingError, match='stands in its title, and --units says s'):
        load_recording(
            written(tmp_path, 'Time (ms)', 0, 1), table=TableOptions(units={'time': 's'})
        )


def test_whole_seconds_and_their_rest_are_a_stamp_whatever_stands_beside_them(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text(
        'rosbagTimestamp,header,seq,stamp,secs,nsecs,tension_l,tension_s\n'
        f'9,,1,,{SECONDS},0,1,1.5\n9,,2,,{SECONDS},500000000,1,1.5\n'
    )
    assert load_recording(path).time.tolist() == [0.0, 0.5]


def test_of_a_tension_that_is_named_the_unit_in_round_brackets_counts(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text('left (mN),right (mN)\n1000,1500\n')
    for titles in (('left (mN)', 'right (mN)'), ('left', 'right')):
        columns = dict(zip(('tension_l', 'tension_s'), titles, strict=True))
        recording = load_recording(path, table=TableOptions(columns=columns))
        assert recording.tensions() == [(1.0, 1.5)]


@pytest.mark.parametrize(
    ('texts', 'steps'),
    [
        (['23:59:59.8', '23:59:59.9', '00:00:00.0'], [0.0, 0.1, 0.2]),
        (['23:59:59.8', '', '00:00:00.0'], [0.0, np.nan, 0.2]),
        (['23:59:59', '12:00:00', '23:59:59', '00:00:01'], None),
        (['23:59:59', '10:00:00', '10:00:01'], None),
        (['00:00:01', '00:00:00', '00:00:02'], None),
    ],
    ids=['over midnight', 'with a gap', 'there and back', 'by half a day', 'a little'],
)
def test_times_of_day_that_fall_by_nearly_a_day_go_on_over_midnight(tmp_path, texts, steps):
    path = tmp_path / 'run.csv'
    rows = ''.join(f'{text},1,1\n' for text in texts)
    path.write_text(f'time,tension_l,tension_s\n{rows}')
    recording = load_recording(path)
    (note,) = recording.notes
    assert ('over midnight' in note) == (steps is not None)
    assert (recording.disorder == '') == (steps is not None)
    if steps is not None:
        np.testing.assert_allclose(recording.time, steps, atol=1e-9)


@pytest.mark.parametrize(
    ('texts', 'steps'),
    [
        (['27-Nov-2026 23:59:59.9', '28-Nov-2026 00:00:00'], [0.0, 0.1]),
        (['0 sec', '0.1 sec', '1 min'], [0.0, 0.1, 60.0]),
        (['0 days 00:00:00', '0 days 00:00:00.100000', '1 days'], [0.0, 0.1, 86_400.0]),
        (['11/27/2026 11:59:59 PM', '11/28/2026 12:00:00 AM'], [0.0, 1.0]),
        (['27/11/2026 23:59:59', '28/11/2026 00:00:00'], [0.0, 1.0]),
        (['01/12/2026 23:59:59', '30/11/2026 23:59:58'], [0.0, -86_401.0]),
        (['12:59:59 pm', '1:00:00 pm'], [0.0, 1.0]),
        (['2026/11/27 10:00:00', '2026/11/27 10:00:01'], [0.0, 1.0]),
    ],
    ids=[
        *('MATLAB', 'spans of MATLAB', 'spans of pandas', 'US', 'French'),
        *('the day by another row', 'by halves of the day', 'by strokes'),
    ],
)
def test_dates_and_spans_that_mean_one_time_are_read(tmp_path, texts, steps):
    recording = load_recording(written(tmp_path, 'Time', *texts)).whole()
    assert recording.time == pytest.approx(steps, abs=1e-9)


@pytest.mark.parametrize(
    'texts',
    [
        ['11/12/2026 10:00:00', '11/12/2026 10:00:01'],
        ['13/12/2026 10:00:00', '12/13/2026 10:00:00'],
        ['27-Nix-2026 10:00:00'],
        ['13:00:00 PM'],
        ['2026-13-27 10:00:00'],
    ],
)
def test_what_may_be_two_times_or_none_is_refused(tmp_path, texts):
    with pytest.raises(RecordingError, match=r'is no time: .*it may be as in'):
        load_recording(written(tmp_path, 'Time', *texts))


@pytest.mark.parametrize('kind', [pa.time64('ns'), pa.string()])
@pytest.mark.parametrize('kind_of_date', [pa.date32(), pa.timestamp('ns'), pa.string()])
def test_dates_beside_times_of_day_count_in_parquet_too(tmp_path, kind, kind_of_date):
    days = [datetime.datetime(2026, 11, 27 + later) for later in (0, 0, 1)]
    if kind_of_date == pa.string():
        days = [str(day.date()) for day in days]
    of_day = [datetime.time(10, 0, 0, 100_000 * tenth) for tenth in (0, 1, 2)]
    if kind == pa.string():
        of_day = [*map(str, of_day)]
    columns = {'date': pa.array(days, kind_of_date), 'time': pa.array(of_day, kind)}
    columns |= {'tension_l': [1.0] * 3, 'tension_s': [1.0] * 3}
    parquet.write_table(pa.table(columns), tmp_path / 'run.parquet')
    recording = load_recording(tmp_path / 'run.parquet')
    assert recording.time == pytest.approx([0.0, 0.1, 86_400.2], abs=1e-9)


@pytest.mark.parametrize('kind', [pa.time32('ms'), pa.time64('us')])
def test_times_of_day_in_parquet_are_read(tmp_path, kind):
    of_day = [datetime.time(23, 59, 59, 900_000), None, datetime.time(0, 0)]
    columns = {'t': pa.array(of_day, kind), 'tension_l': [1.0] * 3, 'tension_s': [1.0] * 3}
    parquet.write_table(pa.table(columns), tmp_path / 'run.parquet')
    recording = load_recording(tmp_path / 'run.parquet')
    np.testing.assert_allclose(recording.time, [0.0, np.nan, 0.1], atol=1e-9)
    assert 'over midnight' in recording.notes[0]
