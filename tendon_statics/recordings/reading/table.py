"""What was read of a table, and the recording that it is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

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
    state: Sequence[str] | None = None
    damage: Sequence[str] = ()
    notes: Sequence[str] = ()

    @property
    def _common(self) -> dict[str, Any]:
        times = self.times
        said = [times.note] if times is not None and times.note else []
        return {
            'time': None if times is None else times.seconds,
            'time_origin': 0 if times is None else times.origin,
            'in_newtons': self.columns.in_newtons,
            'name': self.name,
            'damage': tuple(self.damage),
            'notes': (*self.notes, *said),
        }

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
