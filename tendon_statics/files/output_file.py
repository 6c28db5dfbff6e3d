"""Files that appear whole, or not at all."""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


class OutputError(ValueError):
    """An output that cannot be written."""


@contextmanager
def output_file(path: Path) -> Iterator[Path]:
    """Give the path of a temporary file to write; it takes the place of `path` on leaving.

    It lies in the same folder and has the same ending. If anything is raised, what was at `path`
    stays as it was.

    Raises
    ------
    OutputError
        If it cannot be written; the text names `path`.
    """
    path = Path(os.path.realpath(path))
    try:
        if path.exists() and not path.is_file():
            raise OutputError(f'{path}: it cannot be written: it is not a file')
        handle, name = tempfile.mkstemp(path.suffix, f'.{path.stem}-', path.parent)
        temporary = Path(name)
        try:
            os.fchmod(handle, _mode(path))
            os.close(handle)
            yield temporary
            with temporary.open('rb') as written:
                os.fsync(written.fileno())
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f'{path}: it cannot be written: {error.strerror}') from None


def _mode(path: Path) -> int:
    """Permissions of the file as it is, or as a new one gets them."""
    if path.exists():
        return stat.S_IMODE(path.stat().st_mode)
    umask = os.umask(0)
    os.umask(umask)
    return 0o666 & ~umask
