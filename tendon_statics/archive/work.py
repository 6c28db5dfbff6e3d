"""What a worker does with one recording of an archive."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from ..files.output_file import OutputError
from ..recordings.errors import one_line
from ..recordings.reading.compression import ENDINGS as COMPRESSIONS
from .dataset import Columns, Dataset
from .errors import ArchiveError
from .finding import Found
from .fingerprint import fingerprint
from .row import FAILED, UNREADABLE, Row


class Studied(NamedTuple):
    """What was found out about a recording."""

    facts: dict[str, Any]
    """Fields of its `Row`"""
    columns: Columns | None = None
    """Its samples, None if it was not replayed"""


class Outcome(NamedTuple):
    """What came of a recording."""

    row: Row
    is_new: bool
    """Whether it was worked on, and not there already"""


@dataclasses.dataclass(frozen=True)
class Work:
    """What is done with every recording, on whatever machine."""

    folder: Path
    """Of the data set"""
    options: str
    """What stands for the options and the design"""
    study: Callable[[Path], Studied]
    version: str = dataclasses.field(default_factory=lambda: version('tendon_statics'))

    def __call__(self, found: Found) -> Outcome:
        """Study a recording and write its samples, unless they are there.

        Whatever goes wrong with it is told in its row. It is known again by its content, the
        options and the version; one that could not be read or that failed is tried anew.

        Raises
        ------
        ArchiveError
            If the worker has another version of the package.
        OutputError
            If the data set cannot be written.
        """
        here = version('tendon_statics')
        if here != self.version:
            raise ArchiveError(
                f'a worker has tendon_statics {here}, and this is {self.version}; '
                'all need the same'
            )
        dataset = Dataset(self.folder)
        row = self._blank(found)
        try:
            row = dataclasses.replace(row, sha256=fingerprint(found.path))
            kept = dataset.row(found.name)
            if kept and (kept.sha256, kept.options) == (row.sha256, row.options):
                return Outcome(dataclasses.replace(kept, path=row.path), False)
            facts, columns = self.study(found.path)
            row = dataclasses.replace(row, **facts)
            if columns is not None:
                dataset.write(row, columns)
                return Outcome(row, True)
        except OutputError:
            raise
        except OSError as error:
            why = f'it cannot be read: {error.strerror or error}'
            row = dataclasses.replace(row, status=UNREADABLE, error=why)
        except Exception as error:  # One recording costs itself only.
            row = _failed(row, f'{type(error).__name__}: {error}')
        dataset.remove(found.name)
        return Outcome(row, True)

    def lost(self, found: Found) -> Outcome:
        """Return what stands for a recording whose workers all died."""
        Dataset(self.folder).remove(found.name)
        return Outcome(_failed(self._blank(found), 'every worker that took it died'), True)

    def _blank(self, found: Found) -> Row:
        return Row(found.name, str(found.path), '', self.options, _format(found.path))


def _format(path: Path) -> str:
    if path.is_dir():
        return 'bag folder'
    return ''.join(path.suffixes[-2:]) if path.suffix in COMPRESSIONS else path.suffix


def _failed(row: Row, why: str) -> Row:
    """Return the row of a recording that could not be worked on."""
    return dataclasses.replace(row, status=FAILED, error=one_line(why))
