"""What was read of a table, and the recording that it is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..arm_recording import ArmRecording
from ..recording import Recording
from ..session import OF_LOAD, Floats
from .columns import Columns
from .time_column import Times


class Table(NamedTuple):
    """What was read of a table."""

    name: str
    columns: Columns
    numbers: Mapping[str, Floats]
    """Values in SI by quantity, without the time"""
    times: Times | None
    clock_like: str | None = None
    """Title of a column that behaves like a clock, if there are no times"""
    state: Sequence[str] | None = None
    damage: Sequence[str] = ()
    notes: Sequence[str] = ()

    @property
    def _common(self) -> dict[str, Any]:
        why = self._unknown_times
        times = None if why else self.times
        said = [times.note] if times is not None and times.note else []
        return {
            'time': None if times is None else times.seconds,
            'unknown_times': why,
            'time_origin': 0 if times is None else times.origin,
            'in_newtons': self.columns.in_newtons,
            'marked': frozenset(
                name for name, column in self.columns.numbers.items() if column.has_unit
            ),
            'name': self.name,
            'damage': tuple(self.damage),
            'notes': (*self.notes, *self.columns.notes, *said),
        }

    @property
    def _unknown_times(self) -> str:
        """Why there are no times although there seems to be a clock, if that is so."""
        if self.clock_like is not None:
            what, way = (
                (f'the column {self.clock_like!r}', f'--columns time="{self.clock_like}" says so')
                if self.clock_like
                else ('a column without a title', 'call it time')
            )
            return (
                f'{what} behaves like a clock, but is not known to be one: if it is the time, '
                f'{way}; if not, --rate HZ makes times'
            )
        column, times = self.columns.time, self.times
        if times is not None and column is not None and not _advances(times.seconds):
            return (
                f'the column {column.title!r} does not tell times, as it has the same in every '
                'row, or nothing: --columns time=TITLE names another, --rate HZ makes times'
            )
        return ''

    def of_unit(self) -> Recording:
        """Return the recording of a single unit."""
        return Recording(state=self.state, **self.numbers, **self._common)  # type: ignore[arg-type]

    def of_arm(self, cables: Sequence[str], joints: int) -> ArmRecording:
        """Return the recording of an arm with cables of these names, and so many joints."""
        numbers = self.numbers
        angles = {joint: f'bend_angle_{joint}' for joint in range(1, joints + 1)}
        load: dict[str, Any] = {name: numbers[name] for name in OF_LOAD if name in numbers}
        return ArmRecording(
            {cable: numbers[cable] for cable in cables},
            {joint: numbers[name] for joint, name in angles.items() if name in numbers},
            **load,
            **self._common,
        )


def _advances(seconds: Floats) -> bool:
    """Whether not all rows have one time, or none; one row has nothing to advance to."""
    known = seconds[np.isfinite(seconds)]
    return len(seconds) < 2 or (len(known) > 0 and bool((known != known[0]).any()))
