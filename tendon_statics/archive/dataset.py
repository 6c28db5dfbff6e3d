"""The data set of an archive: a part for each recording, which appears whole or not at all."""

from __future__ import annotations

import fcntl
import glob
import json
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import quote

from numpy.typing import NDArray

from ..files.output_file import OutputError, output_file
from ..recordings.libraries import needed
from ..recordings.reading.units import OF_UNIT
from ..recordings.session import OF_LOAD
from . import PURPOSE
from .row import Row
from .summary_table import summary_table

SAMPLES = 'samples'
LOCK = f'.{SAMPLES}.lock'
KEY = 'recording='
PART = 'part.parquet'
SUMMARY = 'summary.parquet'
PAGE = 'index.html'

LONGEST = 240
"""Bytes of a name in that of a folder, of which file systems take 255"""

NUMBERS = (
    *('time', 'tension_l', 'tension_s', *OF_UNIT.readings, 'bend_angle', 'pressure', *OF_LOAD),
    *('estimated_bend_angle', 'estimated_bend_angle_stddev'),
    *('estimated_pressure', 'estimated_pressure_stddev', 'slip_margin'),
)
TEXTS = ('state', 'regime', 'validity')
TRUTHS = ('angle_assured',)

_ROW = b'tendon_statics.recording'
"""Of the metadata of a part: its row of the summary, as JSON"""

Columns = Mapping[str, NDArray[Any]]


def is_dataset(folder: Path) -> bool:
    """Whether a folder is the data set of an archive, finished or only just begun."""
    return (folder / LOCK).is_file()


def short_enough(recording: str) -> str:
    """Return the name of a recording, cut if no folder could be called after it."""
    if len(_quoted(recording)) <= LONGEST:
        return recording
    digest = sha256(recording.encode()).hexdigest()[:16]
    length = len(recording)
    while len(_quoted(recording[:length])) > LONGEST - len(digest) - 3:
        length -= 1
    return f'{recording[:length]}...{digest}'


def _quoted(recording: str) -> str:
    """Return a name as it stands in that of a folder: readers of Parquet undo it."""
    return quote(recording, safe=' +,@()')


class Dataset:
    """A folder with a Parquet file for each recording, a summary and a page.

    All parts have the same columns, null where something was not measured or not determined. The
    row of the summary stands in each part, so that there is no part without it.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()
        self._samples = self.folder / SAMPLES

    @contextmanager
    def held(self) -> Iterator[None]:
        """Make the folder and keep others from writing to it; what a killed run left half is gone.

        Raises
        ------
        OutputError
            If it has other things in it, cannot be made, or is being written to.
        """
        needed('pyarrow', purpose=PURPOSE)
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            # The lock is the first thing in a new folder, so that whatever is seen of one that
            # another archive has just begun is known for its own.
            if any(self.folder.iterdir()) and not is_dataset(self.folder):
                raise OutputError(
                    f'{self.folder}: it has other things in it; name a new folder, or the data '
                    'set of an earlier archive'
                )
            with (self.folder / LOCK).open('w') as lock:
                try:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    raise OutputError(
                        f'{self.folder}: another archive is being written there; wait for it or '
                        'name another folder'
                    ) from None
                self._samples.mkdir(exist_ok=True)
                # A worker of the killed run may end it now, or remove the folder: unlike a
                # path's own, this `glob` passes over what is gone.
                for half in glob.glob(f'{KEY}*/.*', root_dir=self._samples):  # noqa: PTH207
                    (self._samples / half).unlink(missing_ok=True)
                yield
        except OSError as error:
            raise OutputError(f'{self.folder}: it cannot be written: {error.strerror}') from None

    def part(self, recording: str) -> Path:
        """Return the file of a recording's samples."""
        return self._samples / f'{KEY}{_quoted(recording)}' / PART

    def row(self, recording: str) -> Row | None:
        """Return what was told of a recording when its part was written; None without one."""
        return self._row(self.part(recording))

    def rows(self) -> Iterator[Row]:
        """Rows of all parts."""
        for path in sorted(self._samples.glob(f'{KEY}*/{PART}')):
            row = self._row(path)
            if row is not None:
                yield row

    def _row(self, path: Path) -> Row | None:
        (parquet,) = needed('pyarrow.parquet', purpose=PURPOSE)
        try:
            metadata = parquet.read_schema(path).metadata or {}
            return Row.of_dict(json.loads(metadata[_ROW]))
        except (OSError, ValueError, KeyError, TypeError):
            return None  # Not there, or written by something else.

    def write(self, row: Row, columns: Columns) -> None:
        """Write the samples of a recording in place of those there were.

        Raises
        ------
        OutputError
            If they cannot be written.
        """
        pa, parquet = needed('pyarrow', 'pyarrow.parquet', purpose=PURPOSE)
        length = len(columns['tension_l'])
        kinds = [(NUMBERS, pa.float64()), (TEXTS, pa.string()), (TRUTHS, pa.bool_())]
        arrays = {
            name: pa.array(columns[name], kind, from_pandas=True)
            if name in columns
            else pa.nulls(length, kind)
            for names, kind in kinds
            for name in names
        }
        table = pa.table(arrays).replace_schema_metadata({_ROW: json.dumps(row.as_dict())})
        path = self.part(row.recording)
        path.parent.mkdir(parents=True, exist_ok=True)
        with output_file(path) as temporary:
            parquet.write_table(table, temporary, compression='zstd')

    def remove(self, recording: str) -> None:
        """Remove the samples of a recording, if there are any."""
        shutil.rmtree(self.part(recording).parent, ignore_errors=True)

    def write_summary(self, rows: list[Row]) -> None:
        """Write a row for each recording.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        pa, parquet = needed('pyarrow', 'pyarrow.parquet', purpose=PURPOSE)
        with output_file(self.folder / SUMMARY) as temporary:
            parquet.write_table(summary_table(pa, rows), temporary, compression='zstd')
