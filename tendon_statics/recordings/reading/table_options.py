"""How a table is to be read, where it does not say so itself."""

from __future__ import annotations

import codecs
import dataclasses
import math
from collections.abc import Mapping

from ..errors import RecordingError
from ..recording import QUANTITIES
from .time_titles import time_unit
from .units import UNITS

SEPARATORS = {'comma': ',', 'semicolon': ';', 'tab': '\t', 'bar': '|', 'space': ' '}
"""Name of a separator, as an option has it → character; one space stands for any number"""

PAIRS = {'tension': ('tension_l', 'tension_s'), 'tip_force': ('tip_force_x', 'tip_force_z')}
"""Name for two quantities of one unit"""

NAMED = (*QUANTITIES, 'state')
"""What a column may be"""


@dataclasses.dataclass(frozen=True)
class TableOptions:
    """What is said of a table; None and empty: as it stands there, or is recognised for sure."""

    separator: str | None = None
    """Between columns: one of `SEPARATORS` or the character"""
    decimal: str | None = None
    """Between whole and fraction: ``.`` or ``,``"""
    columns: Mapping[str, str] = dataclasses.field(default_factory=dict)
    """Quantity → title of its column, without a unit in brackets"""
    units: Mapping[str, str] = dataclasses.field(default_factory=dict)
    """Quantity → unit of its column; ``tension`` stands for both tensions, ``tip_force`` for both
    components"""
    skip_rows: int = 0
    """Lines before the one with the titles"""
    encoding: str | None = None
    """Of a text file, say ``latin-1``; None: UTF-8, or UTF-16 with a byte-order mark"""
    rate: float | None = None
    """Rows per second of a table without times"""

    def __post_init__(self) -> None:
        """Check what can be checked without a table.

        Raises
        ------
        RecordingError
            If an option has a value that is not allowed.
        """
        if self.separator is not None:
            separator = SEPARATORS.get(self.separator, self.separator)
            if len(separator) != 1 or separator in '\r\n"':
                raise RecordingError(
                    f'the separator is {self.separator!r}; one character is needed, or one of '
                    f'{", ".join(SEPARATORS)}'
                )
            object.__setattr__(self, 'separator', separator)
        if self.decimal not in (None, '.', ','):
            raise RecordingError(f'the decimal separator is {self.decimal!r}; allowed are . and ,')
        if self.decimal is not None and self.decimal == self.separator:
            raise RecordingError(f'{self.decimal!r} cannot separate both columns and decimals')
        if self.skip_rows < 0:
            raise RecordingError(f'{self.skip_rows} lines cannot be skipped')
        for quantity in self.columns:
            _check_quantity(quantity, NAMED)
        units = dict(self.units)
        for both, quantities in PAIRS.items():
            if both in units:
                units = dict.fromkeys(quantities, units.pop(both)) | units
        object.__setattr__(self, 'units', units)
        for quantity, unit in units.items():
            _check_quantity(quantity, (*UNITS, *PAIRS))
            unit_factor(quantity, unit)
        if self.rate is not None and not 0.0 < self.rate < math.inf:
            raise RecordingError(
                f'the rate is {self.rate!r} Hz; a finite number above 0 is needed'
            )
        if self.encoding is not None:
            try:
                codecs.lookup(self.encoding)
            except LookupError:
                raise RecordingError(f'there is no encoding {self.encoding!r}') from None


def unit_factor(quantity: str, unit: str) -> float:
    """Return what one of a unit is in SI.

    Raises
    ------
    RecordingError
        If it is no unit of that quantity.
    """
    units = UNITS[quantity]
    if quantity == 'time':
        unit = time_unit(unit) or unit
    if unit not in units:
        raise RecordingError(
            f'the unit of {quantity} is {unit!r}, which is not known; there are {", ".join(units)}'
        )
    return units[unit]


def _check_quantity(quantity: str, allowed: tuple[str, ...]) -> None:
    if quantity not in allowed:
        raise RecordingError(f'{quantity!r} is no quantity; there are {", ".join(allowed)}')
