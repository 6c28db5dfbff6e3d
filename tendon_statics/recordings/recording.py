"""A recorded session: cable tensions and, where they were measured, angle, pressure and state."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .session import OF_LOAD, Floats, Session, numbers_of

QUANTITIES = ('time', 'tension_l', 'tension_s', 'bend_angle', 'pressure', *OF_LOAD)
"""What a recording has numbers of; all but the tensions may be missing"""


@dataclasses.dataclass(frozen=True, eq=False)
class Recording(Session):
    """Samples of one unit, as `Session` says; SI units, angles in rad."""

    tension_l: Floats
    """T_l in N"""
    tension_s: Floats
    """T_s in N"""
    bend_angle: Floats | None = None
    """Measured θ in rad, NaN where there is none; None if it was not recorded"""
    pressure: Floats | None = None
    """Measured p in Pa, likewise"""
    state: Sequence[str] | None = None
    """``slipping`` or ``held`` where that is known of a sample, else anything"""
    readings: tuple[Floats, Floats] | None = None
    """What was recorded of cables l and s, where a gain and bias made tensions of it"""

    def __post_init__(self) -> None:
        """Take whatever NumPy can make an array of.

        Raises
        ------
        RecordingError
            If the arrays are not of one length.
        """
        object.__setattr__(self, 'tension_l', numbers_of(self.tension_l))
        for quantity in ('tension_s', 'bend_angle', 'pressure'):
            values = getattr(self, quantity)
            if values is not None:
                object.__setattr__(self, quantity, self._array(quantity, values))
        if self.state is not None:
            object.__setattr__(self, 'state', self._list('state', self.state))
        super().__post_init__()

    def cables(self) -> tuple[Floats, Floats]:
        """T_l and T_s in N."""
        return self.tension_l, self.tension_s

    def part(self, which: npt.NDArray[np.bool_]) -> Recording:
        """Return a recording of some of the samples, given as an array of shape ``(n,)``."""
        chosen = np.flatnonzero(which)

        def texts(values: Sequence[str] | None) -> list[str] | None:
            return None if values is None else [values[place] for place in chosen.tolist()]

        def numbers(values: Floats | None) -> Floats | None:
            return None if values is None else values[chosen]

        readings = self.readings
        more: dict[str, Any] = {
            quantity: numbers(getattr(self, quantity))
            for quantity in QUANTITIES
            if quantity not in ('tension_l', 'tension_s')
        }
        return dataclasses.replace(
            self,
            tension_l=self.tension_l[chosen],
            tension_s=self.tension_s[chosen],
            **more,
            state=texts(self.state),
            faults=texts(self.faults),
            readings=None if readings is None else (readings[0][chosen], readings[1][chosen]),
        )
