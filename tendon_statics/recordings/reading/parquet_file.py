"""Recordings in Parquet files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import RecordingError
from ..libraries import needed
from ..progress import Progress, unseen
from ..session import Floats
from .clock_like import behaves_like_clock, may_be_clock
from .columns import find_columns
from .moments import UNKNOWN, is_of_day
from .table import Table
from .table_options import TableOptions
from .time_column import (
    TimeColumn,
    Times,
    times_of,
    times_of_day,
    times_of_moments,
    times_of_nanoseconds,
)


def load_parquet(
    path: Path, options: TableOptions | None = None, progress: Progress = unseen
) -> Table:
    """Read a Parquet file, as `load_recording` does; a missing value is NaN.

    A row group that cannot be read is damage; without the file's end nothing can.
    """
    pa, parquet = needed('pyarrow', 'pyarrow.parquet', purpose='Parquet files')
    damage, tables = [], []
    path.open('rb').close()  # for the system's own reason, if it cannot be
    try:
        file = parquet.ParquetFile(path, page_checksum_verification=True)
    except Exception as error:
        # Damage makes the library raise what its unpacking happens to.
        raise RecordingError(f'it cannot be read as Parquet: {error}') from None
    with file:
        titles = list(file.schema_arrow.names)
        columns = find_columns(titles, options)
        moments = [] if columns.time else _moments(file.schema_arrow, columns.others)
        time = moments[0] if len(moments) == 1 else columns.time
        if moments and time is not None:
            unused = tuple(title for title in columns.unused if title != time.title)
            columns = columns._replace(unused=unused)
        places = [column.place for column in columns.numbers.values()]
        may_be = [
            place
            for place in (columns.others if time is None else ())
            if may_be_clock(titles[place]) and _is_number(file.schema_arrow.field(place).type)
        ]
        places += may_be if time is None else time.places
        if columns.state is not None:
            places.append(columns.state)
        first_row = 0
        for group in progress(range(file.num_row_groups), 'reading'):
            rows = file.metadata.row_group(group).num_rows
            try:
                part = file.read_row_group(group, columns=[titles[place] for place in places])
                part.validate(full=True)  # texts are UTF-8
                tables.append(part)
            except Exception as error:
                damage.append(f'rows {first_row} to {first_row + rows - 1}: {error}')
            first_row += rows
    table = pa.concat_tables(tables) if tables else None
    if table is None or len(table) == 0:
        why = f'; {damage[0]}' if damage else ''
        raise RecordingError(f'there is no row of tensions in it{why}')

    def numbers(place: int) -> Floats:
        title = titles[place]
        try:
            values = table[title].cast(pa.float64()).to_numpy()
        except pa.ArrowException:
            raise RecordingError(f'the column {title} holds no numbers') from None
        return np.asarray(values, dtype=np.float64)

    def times(column: TimeColumn) -> Times:
        values = table[titles[column.place]]
        if pa.types.is_dictionary(values.type):
            values = values.cast(values.type.value_type)
        if pa.types.is_time(values.type) and column.date is None:
            of_day = values.cast(pa.time64('ns')).cast(pa.int64()).fill_null(UNKNOWN)
            return times_of_day(column, of_day.to_numpy())
        if pa.types.is_timestamp(values.type) or pa.types.is_date(values.type):
            moments = values.cast(pa.timestamp('ns'), safe=False).to_numpy()
            return times_of_nanoseconds(column, moments.astype('datetime64[ns]').astype(np.int64))
        if pa.types.is_duration(values.type):
            spans = values.cast(pa.duration('ns'), safe=False).cast(pa.int64()).cast(pa.float64())
            return times_of(column._replace(unit='ns'), spans.to_numpy())
        if pa.types.is_time(values.type):
            values = values.cast(pa.time64('us'), safe=False).cast(pa.string())
        if pa.types.is_string(values.type) or pa.types.is_large_string(values.type):
            texts = [value or '' for value in values.to_pylist()]
            dates = texts if column.date is None else table[titles[column.date]].to_pylist()
            return times_of_moments(column, [*map(_on_its_day, texts, dates)])
        rest = None if column.nanoseconds is None else numbers(column.nanoseconds)
        return times_of(column, numbers(column.place), rest)

    def clocks() -> Iterator[str]:
        """Titles of what behaves like a clock, where there are no times for sure."""
        if time is None:
            yield from (column.title for column in moments)
            yield from (titles[place] for place in may_be if behaves_like_clock(numbers(place)))

    state = None
    if columns.state is not None:
        state = [str(value or '') for value in table[titles[columns.state]].to_pylist()]
    return Table(
        path.name,
        columns,
        {name: numbers(column.place) * column.factor for name, column in columns.numbers.items()},
        None if time is None else times(time),
        next(clocks(), None),
        state,
        damage=damage,
    )


def _on_its_day(text: str, date: object) -> str:
    """Put the date that stands beside a time of day before it."""
    return (
        f'{str(date).partition(" 00:00")[0]} {text}'
        if date is not None and is_of_day(text)
        else text
    )


def _moments(schema: Any, others: Sequence[int]) -> list[TimeColumn]:
    """Columns of moments, whatever they are called; one alone is the index of pandas."""
    return [
        TimeColumn(place, schema.field(place).name)
        for place in others
        if str(schema.field(place).type).startswith('timestamp')
    ]


def _is_number(kind: Any) -> bool:
    return str(kind).startswith(('int', 'uint', 'float', 'double', 'half'))
