"""Columns of times: the titles and units that exporters give them."""

import datetime

import numpy as np
import pyarrow as pa
import pytest
from programs import assert_refused, run
from pyarrow import parquet

from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.table_options import TableOptions

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
