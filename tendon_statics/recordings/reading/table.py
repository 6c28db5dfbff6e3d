"""From the columns of a table to a `Recording`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..recording import Floats, Recording
from .columns import Columns
from .time_column import Times


def table_recording(
    name: str,
    columns: Columns,
    numbers: Mapping[str, Floats],
    times: Times | None,
    clock_like: str | None,
    state: Sequence[str] | None,
    *,
    damage: Sequence[str] = (),
    notes: Sequence[str] = (),
) -> Recording:
    """Put together what was read of a table.

    Parameters
    ----------
    numbers : mapping
        Values in SI by quantity, without the time.
    clock_like : str
        Title of a column that behaves like a clock, if there are no times, or None.
    """
    said = [times.note] if times is not None and times.note else []
    why = ''
    if clock_like is not None:
        what, way = (
            (f'the column {clock_like!r}', f'--columns time="{clock_like}" says so')
            if clock_like
            else ('a column without a title', 'call it time')
        )
        why = (
            f'{what} behaves like a clock, but is not known to be one: if it is the time, {way}; '
            'if not, --rate HZ makes times'
        )
    elif times is not None and columns.time is not None and not _advances(times.seconds):
        why = (
            f'the column {columns.time.title!r} does not tell times, as it has the same in every '
            'row, or nothing: --columns time=TITLE names another, --rate HZ makes times'
        )
        times, said = None, []
    return Recording(
        **numbers,  # type: ignore[arg-type]
        time=None if times is None else times.seconds,
        unknown_times=why,
        time_origin=0 if times is None else times.origin,
        state=state,
        in_newtons=columns.in_newtons,
        name=name,
        damage=tuple(damage),
        notes=(*notes, *said),
    )


def _advances(seconds: Floats) -> bool:
    """Whether not all rows have one time, or none; one row has nothing to advance to."""
    known = seconds[np.isfinite(seconds)]
    return len(seconds) < 2 or (len(known) > 0 and bool((known != known[0]).any()))
