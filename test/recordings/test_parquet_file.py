"""Recordings in Parquet files."""

import math

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.table_options import TableOptions


@pytest.fixture
def file(tmp_path):
    def write(columns, **options):
        path = tmp_path / 'run.parquet'
        parquet.write_table(pa.table(columns), path, **options)
        return path

    return write


def test_columns_units_and_missing_values(file):
    recording = load_recording(
        file(
            {
                'state': ['held', None, 'slipping'],
                'tension_s': [2, 3, 4],
                'tension_l [mN]': [1000.0, None, 3000.0],
                'bend_angle [deg]': pa.array([90.0, 45.0, None], pa.float32()),
                'note': ['a', 'b', 'c'],
            }
        )
    )
    assert recording.tension_s.tolist() == [2.0, 3.0, 4.0]
    assert recording.tension_l[::2].tolist() == [1.0, 3.0]
    assert recording.bend_angle[0] == pytest.approx(0.5 * math.pi)
    assert np.isnan([recording.tension_l[1], recording.bend_angle[2]]).all()
    assert recording.state == ['held', '', 'slipping']


@pytest.mark.parametrize(
    ('columns', 'named'),
    [
        ({'tension_l': [1.0]}, 'no column tension_s'),
        ({'tension_l': [1.0], 'tension_s': ['a']}, 'tension_s holds no numbers'),
        (
            {'tension_l': pa.array([], pa.float64()), 'tension_s': pa.array([], pa.float64())},
            'row',
        ),
    ],
)
def test_a_file_without_a_recording_is_named_with_the_reason(file, columns, named):
    path = file(columns)
    with pytest.raises(RecordingError, match=f'^{path}: .*{named}'):
        load_recording(path)


def test_without_its_end_nothing_can_be_read(file):
    path = file({'tension_l': [1.0], 'tension_s': [2.0]})
    path.write_bytes(path.read_bytes()[:-10])
    with pytest.raises(RecordingError, match='cannot be read as Parquet') as caught:
        load_recording(path)
    assert '\n' not in str(caught.value)


def test_a_damaged_row_group_is_named_and_the_others_are_kept(file):
    tension = np.linspace(1.0, 2.0, 3000)
    path = file({'tension_l': tension, 'tension_s': tension}, row_group_size=1000)
    content = bytearray(path.read_bytes())
    second = parquet.ParquetFile(path).metadata.row_group(1).column(0)
    start = second.dictionary_page_offset
    content[start : start + 20] = b'\xff' * 20
    path.write_bytes(content)
    recording = load_recording(path)
    assert len(recording) == 2000
    assert recording.damage_summary.startswith('rows 1000 to 1999: ')


@pytest.mark.parametrize('checksums', [False, True])
def test_a_row_group_whose_values_cannot_be_right_is_damage(file, checksums):
    tension = np.arange(1.0, 301.0)
    path = file(
        {'tension_l': tension, 'tension_s': tension, 'state': ['held'] * 100 + ['slipping'] * 200},
        row_group_size=100,
        use_dictionary=False,
        compression='none',
        write_page_checksum=checksums,
    )
    content = path.read_bytes()
    damaged = np.float64(50.0).tobytes() if checksums else b'held'
    path.write_bytes(content.replace(damaged, b'\xff' * len(damaged)))
    recording = load_recording(path)
    assert recording.tension_l.tolist() == tension[100:].tolist()
    (damage,) = recording.damage
    assert damage.startswith('rows 0 to 99: ')
    assert '\n' not in damage


def test_wherever_a_file_is_damaged_the_error_is_one_line(file):
    tension = np.linspace(1.0, 2.0, 300)
    path = file({'tension_l': tension, 'tension_s': tension}, row_group_size=100)
    content = path.read_bytes()
    for place in range(0, len(content), 97):
        path.write_bytes(content[:place] + bytes(64) + content[place + 64 :])
        try:
            recording = load_recording(path)
            said, samples = recording.damage_summary, len(recording)
        except RecordingError as error:
            said, samples = str(error), 0
        assert '\n' not in said
        assert said or samples == 300


def test_of_several_columns_of_moments_none_is_taken_for_the_time_until_it_is_named(file):
    moments = pa.array([0, 1000], pa.timestamp('ms'))
    path = file({'a': moments, 'b': moments, 'tension_l': [1.0] * 2, 'tension_s': [1.5] * 2})
    recording = load_recording(path)
    assert recording.time is None
    assert '--columns time="a"' in recording.unknown_times
    named = load_recording(path, table=TableOptions(columns={'time': 'b'}))
    assert named.time.tolist() == [0.0, 1.0]
