"""Columns of a table that behave like a clock, though their titles do not say so."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np

from ..errors import RecordingError
from ..session import Floats
from .moments import is_moment
from .time_column import TimeColumn, Times, times_of_moments
from .time_titles import TIME_WORDS, time_unit

_COUNTERS = (
    'index idx sample samples seq sequence row rows line frame count counter id no nr num number '
    'n i trial run cycle step phase segment block unnamed key'
)
_OTHERS = (
    'tension force load weight moment torque effort pressure angle bend tilt roll position pos '
    'velocity vel speed acceleration current voltage volts temperature humidity distance length '
    'displacement stroke width height encoder counts raw value command cmd target setpoint motor '
    'estimated probability margin reading readings stddev assured validity state regime'
)
_NO_CLOCK = frozenset(f'{_COUNTERS} {_OTHERS}'.split())
"""Words in titles of what may rise from row to row and is no clock"""

_WORD = re.compile(r'[A-Z]+(?![a-z])|[A-Z]?[^\W\d_A-Z]+')
_UNIT = re.compile(r'.*[\[(]\s*([^\[\]()\s]+)\s*[\])]\s*')

FEWEST = 2
"""Rows that show whether something rises"""

KNOWN = 0.5
"""Share of the rows that have to have a value"""


def may_be_clock(title: str) -> bool:
    """Whether a title that is not known speaks of times, or does not say what else it is of.

    A unit of something else in brackets does.
    """
    words = {word.casefold() for word in _WORD.findall(title)}
    unit = _UNIT.fullmatch(title)
    if words & TIME_WORDS or title.strip() == 'X_Value' or (unit and time_unit(unit[1])):
        return True
    return not (words & _NO_CLOCK or unit)


def behaves_like_clock(values: Floats) -> bool:
    """Whether numbers rise over a table and never fall, as times do, and do not count rows."""
    known = values[np.isfinite(values)]
    if len(known) < max(FEWEST, KNOWN * len(values)):
        return False
    steps = np.diff(known)
    return bool((steps >= 0.0).all() and (steps > 0.0).any() and not (steps == 1.0).all())


class Candidate:
    """A column that may be the clock, row by row until it is seen not to be.

    Attributes
    ----------
    values : list of float
        NaN where there is none, or a text.
    texts : list of str
        Dates and times, or empty.
    """

    def __init__(self) -> None:
        self.values: list[float] = []
        self.texts: list[str] = []
        self._newest = -math.inf

    def take(self, text: str, number: Callable[[str], float]) -> bool:
        """Take a field, and what makes a number of it; return whether it may still be a clock."""
        value = math.nan
        if not is_moment(text):
            try:
                value = number(text)
            except ValueError:
                return False
            text = ''
        if value < self._newest:
            return False
        self._newest = self._newest if math.isnan(value) else value
        self.values.append(value)
        self.texts.append(text)
        return True

    def times(self, title: str) -> Times | None:
        """Return what is a time for sure: the dates and times of a column that advances."""
        if sum(map(bool, self.texts)) < max(FEWEST, KNOWN * len(self.texts)):
            return None
        try:
            found = times_of_moments(TimeColumn(0, title or 'without a title'), self.texts)
        except RecordingError:
            return None
        seconds = found.seconds[np.isfinite(found.seconds)]
        return found if (np.diff(seconds) >= 0.0).all() and seconds[-1] > seconds[0] else None

    @property
    def is_clock(self) -> bool:
        """Whether its numbers behave like a clock."""
        return behaves_like_clock(np.array(self.values))
