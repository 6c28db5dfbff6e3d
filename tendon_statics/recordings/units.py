"""The units in which a recording may stand, by what is measured."""

from __future__ import annotations

import math
import re

from .errors import RecordingError

_TENSION = {'N': 1.0, 'mN': 1e-3, 'kN': 1e3, 'gf': 9.80665e-3, 'kgf': 9.80665}
UNITS = {
    'time': {'s': 1.0, 'ms': 1e-3, 'us': 1e-6, 'ns': 1e-9},
    'tension_l': _TENSION,
    'tension_s': _TENSION,
    'bend_angle': {'rad': 1.0, 'mrad': 1e-3, 'deg': math.radians(1.0)},
    'pressure': {'Pa': 1.0, 'kPa': 1e3, 'MPa': 1e6},
}
"""Quantity → unit → what one of it is in SI, which comes first and needs no mention"""

_COLUMN = re.compile(r'(?P<name>[^\[\]]*?)\s*(?:\[\s*(?P<unit>[^\[\]]*?)\s*\])?')


def parse_column(title: str) -> tuple[str, float]:
    """Split a column's title, ``tension_l`` or ``tension_l [mN]``, into name and SI factor.

    A column of something else has the factor 1.

    Raises
    ------
    RecordingError
        If the unit is not one of that quantity, or stands where it would be overlooked.
    """
    match = _COLUMN.fullmatch(title.strip())
    if match is None:
        return title.strip(), 1.0
    name, unit = match['name'], match['unit']
    if name in UNITS:
        units = UNITS[name]
        if unit is None:
            return name, 1.0
        if unit not in units:
            raise RecordingError(
                f'the unit of {name} is {unit!r}, which is not known; there are {", ".join(units)}'
            )
        return name, units[unit]
    for quantity, units in UNITS.items():
        suffix = name.removeprefix(f'{quantity}_')
        if suffix != name and suffix in units:
            raise RecordingError(
                f'there is a column {name}; a unit stands in brackets, {quantity} [{suffix}]'
            )
    return name, 1.0
