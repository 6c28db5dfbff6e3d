"""How a table is to be read, where it does not say so itself."""

from __future__ import annotations

import codecs
import dataclasses
import math
from collections.abc import Mapping

from ..errors import RecordingError
from .units import OF_UNIT, Quantities

SEPARATORS = {'comma': ',', 'semicolon': ';', 'tab': '\t', 'bar': '|', 'space': ' '}
"""Name of a separator, as an option has it → character; one space stands for any number"""


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
    """Quantity → unit of its column; ``tension`` stands for all tensions, ``tip_force`` for both
    components"""
    skip_rows: int = 0
    """Lines before the one with the titles"""
    encoding: str | None = None
    """Of a text file, say ``latin-1``; None: UTF-8, or UTF-16 with a byte-order mark"""
    rate: float | None = None
    """Rows per second of a table without times"""
    quantities: Quantities = OF_UNIT
    """What its columns may be"""

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
        known = self.quantities
        for quantity in self.columns:
            _check_quantity(quantity, (*known.kinds,))
        units = dict(self.units)
        for name, quantities in known.together.items():
            if name in units:
                units = dict.fromkeys(quantities, units.pop(name)) | units
        object.__setattr__(self, 'units', units)
        for quantity, unit in units.items():
            _check_quantity(quantity, (*filter(known.has_units, known.kinds), *known.together))
            known.factor(quantity, unit)
        if self.rate is not None and not 0.0 < self.rate < math.inf:
            raise RecordingError(
                f'the rate is {self.rate!r} Hz; a finite number above 0 is needed'
            )
        if self.encoding is not None:
            try:
                codecs.lookup(self.encoding)
            except LookupError:
                raise RecordingError(f'there is no encoding {self.encoding!r}') from None


def _check_quantity(quantity: str, allowed: tuple[str, ...]) -> None:
    if quantity not in allowed:
        raise RecordingError(f'{quantity!r} is no quantity; there are {", ".join(allowed)}')
