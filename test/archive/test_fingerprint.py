"""By what an archive knows a recording again."""

import hashlib

import pytest

from tendon_statics.archive.fingerprint import fingerprint


def listed(*files):
    """As `sha256sum` lists files."""
    lines = (f'{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n' for file in files)
    return hashlib.sha256(''.join(lines).encode()).hexdigest()


def test_of_a_file_it_is_that_of_its_content(tmp_path):
    file = tmp_path / 'run.csv'
    file.write_bytes(b'a table')
    (tmp_path / 'run.csv-journal').write_bytes(b'of something else')
    assert fingerprint(file) == hashlib.sha256(b'a table').hexdigest()


@pytest.mark.parametrize('endings', [['-journal'], ['-wal'], ['-journal', '-wal']])
@pytest.mark.parametrize('is_folder', [False, True])
def test_what_is_read_with_a_database_counts_too(tmp_path, endings, is_folder):
    file = tmp_path / 'run.db3'
    file.write_bytes(b'a database')
    path = tmp_path if is_folder else file
    before = fingerprint(path)
    beside = [tmp_path / f'run.db3{ending}' for ending in endings]
    for part in beside:
        part.write_bytes(b'one')
    assert fingerprint(path) == listed(file, *beside) != before
    beside[-1].write_bytes(b'two')
    assert fingerprint(path) == listed(file, *beside)
