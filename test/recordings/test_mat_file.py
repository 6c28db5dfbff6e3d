"""Recordings in MATLAB files, by the library that reads them."""

import numpy as np
import pytest

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.table_options import TableOptions

scipy_io = pytest.importorskip('scipy.io')
pytest.importorskip('pymatreader')

COLUMNS = {'t': [0.0, 0.5], 'tension_l': [1.0, 1.0], 'tension_s': [1.5, 1.6], 'note': 'a run'}


@pytest.mark.parametrize('nested', [False, True])
def test_variables_and_fields_of_structs_are_columns(tmp_path, nested):
    path = tmp_path / 'run.mat'
    columns = {name: np.array(v)[:, None] if name != 'note' else v for name, v in COLUMNS.items()}
    scipy_io.savemat(path, {'run': columns} if nested else columns)
    recording = load_recording(path).whole()
    assert recording.tensions() == [(1.0, 1.5), (1.0, 1.6)]
    assert recording.time.tolist() == [0.0, 0.5]


@pytest.mark.parametrize('nested', [False, True])
def test_seconds_and_nanoseconds_that_stand_apart_are_added(tmp_path, nested):
    path = tmp_path / 'run.mat'
    stamp = {'sec': [1_700_000_000] * 2, 'nanosec': [100_000_000, 900_000_000]}
    stamps = {'header': {'stamp': stamp}} if nested else {f'stamp_{k}': stamp[k] for k in stamp}
    scipy_io.savemat(path, {'tension_l': [1.0, 1.0], 'tension_s': [1.5, 1.6], **stamps})
    assert load_recording(path).time.tolist() == pytest.approx([0.1, 0.9])


def test_a_file_of_version_7_3_is_read(tmp_path):
    h5py = pytest.importorskip('h5py')
    path = tmp_path / 'run.mat'
    with h5py.File(path, 'w', userblock_size=512) as file:
        for name in ('t', 'tension_l', 'tension_s'):
            values = file.create_dataset(name, data=np.array(COLUMNS[name])[None, :])
            values.attrs['MATLAB_class'] = np.bytes_('double')
    head = b'MATLAB 7.3 MAT-file'.ljust(124) + b'\x00\x02IM'
    with path.open('r+b') as file:
        file.write(head)
    assert load_recording(path).whole().tensions() == [(1.0, 1.5), (1.0, 1.6)]


def test_options_name_columns_and_units(tmp_path):
    path = tmp_path / 'run.mat'
    scipy_io.savemat(path, {'F1': [1000.0, 1000.0], 'F2': [1500.0, 1600.0], 'a': {'F1': [1.0]}})
    options = TableOptions(columns={'tension_l': 'F1', 'tension_s': 'F2'}, units={'tension': 'mN'})
    assert load_recording(path, table=options).tensions() == [(1.0, 1.5), (1.0, 1.6)]


def test_what_is_no_recording_is_named(tmp_path):
    path = tmp_path / 'run.mat'
    path.write_bytes(b'no such file' * 50)
    with pytest.raises(RecordingError, match=f'^{path}: it cannot be read as a MATLAB file'):
        load_recording(path)
    scipy_io.savemat(path, {'tension_l': np.ones((3, 3)), 'tension_s': [1.0]})
    with pytest.raises(RecordingError, match='tension_l holds no column of numbers'):
        load_recording(path)
