"""What recordings of a unit and of an arm have in common: times, load, and how they were read."""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from ..physics import Load
from ..physics.sample_loads import SampleLoads
from .errors import RecordingError, one_line

Floats = npt.NDArray[np.float64]

OF_LOAD = ('base_tilt', 'base_roll', 'tip_force_x', 'tip_force_z')
"""What may have been measured of the load"""

MOST_NAMED = 3
"""Damaged places that are named one by one; of more, the rest is counted"""

Own = TypeVar('Own', bound='Session')


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Session(ABC):
    """Samples in the order of a file; SI units, angles in rad.

    All arrays have the shape ``(n,)``. A sample may hold NaN or tensions that the model does not
    take: it is kept, and whoever uses the recording says what becomes of it. So are samples whose
    times are not in order; what needs the order asks for it by `in_order`.
    """

    time: Floats | None = None
    """s"""
    time_origin: int = 0
    """ns of the Unix epoch at which `time` is 0, where that is known"""
    unknown_times: str = ''
    """Why there are no times although there seems to be a clock, so that there may be gaps"""
    clock: str = ''
    """Of a bag, what `time` is by: ``stamp`` or ``log``, topic by topic where they differ"""
    name: str = 'recording'
    """Where it comes from, without the folder"""
    damage: tuple[str, ...] = ()
    """What of the file could not be read, place by place, each in one line"""
    faults: Sequence[str] | None = None
    """Why a sample holds no tensions of all cables, a `Reason` or empty; None: nothing is known"""
    in_newtons: bool = False
    """Whether the tensions are in N for certain, so that no gain or bias applies to them"""
    marked: frozenset[str] = frozenset()
    """Quantities whose unit was said, and not taken to be that of SI"""
    notes: tuple[str, ...] = ()
    """What was recognised in the file, and what else is to be known of it, each in one line"""
    base_tilt: Floats | None = None
    """Measured γ in rad, the tilt of the base in the plane of bending towards cable s, NaN where
    there is none; None if it was not recorded"""
    base_roll: Floats | None = None
    """Measured tilt of the base out of that plane in rad, beside `base_tilt`; None: it has none"""
    tip_force_x: Floats | None = None
    """Measured force at the tip in N in the frame of the base, along X, likewise"""
    tip_force_z: Floats | None = None
    """Along Z"""

    def __post_init__(self) -> None:
        """Take whatever NumPy can make an array of.

        Raises
        ------
        RecordingError
            If the arrays are not of one length.
        """
        for quantity in ('time', *OF_LOAD):
            values = getattr(self, quantity)
            if values is not None:
                object.__setattr__(self, quantity, self._array(quantity, values))
        if self.faults is not None:
            object.__setattr__(self, 'faults', self._list('faults', self.faults))
        for lines in ('damage', 'notes'):
            object.__setattr__(self, lines, tuple(map(one_line, getattr(self, lines))))

    @abstractmethod
    def cables(self) -> tuple[Floats, ...]:
        """Tensions of each cable in N, in the order of the unit or arm."""

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.cables()[0])

    def tensions(self) -> list[tuple[float, ...]]:
        """Tensions of all cables of every sample, as plain numbers in N."""
        return list(zip(*(tensions.tolist() for tensions in self.cables()), strict=True))

    def loads(self, load: Load) -> Load | list[Load]:
        """Return what acts beside the cables: one load, or that of each sample.

        Where it was not measured it is what it was before, as the node takes it, and at the
        beginning what it came to be.

        Parameters
        ----------
        load : Load
            What of it was not recorded.
        """
        return self.sample_loads(load).loads() if self.has_load else load

    def sample_loads(self, load: Load) -> SampleLoads:
        """Return the same as arrays, of each sample in any case."""
        return SampleLoads.of(
            load,
            len(self),
            **{
                quantity: None if values is None else _last_known(values)
                for quantity in OF_LOAD
                for values in [getattr(self, quantity)]
            },
        )

    @property
    def has_load(self) -> bool:
        """Whether anything of the load was measured."""
        return any(getattr(self, quantity) is not None for quantity in OF_LOAD)

    @property
    def known_faults(self) -> Sequence[str]:
        """Why each sample holds no tensions of the unit; empty where nothing is known."""
        return [''] * len(self) if self.faults is None else self.faults

    @property
    def damage_summary(self) -> str:
        """What could not be read, in one line; empty if all could."""
        return summary_of_damage(self.damage)

    @property
    def disorder(self) -> str:
        """Where time goes back from one sample to the next, in one line; empty if nowhere.

        A sample without a time is taken to stand where it belongs.
        """
        if self.time is None:
            return ''
        timed = np.flatnonzero(~np.isnan(self.time))
        back = timed[1:][self.time[timed[1:]] < self.time[timed[:-1]]]
        if not len(back):
            return ''
        before = timed[np.searchsorted(timed, back[0]) - 1]
        more = f', and back at {len(back) - 1} more' if len(back) > 1 else ''
        return (
            f'time goes back from {self.time[before]:.9g} s to {self.time[back[0]]:.9g} s '
            f'at sample {back[0] + 1} of {len(self)}{more}'
        )

    def in_order(self: Own) -> Own:
        """Return the recording if no sample is earlier than the one before it.

        Raises
        ------
        RecordingError
            If one is; the text names the first.
        """
        if self.disorder:
            raise RecordingError(
                f'{self.name}: {self.disorder}: sort it by time, or, if its order is right, leave '
                'the times out or, of a bag, take those of recording (--clock log)'
            )
        return self

    def whole(self: Own) -> Own:
        """Return the recording if all of its file could be read.

        Raises
        ------
        RecordingError
            If not; the text names what could not.
        """
        if self.damage:
            raise RecordingError(f'{self.name}: {self.damage_summary}')
        return self

    def _array(self, name: str, values: Any) -> Floats:
        found = numbers_of(values)
        self._check_length(name, found)
        return found

    def _list(self, name: str, values: Sequence[str]) -> list[str]:
        self._check_length(name, values)
        return list(values)

    def _check_length(self, name: str, values: Sequence[Any] | Floats) -> None:
        if len(values) != len(self):
            raise RecordingError(
                f'there are tensions of {len(self)} samples, and {len(values)} values of {name}'
            )


def numbers_of(values: Any) -> Floats:
    """Return an array of shape ``(n,)`` of whatever NumPy can make one of."""
    return np.atleast_1d(np.asarray(values, dtype=np.float64))


def summary_of_damage(places: Sequence[str]) -> str:
    """Return what could not be read, in one line."""
    named = '; '.join(places[:MOST_NAMED])
    more = len(places) - MOST_NAMED
    return named + (f'; and {more} more such places' if more > 0 else '')


def _last_known(values: Floats) -> Floats:
    """Values with the last known one in place of every NaN, and the first one before it."""
    known = np.flatnonzero(np.isfinite(values))
    if not len(known):
        return np.zeros(len(values))
    places = np.searchsorted(known, np.arange(len(values)), side='right') - 1
    filled: Floats = values[known[places.clip(0)]]
    return filled
