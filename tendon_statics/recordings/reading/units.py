"""The units in which a recording may stand, by what is measured."""

from __future__ import annotations

import math
import re

from ..errors import RecordingError
from .time_titles import time_unit

_FORCE = {'N': 1.0, 'mN': 1e-3, 'kN': 1e3, 'gf': 9.80665e-3, 'kgf': 9.80665}
_ANGLE = {'rad': 1.0, 'mrad': 1e-3, 'deg': math.radians(1.0), '°': math.radians(1.0)}
UNITS = {
    'time': {'s': 1.0, 'ms': 1e-3, 'us': 1e-6, 'ns': 1e-9, 'min': 60.0, 'h': 3600.0, 'd': 86400.0},
    'tension_l': _FORCE,
    'tension_s': _FORCE,
    'bend_angle': _ANGLE,
    'pressure': {'Pa': 1.0, 'kPa': 1e3, 'MPa': 1e6},
    'base_tilt': _ANGLE,
    'base_roll': _ANGLE,
    'tip_force_x': _FORCE,
    'tip_force_z': _FORCE,
}
"""Quantity → unit → what one of it is in SI, which comes first and needs no mention"""

_FOREIGN_FORCE = 'newton newtons g kg lb lbs lbf oz ozf'
_FOREIGN_ANGLE = 'degree degrees radian radians milliradians'
_FOREIGN_UNITS = {
    **dict.fromkeys(('tension_l', 'tension_s', 'tip_force_x', 'tip_force_z'), _FOREIGN_FORCE),
    **dict.fromkeys(('bend_angle', 'base_tilt', 'base_roll'), _FOREIGN_ANGLE),
    'pressure': 'hPa pascal pascals kilopascals megapascals bar mbar psi atm torr mmHg',
}
"""Quantity → other names of units, which are not read, but are meant for one where they stand"""

_COLUMN = re.compile(r'(?P<name>[^\[\]]*?)\s*(?:\[\s*(?P<unit>[^\[\]]*?)\s*\])?')


def split_title(title: str) -> tuple[str, str | None]:
    """Split a column's title into its name and the unit in brackets, None if there is none."""
    match = _COLUMN.fullmatch(title.strip())
    return (title.strip(), None) if match is None else (match['name'], match['unit'])


def parse_column(title: str) -> tuple[str, float]:
    """Split a column's title, ``tension_l`` or ``tension_l [mN]``, into name and SI factor.

    A column of something else has the factor 1.

    Raises
    ------
    RecordingError
        If the unit is not one of that quantity, or the title is meant for a quantity but written
        otherwise, so that it would be overlooked.
    """
    title = title.strip()
    name, unit = split_title(title)
    if name in UNITS:
        units = UNITS[name]
        if unit is None:
            return name, 1.0
        if name == 'time':
            unit = time_unit(unit) or unit
        if unit not in units:
            raise RecordingError(
                f'the unit of {name} is {unit!r}, which is not known; there are {", ".join(units)}'
                + (' (--columns time=TITLE names another column)' if name == 'time' else '')
            )
        return name, units[unit]
    for quantity, pattern in _MISWRITTEN.items():
        if name != quantity and pattern.fullmatch(title):
            raise RecordingError(
                f'there is a column {title!r}, which would be overlooked: write '
                f'{_as_to_write(quantity, title)}; what is something else needs another name'
            )
    return name, 1.0


def _as_to_write(quantity: str, title: str) -> str:
    units = [*UNITS.get(quantity, ())]
    if not units:
        return quantity
    meant = [unit for unit in units if re.search(rf'[\W_]{unit}\b', title)]
    return (
        f'{quantity} or, if it is not in {units[0]}, its unit in brackets, '
        f'{quantity} [{(meant or units[1:])[0]}] (there are {", ".join(units)})'
    )


def _miswritten(quantity: str) -> re.Pattern[str]:
    """What is meant for a quantity: its name in any writing, alone or with something like a unit.

    That is a unit after a separator, or anything in brackets of any kind.
    """
    name = r'[\s_-]*'.join(quantity.split('_'))
    units = '|'.join([*UNITS.get(quantity, ()), *_FOREIGN_UNITS.get(quantity, '').split()])
    unit = rf'[\W_]+(?:in[\W_]+)?(?:{units})[\W_]*'
    return re.compile(rf'{name}(?:|\W*[(\[{{<].*|\W*°.*|{unit})', re.IGNORECASE)


_MISWRITTEN = {
    quantity: _miswritten(quantity) for quantity in (*UNITS, 'state') if quantity != 'time'
}
"""By quantity, but the time, which is read by many titles"""
