"""Columns written to CSV, Parquet or NPZ files."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from numpy.typing import NDArray

from ...files.output_file import OutputError, output_file
from ..libraries import needed
from ..progress import Progress, unseen

Columns = Mapping[str, NDArray[Any]]

ROWS = 20_000
"""Rows of a CSV file written at once, after which progress is shown"""


def write_table(path: Path, columns: Columns, progress: Progress = unseen) -> None:
    """Write columns of one length to a ``.csv`` or ``.parquet`` file.

    Raises
    ------
    OutputError
        If the ending is neither, or the file cannot be written.
    RecordingError
        If a library is missing.
    """
    if path.suffix == '.csv':
        with (
            output_file(path) as temporary,
            temporary.open('w', encoding='utf-8', newline='') as file,
        ):
            write_csv(file, columns, progress)
    elif path.suffix == '.parquet':
        pa, parquet = needed('pyarrow', 'pyarrow.parquet', purpose='Parquet files')
        with output_file(path) as temporary:
            parquet.write_table(pa.table(dict(columns)), temporary)
    else:
        raise OutputError(f'{path}: a table is written to a file ending in .csv or .parquet')


def write_csv(file: TextIO, columns: Columns, progress: Progress = unseen) -> None:
    """Write columns of one length as CSV; NaN is an empty field."""
    writer = csv.writer(file, lineterminator='\n')
    writer.writerow(columns)
    length = max(map(len, columns.values()))
    for start in progress(range(0, length, ROWS), 'writing'):
        block = (_fields(values[start : start + ROWS]) for values in columns.values())
        writer.writerows(zip(*block, strict=True))


def _fields(values: NDArray[Any]) -> list[object]:
    fields: list[object] = values.tolist()
    if values.dtype.kind == 'f':
        for missing in np.flatnonzero(np.isnan(values)).tolist():
            fields[missing] = ''
    return fields


def write_arrays(path: Path, arrays: Columns) -> None:
    """Write arrays of any shape by name to an ``.npz`` file, compressed.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    with output_file(path) as temporary, temporary.open('wb') as file:
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type]
