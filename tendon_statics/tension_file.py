"""Recorded cable tensions in CSV files."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import NamedTuple

COLUMNS = ('tension_l', 'tension_s')


class TensionFileError(ValueError):
    """A file that holds no recorded tensions."""


class Sample(NamedTuple):
    """One row of a recording."""

    tension_l: float
    """N"""
    tension_s: float
    """N"""
    time: float | None = None
    """s; None if the recording has no times"""


def load_tensions(path: str | Path) -> list[Sample]:
    """Read recorded tensions from a CSV file with a header.

    The columns are ``tension_l`` and ``tension_s`` in N and, if there are times, ``time`` in s;
    others are left alone, and so are empty lines and lines that begin with ``#``. Values need not
    be valid tensions: a recording may hold NaN.

    Raises
    ------
    TensionFileError
        If the file cannot be read, lacks a column or has no row, or a value is not a number; the
        text names the file and the line.
    """
    try:
        lines = Path(path).read_text(encoding='utf-8').splitlines()
    except OSError as error:
        raise TensionFileError(f'{path}: it cannot be read: {error.strerror}') from None
    except UnicodeDecodeError:
        raise TensionFileError(f'{path}: it is not a text file in UTF-8') from None
    numbered = [
        (number, line)
        for number, line in enumerate(lines, start=1)
        if line.strip() and not line.startswith('#')
    ]
    header = _fields(numbered[0][1]) if numbered else []
    for column in COLUMNS:
        if column not in header:
            raise TensionFileError(
                f'{path}: there is no column {column}; the first line names the columns, '
                f'{",".join(COLUMNS)}'
            )
    columns = [*COLUMNS, 'time'] if 'time' in header else list(COLUMNS)
    places = [header.index(column) for column in columns]
    samples = []
    for number, line in numbered[1:]:
        row = _fields(line)
        try:
            samples.append(Sample(*(float(row[place]) for place in places)))
        except (ValueError, IndexError):
            raise TensionFileError(
                f'{path}, line {number}: {line!r} is not a number in each of {", ".join(columns)}'
            ) from None
    if not samples:
        raise TensionFileError(f'{path}: there is no row of tensions in it')
    return samples


def _fields(line: str) -> list[str]:
    return [field.strip() for field in next(csv.reader([line]))]
