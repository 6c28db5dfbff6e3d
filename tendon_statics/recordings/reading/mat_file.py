"""Recordings in the ``.mat`` files of MATLAB."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import RecordingError, one_line
from ..libraries import needed
from ..progress import Progress, unseen
from ..session import Floats
from .clock_like import behaves_like_clock, may_be_clock
from .columns import find_columns
from .table import Table
from .table_options import TableOptions
from .time_column import times_of


def load_mat(
    path: Path, options: TableOptions | None = None, progress: Progress = unseen
) -> Table:
    """Read a ``.mat`` file, as `load_recording` does: each variable, or field of a struct.

    Of a field the last part of its name counts, ``run.tension_l``, where that is the only one of
    that name.
    """
    (pymatreader,) = needed('pymatreader', purpose='MATLAB files')
    path.open('rb').close()  # for the system's own reason, if it cannot be
    try:
        (content,) = progress([pymatreader.read_mat(str(path))], 'reading')
    except Exception as error:
        # Damage makes the library raise what its unpacking happens to.
        raise RecordingError(f'it cannot be read as a MATLAB file: {one_line(error)}') from None
    arrays = dict(_arrays(content))
    names = list(arrays)
    titles = [_short(name, names) for name in names]
    columns = find_columns(titles, options)

    def numbers(place: int) -> Floats:
        values = np.asarray(arrays[names[place]])
        if values.dtype.kind not in 'fiub' or values.squeeze().ndim > 1:
            raise RecordingError(f'the variable {names[place]} holds no column of numbers')
        return np.atleast_1d(values.squeeze()).astype(np.float64)

    def is_clock(place: int) -> bool:
        try:
            values = numbers(place)
        except RecordingError:
            return False
        return len(values) == count and behaves_like_clock(values)

    time = columns.time
    rest = numbers(time.nanoseconds) if time and time.nanoseconds is not None else None
    count = len(numbers(next(iter(columns.numbers.values())).place))
    others = [at for at in (() if time else columns.others) if may_be_clock(titles[at])]
    state = None
    if columns.state is not None:
        state = [str(value) for value in np.atleast_1d(arrays[names[columns.state]]).tolist()]
    return Table(
        path.name,
        columns,
        {name: numbers(column.place) * column.factor for name, column in columns.numbers.items()},
        None if time is None else times_of(time, numbers(time.place), rest),
        next((titles[at] for at in others if is_clock(at)), None),
        state,
    )


def _arrays(content: Mapping[str, Any], prefix: str = '') -> Iterator[tuple[str, Any]]:
    """Name with dots and value of every variable that is no struct."""
    for name, value in content.items():
        if name.startswith('__'):
            continue
        if isinstance(value, Mapping):
            yield from _arrays(value, f'{prefix}{name}.')
        else:
            yield f'{prefix}{name}', value


def _short(name: str, names: list[str]) -> str:
    last = name.rpartition('.')[2]
    alike = [other for other in names if other.rpartition('.')[2] == last]
    return last if len(alike) == 1 else name
