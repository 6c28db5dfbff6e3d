"""From the columns of a table to a `Recording`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..recording import Floats, Recording
from .columns import Columns
from .time_column import Times


def table_recording(
    name: str,
    columns: Columns,
    numbers: Mapping[str, Floats],
    times: Times | None,
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
    """
    said = [times.note] if times is not None and times.note else []
    return Recording(
        **numbers,  # type: ignore[arg-type]
        time=None if times is None else times.seconds,
        time_origin=0 if times is None else times.origin,
        state=state,
        in_newtons=columns.in_newtons,
        name=name,
        damage=tuple(damage),
        notes=(*notes, *said),
    )
