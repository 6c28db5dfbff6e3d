"""A recorded session of an arm: the tensions of its cables, and measured angles of its joints."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from .session import Floats, Session, numbers_of


@dataclasses.dataclass(frozen=True, eq=False)
class ArmRecording(Session):
    """Samples of an arm, as `Session` says; SI units, angles in rad."""

    cable_tensions: Mapping[str, Floats]
    """Of each cable by name in N, at the base, in the arm's order"""
    bend_angles: Mapping[int, Floats] = dataclasses.field(default_factory=dict)
    """Measured θ in rad of each joint that has an encoder, counted from 1 at the base, NaN where
    there is none"""
    readings: Mapping[str, Floats] | None = None
    """What was recorded of each cable, where a gain and bias made tensions of it"""

    def __post_init__(self) -> None:
        """Take whatever NumPy can make an array of.

        Raises
        ------
        RecordingError
            If the arrays are not of one length.
        """
        first = {name: numbers_of(values) for name, values in self.cable_tensions.items()}
        object.__setattr__(self, 'cable_tensions', first)
        for name, values in first.items():
            self._check_length(name, values)
        angles = {
            joint: self._array(f'bend_angle_{joint}', values)
            for joint, values in self.bend_angles.items()
        }
        object.__setattr__(self, 'bend_angles', angles)
        super().__post_init__()

    def cables(self) -> tuple[Floats, ...]:
        """Tensions of each cable in N, in the arm's order."""
        return tuple(self.cable_tensions.values())
