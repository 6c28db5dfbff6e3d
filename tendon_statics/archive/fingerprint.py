"""By what a recording is known again: the hash of its content."""

from __future__ import annotations

import hashlib
from pathlib import Path

from ..recordings.reading.bag_folder import files_of_bag

BLOCK = 1 << 20
"""Bytes that are read at once"""


def fingerprint(path: Path) -> str:
    """Return the SHA-256 of a recording, in hexadecimal digits.

    Of a file it is that of its content, as ``sha256sum`` gives it; of several, a bag's folder or
    a ``.db3`` with what SQLite keeps beside it of a killed recorder, ``-wal`` or ``-journal``,
    that of the list which ``sha256sum`` prints.

    Raises
    ------
    OSError
        If it cannot be read.
    """
    files = files_of_bag(path)
    if files == [path]:
        return _sha256(path)
    listed = ''.join(f'{_sha256(file)}  {file.name}\n' for file in files)
    return hashlib.sha256(listed.encode()).hexdigest()


def _sha256(path: Path) -> str:
    found = hashlib.sha256()
    with path.open('rb') as file:
        while block := file.read(BLOCK):
            found.update(block)
    return found.hexdigest()
