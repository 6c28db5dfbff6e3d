"""Recordings in Parquet files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..errors import RecordingError
from ..libraries import needed
from ..progress import Progress, unseen
from ..recording import Floats, Recording
from .columns import Column, find_columns


def load_parquet(path: Path, progress: Progress = unseen) -> Recording:
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
        columns = find_columns(file.schema_arrow.names)
        titles = [file.schema_arrow.names[column.place] for column in columns.values()]
        first_row = 0
        for group in progress(range(file.num_row_groups), 'reading'):
            rows = file.metadata.row_group(group).num_rows
            try:
                part = file.read_row_group(group, columns=titles)
                part.validate(full=True)  # texts are UTF-8
                tables.append(part)
            except Exception as error:
                damage.append(f'rows {first_row} to {first_row + rows - 1}: {error}')
            first_row += rows
    table = pa.concat_tables(tables) if tables else None
    if table is None or len(table) == 0:
        why = f'; {damage[0]}' if damage else ''
        raise RecordingError(f'there is no row of tensions in it{why}')

    def numbers(column: Column) -> Floats:
        title = file.schema_arrow.names[column.place]
        try:
            values = table[title].cast(pa.float64()).to_numpy()
        except pa.ArrowException:
            raise RecordingError(f'the column {title} holds no numbers') from None
        return np.asarray(values, dtype=np.float64) * column.factor

    state = None
    if 'state' in columns:
        title = file.schema_arrow.names[columns.pop('state').place]
        state = [str(value or '') for value in table[title].to_pylist()]
    return Recording(
        **{name: numbers(column) for name, column in columns.items()},  # type: ignore[arg-type]
        state=state,
        name=path.name,
        damage=tuple(damage),
    )
