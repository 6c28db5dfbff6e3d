"""The units in which a recording may stand, by what is measured."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping
from functools import cached_property
from typing import NamedTuple

from ...physics.arm import Arm
from ..errors import RecordingError
from ..session import OF_LOAD
from .time_titles import time_unit


class Kind(NamedTuple):
    """What numbers of a kind may be in."""

    units: Mapping[str, float]
    """Unit → what one of it is in SI, which comes first and needs no mention"""
    foreign: str
    """Other names of units, which are not read, but are meant for one where they stand"""
    names: Mapping[str, str] = {}
    """Those of them, in small letters, that are names of a unit for sure → the unit"""


FORCE = Kind(
    {'N': 1.0, 'mN': 1e-3, 'kN': 1e3, 'gf': 9.80665e-3, 'kgf': 9.80665},
    'newton newtons millinewton millinewtons g kg lb lbs lbf oz ozf',
    {
        **dict.fromkeys(('newton', 'newtons'), 'N'),
        **dict.fromkeys(('millinewton', 'millinewtons'), 'mN'),
    },
)
ANGLE = Kind(
    {'rad': 1.0, 'mrad': 1e-3, 'deg': math.radians(1.0), '°': math.radians(1.0)},
    'degree degrees radian radians milliradian milliradians',
    {
        **dict.fromkeys(('degree', 'degrees'), 'deg'),
        **dict.fromkeys(('radian', 'radians'), 'rad'),
        **dict.fromkeys(('milliradian', 'milliradians'), 'mrad'),
    },
)
TIME = Kind(
    {'s': 1.0, 'ms': 1e-3, 'us': 1e-6, 'ns': 1e-9, 'min': 60.0, 'h': 3600.0, 'd': 86400.0}, ''
)
PRESSURE = Kind(
    {'Pa': 1.0, 'kPa': 1e3, 'MPa': 1e6},
    'hPa pascal pascals kilopascals megapascals bar mbar psi atm torr mmHg',
    {'pascal': 'Pa', 'pascals': 'Pa', 'kilopascals': 'kPa', 'megapascals': 'MPa'},
)
TEXT = Kind({}, '')
"""That of words"""

_COLUMN = re.compile(r'(?P<name>[^\[\]]*?)\s*(?:\[\s*(?P<unit>[^\[\]]*?)\s*\])?')

_LOAD = dict(zip(OF_LOAD, (ANGLE, ANGLE, FORCE, FORCE), strict=True))


@dataclasses.dataclass(frozen=True)
class Quantities:
    """What the columns of a table may be."""

    kinds: Mapping[str, Kind]
    """Quantity → of what kind it is"""
    required: tuple[str, ...]
    """Those without which there is no sample: the tensions"""
    readings: tuple[str, ...]
    """Columns of a replay: what was recorded, where a gain and bias made tensions in N of it"""
    together: Mapping[str, tuple[str, ...]]
    """Name for several quantities of one unit"""

    def check_title(self, title: str) -> None:
        """Check that a column's title would not be overlooked.

        Raises
        ------
        RecordingError
            If it is meant for a quantity, but written otherwise.
        """
        title = title.strip()
        name, _ = split_title(title)
        if self.has_units(name):
            return
        for quantity, pattern in self._miswritten.items():
            if name != quantity and pattern.fullmatch(title):
                of_unit = f' --units {quantity}=UNIT' if self.has_units(quantity) else ''
                raise RecordingError(
                    f'there is a column {title!r}, which would be overlooked: write '
                    f'{self._as_to_write(quantity, title)}, or say --columns '
                    f'{quantity}="{title}"{of_unit}; what is something else needs another name'
                )

    def has_units(self, name: str) -> bool:
        """Whether it is a quantity whose numbers are in some unit."""
        return name in self.kinds and self.kinds[name] is not TEXT

    def common(self, quantity: str, unit: str) -> str | None:
        """Return a unit of a quantity as it is written here, by any name; None if it is none."""
        kind = self.kinds[quantity]
        return time_unit(unit) if kind is TIME else common_unit(unit, kind)

    def is_foreign(self, quantity: str, unit: str) -> bool:
        """Whether it is a unit of a quantity which is not read, such as pounds."""
        return unit.casefold() in self.kinds[quantity].foreign.casefold().split()

    def factor(self, quantity: str, unit: str) -> float:
        """Return what one of a unit is in SI.

        Raises
        ------
        RecordingError
            If it is no unit of that quantity.
        """
        kind = self.kinds[quantity]
        units, is_time = kind.units, kind is TIME
        unit = self.common(quantity, unit) or unit
        if unit not in units:
            raise RecordingError(
                f'the unit of {quantity} is {unit!r}, which is not known; there are '
                + ', '.join(units)
                + (
                    ' (--columns time=TITLE names another column)'
                    if is_time
                    else f' (--units {quantity}=UNIT says which it is in)'
                )
            )
        return units[unit]

    def _as_to_write(self, quantity: str, title: str) -> str:
        units = [*self.kinds[quantity].units]
        if not units:
            return quantity
        names = {**dict(zip(units, units, strict=True)), **self.kinds[quantity].names}
        words = ['°' if '°' in title else '', *re.split(r'[\W_]+', title)]
        meant = [unit for word in words if (unit := names.get(word) or names.get(word.casefold()))]
        return (
            f'{quantity} or, if it is not in {units[0]}, its unit in brackets, '
            f'{quantity} [{(meant or units[1:])[0]}] (there are {", ".join(units)})'
        )

    @cached_property
    def _miswritten(self) -> dict[str, re.Pattern[str]]:
        """By quantity, but the time, which is read by many titles."""
        return {
            name: _miswritten(name, kind) for name, kind in self.kinds.items() if kind is not TIME
        }


OF_UNIT = Quantities(
    kinds={
        'time': TIME,
        'tension_l': FORCE,
        'tension_s': FORCE,
        'bend_angle': ANGLE,
        'pressure': PRESSURE,
        **_LOAD,
        'state': TEXT,
    },
    required=('tension_l', 'tension_s'),
    readings=('reading_l', 'reading_s'),
    together={
        'tension': ('tension_l', 'tension_s'),
        'tip_force': ('tip_force_x', 'tip_force_z'),
    },
)
"""What a table of a single unit may hold"""


def of_arm(arm: Arm) -> Quantities:
    """Return what a table of an arm may hold: a tension for each cable, by its name.

    And the measured bend angles, ``bend_angle_1`` that of the joint at the base.

    Raises
    ------
    RecordingError
        If a cable is called as another quantity is.
    """
    cables = arm.cable_names
    angles = tuple(f'bend_angle_{number}' for number in range(1, len(arm.units) + 1))
    others = {'time': TIME, **dict.fromkeys(angles, ANGLE), **_LOAD}
    for cable in cables:
        if cable in others:
            raise RecordingError(
                f'a cable of the arm is called {cable}, which in a table is something else; '
                'rename it'
            )
    return Quantities(
        kinds={**dict.fromkeys(cables, FORCE), **others},
        required=cables,
        readings=tuple(f'reading_{cable}' for cable in cables),
        together={
            'tension': cables,
            'bend_angle': angles,
            'tip_force': ('tip_force_x', 'tip_force_z'),
        },
    )


def common_unit(label: str, kind: Kind) -> str | None:
    """Return a unit of a kind as it is written here, by its sign or name; None if it is none."""
    return label if label in kind.units else kind.names.get(label.casefold())


def split_title(title: str) -> tuple[str, str | None]:
    """Split a column's title into its name and the unit in brackets, None if there is none."""
    match = _COLUMN.fullmatch(title.strip())
    return (title.strip(), None) if match is None else (match['name'], match['unit'])


def _miswritten(quantity: str, kind: Kind) -> re.Pattern[str]:
    """What is meant for a quantity: its name in any writing, alone or with something like a unit.

    That is a unit after a separator, or anything in brackets of any kind.
    """
    name = r'[\s_-]*'.join(map(re.escape, quantity.split('_')))
    known = '|'.join([*kind.units, *kind.foreign.split()])
    unit = rf'[\W_]+(?:in[\W_]+)?(?:{known})[\W_]*'
    return re.compile(rf'{name}(?:|\W*[(\[{{<].*|\W*°.*|{unit})', re.IGNORECASE)
