"""Tables of an arm's tensions: CSV with one column a cable."""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from ..errors import RecordingError

TIME = 'time'


class ArmTable(NamedTuple):
    """A session of an arm."""

    tensions: list[dict[str, float]]
    """Of every cable by name in N, row by row"""
    time: list[float] | None
    """In s, if the table has a column ``time``"""


def load_arm_table(path: str | Path, cables: tuple[str, ...]) -> ArmTable:
    """Read a table of tensions in N, titled with the cables' names; ``-`` is standard input.

    Titles may end in ``[N]``, that of the time in ``[s]``. Lines that begin with ``#`` are
    comments. A column ``time`` is taken along; any other that is no cable is refused, lest a
    cable go by another name.

    Raises
    ------
    RecordingError
        If it cannot be read, a cable's column is missing, or a value is not a number; the text
        names file, line and column.
    """
    name = 'standard input' if str(path) == '-' else str(path)
    try:
        if str(path) == '-':
            return _table(sys.stdin, cables)
        with Path(path).open(encoding='utf-8-sig', newline='') as file:
            return _table(file, cables)
    except OSError as error:
        raise RecordingError(f'{name}: it cannot be read: {error.strerror}') from None
    except (UnicodeDecodeError, csv.Error):
        raise RecordingError(f'{name}: it is not a CSV file in UTF-8') from None
    except RecordingError as error:
        raise RecordingError(f'{name}: {error}') from None


def _table(lines: Iterable[str], cables: tuple[str, ...]) -> ArmTable:
    numbered = [
        (number, line)
        for number, line in enumerate(lines, start=1)
        if line.strip() and not line.startswith('#')
    ]
    if len(numbered) < 2:
        raise RecordingError('there is no row of tensions in it')
    titles, *rows = csv.reader([line for _, line in numbered])
    columns = [_without_unit(title) for title in titles]
    there = ', '.join(cables)
    for column in columns:
        if columns.count(column) > 1:
            raise RecordingError(f'column {column} is there twice')
        if column != TIME and column not in cables:
            raise RecordingError(f'column {column!r} is no cable of the arm; there are {there}')
    for cable in cables:
        if cable not in columns:
            raise RecordingError(f'there is no column {cable}; the cables are {there}')
    tensions, time = [], []
    for (number, _), row in zip(numbered[1:], rows, strict=True):
        if len(row) != len(columns):
            raise RecordingError(
                f'line {number} has {len(row)} fields, but there are {len(columns)} columns'
            )
        values = dict(zip(columns, map(_number, row), strict=True))
        for column, value in values.items():
            if not math.isfinite(value):
                field = row[columns.index(column)]
                raise RecordingError(f'line {number}: {column} is {field!r}, not a number')
        time.append(values.pop(TIME, math.nan))
        tensions.append(values)
    return ArmTable(tensions, time if TIME in columns else None)


def _without_unit(title: str) -> str:
    title = title.strip()
    for unit in ('[N]', '[s]'):
        title = title.removesuffix(unit).rstrip()
    return title


def _number(field: str) -> float:
    try:
        return float(field)
    except ValueError:
        return math.nan
