"""The columns of a table that are those of a recording."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ..errors import RecordingError
from ..recording import QUANTITIES
from .units import parse_column

REQUIRED = ('tension_l', 'tension_s')


class Column(NamedTuple):
    """Where a quantity stands in a table."""

    place: int
    factor: float
    """What one of its unit is in SI"""


def find_columns(titles: Sequence[str]) -> dict[str, Column]:
    """Find the columns of a recording by their titles; others are left alone.

    Raises
    ------
    RecordingError
        If a tension has no column, a quantity has two, or a unit is not known.
    """
    found: dict[str, Column] = {}
    for place, title in enumerate(titles):
        name, factor = parse_column(title)
        if name not in (*QUANTITIES, 'state'):
            continue
        if name in found:
            raise RecordingError(f'there are two columns of {name}')
        found[name] = Column(place, factor)
    for name in REQUIRED:
        if name not in found:
            there = ', '.join(filter(None, titles)) or 'none'
            hint = ''
            if any(separator in there for separator in ';\t'):
                hint = '; a comma has to stand between two columns, and a point in numbers'
            raise RecordingError(
                f'there is no column {name}; {", ".join(REQUIRED)} are needed, there are: {there}'
                f'{hint}'
            )
    return found
