"""Recordings in CSV files."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from .columns import Column, find_columns
from .errors import RecordingError
from .progress import Progress, unseen
from .recording import Recording


def load_csv(path: Path, progress: Progress = unseen) -> Recording:
    """Read a CSV file whose first line names the columns, as `load_recording` does.

    Empty lines and lines that begin with ``#`` are left alone; an empty field is NaN. A line that
    is not as long as the first, or has no number where there should be one, is damage.
    """
    try:
        lines = path.read_text(encoding='utf-8-sig').splitlines()
    except UnicodeDecodeError:
        raise RecordingError('it is not a text file in UTF-8') from None
    numbered = [
        (number, line)
        for number, line in enumerate(lines, start=1)
        if line.strip() and not line.startswith('#')
    ]
    titles = _fields(numbered[0][1]) if numbered else []
    columns = find_columns(titles)
    values: dict[str, list[float]] = {name: [] for name in columns if name != 'state'}
    states: list[str] = []
    damage = []
    for number, line in progress(numbered[1:], 'reading'):
        fields = _fields(line)
        try:
            row = [_number(fields, columns[name]) for name in values]
            if len(fields) != len(titles):
                raise ValueError(f'{len(fields)} fields')
        except (ValueError, IndexError):
            damage.append(f'line {number}, {line!r}, is not a row of {",".join(titles)}')
            continue
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


def _number(fields: list[str], column: Column) -> float:
    text = fields[column.place]
    return column.factor * float(text) if text else math.nan


def _fields(line: str) -> list[str]:
    fields = next(csv.reader([line])) if '"' in line else line.split(',')
    return [field.strip() for field in fields]
