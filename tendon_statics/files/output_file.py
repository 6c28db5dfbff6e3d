"""Files that appear whole, or not at all."""

from __future__ import annotations

import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..physics.errors import TendonStaticsError


class OutputError(TendonStaticsError, ValueError):
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
        mode = _mode(path)
        # Named before it is made: an interruption may come as soon as it is there.
        temporary = path.with_name(f'.{path.stem}-{secrets.token_hex(8)}{path.suffix}')
        try:
            os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600))
            temporary.chmod(mode)
            yield temporary
            with temporary.open('rb') as written:
                os.fsync(written.fileno())
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f'{path}: it cannot be written: {error.strerror}') from None


def _mode(path: Path) -> int:
    """Permissions of the existing file, or those that a new one gets.

    Raises
    ------
    OutputError
        If something else is there.
    """
    with suppress(FileNotFoundError):
        there = path.stat().st_mode  # At one look, since others may write or remove it.
        if not stat.S_ISREG(there):
            raise OutputError(f'{path}: it cannot be written: it is not a file')
        return stat.S_IMODE(there)
    umask = os.umask(0)
    os.umask(umask)
    return 0o666 & ~umask
