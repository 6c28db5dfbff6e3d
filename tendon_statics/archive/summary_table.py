"""The summary of an archive as a table of Parquet: a row for each recording."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

from ..estimation.regimes import INVALID
from ..physics import Regime
from .row import Row

OF_REGIMES = tuple(f'samples_{name}' for name in (*(regime.value for regime in Regime), INVALID))
"""Columns in place of `Row.regimes`"""

_KINDS = {'str': 'string', 'int | None': 'int64', 'float | None': 'float64'}
_APART = ('regimes', 'fitted')


def summary_columns() -> list[str]:
    """Columns of the summary but for those of fitted parameters."""
    return [*(field.name for field in _plain_fields()), *OF_REGIMES]


def summary_table(pa: Any, rows: Sequence[Row]) -> Any:
    """Make a table; what is not known is null, and so is an empty text.

    Parameters
    ----------
    pa : module
        pyarrow.
    """
    arrays = {}
    for field in _plain_fields():
        kind = _KINDS.get(str(field.type))
        values = [getattr(row, field.name) for row in rows]
        if kind is None:
            arrays[field.name] = pa.array(map(list, values), pa.list_(pa.string()))
        else:
            arrays[field.name] = pa.array([None if v == '' else v for v in values], kind)
    for name in OF_REGIMES:
        counts = [row.regimes.get(name.removeprefix('samples_'), 0) for row in rows]
        known = [n if row.is_replayed else None for n, row in zip(counts, rows, strict=True)]
        arrays[name] = pa.array(known, pa.int64())
    for name in sorted({name for row in rows for name in row.fitted}):
        pairs = [row.fitted.get(name, (None, None)) for row in rows]
        arrays[f'fitted_{name}'] = pa.array([value for value, _ in pairs], pa.float64())
        arrays[f'fitted_{name}_stderr'] = pa.array([error for _, error in pairs], pa.float64())
    return pa.table(arrays)


def _plain_fields() -> list[dataclasses.Field[Any]]:
    return [field for field in dataclasses.fields(Row) if field.name not in _APART]
