"""Recordings in CSV files."""

from __future__ import annotations

import codecs
import csv
import math
from collections.abc import Iterator
from pathlib import Path

from ..errors import RecordingError
from ..progress import Progress, unseen
from ..recording import Recording
from .columns import Column, find_columns

LINE_ENDS = (b'\n', b'\r')

MOST_SHOWN = 80
"""Characters of a damaged line that are shown"""


def load_csv(path: Path, progress: Progress = unseen) -> Recording:
    """Read a CSV file whose first line names the columns, as `load_recording` does.

    Empty lines and lines that begin with ``#`` are left alone; an empty field is NaN. A line that
    is not as long as the first, is not UTF-8 or has no number where there should be one is damage.
    So is a last line without an end whose last field is shorter than that of every line before:
    a number that was cut still looks like one.
    """
    numbered = list(_lines(path.read_bytes()))
    titles = _titles(numbered[0][1]) if numbered else []
    columns = find_columns(titles)
    values: dict[str, list[float]] = {name: [] for name in columns if name != 'state'}
    states: list[str] = []
    damage = []
    shortest = 0  # last field so far, in characters
    for number, line in progress(numbered[1:], 'reading'):
        try:
            fields = _fields(line)
            row = [_number(fields, columns[name]) for name in values]
            if len(fields) != len(titles):
                raise ValueError(f'{len(fields)} fields')
        except (ValueError, IndexError, csv.Error):
            damage.append(f'line {number}, {_shown(line)}, is not a row of {",".join(titles)}')
            continue
        length = len(fields[-1])
        if not line.endswith(LINE_ENDS) and length < shortest:
            damage.append(
                f'line {number}, {_shown(line)}, is shorter than all before it and has no end, '
                'so it has been cut; if it is whole, add an end of line'
            )
            continue
        shortest = min(shortest or length, length)
        for kept, value in zip(values.values(), row, strict=True):
            kept.append(value)
        if 'state' in columns:
            states.append(fields[columns['state'].place])
    if not values['tension_l']:
        why = f'; {damage[0]}' if damage else ''
        raise RecordingError(f'there is no row of tensions in it{why}')
    return Recording(
        **values,  # type: ignore[arg-type]
        state=states if 'state' in columns else None,
        name=path.name,
        damage=tuple(damage),
    )


def _lines(content: bytes) -> Iterator[tuple[int, bytes]]:
    """Give the lines that are not empty and no comments, with their numbers and ends."""
    lines = content.removeprefix(codecs.BOM_UTF8).splitlines(keepends=True)
    for number, line in enumerate(lines, start=1):
        if line.strip() and not line.startswith(b'#'):
            yield number, line


def _titles(line: bytes) -> list[str]:
    try:
        return _fields(line)
    except (ValueError, csv.Error):
        raise RecordingError(
            'it is not a text file in UTF-8 whose first line names columns'
        ) from None


def _fields(line: bytes) -> list[str]:
    text = line.decode().rstrip('\r\n')
    if '\0' in text:
        raise ValueError('a NUL')
    fields = next(csv.reader([text])) if '"' in text else text.split(',')
    return [field.strip() for field in fields]


def _number(fields: list[str], column: Column) -> float:
    text = fields[column.place]
    if '_' in text:
        raise ValueError(text)  # Python takes 1_5 for 15.
    return column.factor * float(text) if text else math.nan


def _shown(line: bytes) -> str:
    text = line.decode(errors='replace').rstrip('\r\n')
    return repr(text if len(text) <= MOST_SHOWN else f'{text[:MOST_SHOWN]}…')
