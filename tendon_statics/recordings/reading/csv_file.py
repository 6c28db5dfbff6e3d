"""Recordings in text files: CSV, and what spreadsheets and LabVIEW make of it."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..errors import RecordingError
from ..progress import Progress, unseen
from .clock_like import Candidate, may_be_clock
from .columns import Column, Columns, find_columns
from .moments import MOMENTS, is_moment, is_of_day
from .table import Table
from .table_options import TableOptions
from .text_form import recognise
from .text_lines import DECIMAL_COMMA, TextForm, bare, no_utf_8
from .time_column import Times, times_of, times_of_moments

LINE_ENDS = (b'\n', b'\r')

MISSING = re.compile(
    r'|n/?a|n\.a\.|<na>|null|none|missing|-?nan(\(\w+\))?|-?1\.#(ind|qnan|snan|inf)|#[\w/]+[!?]?|-+',
    re.IGNORECASE,
)
"""What programs write for a number that is missing, or that they cannot compute: Excel ``#N/A``,
``#NV`` or ``#DIV/0!``, C ``1.#QNAN`` or ``nan(ind)``"""

MOST_SHOWN = 80
"""Characters of a damaged line that are shown"""


def load_csv(
    path: Path, options: TableOptions | None = None, progress: Progress = unseen
) -> Table:
    """Read a text file with a table whose titles name the columns, as `load_recording` does.

    Empty lines and comments are left alone; an empty field is NaN. A line that is not as long as
    the titles, is not UTF-8 or has no number where there should be one is damage. So is a last
    line without an end whose last field is shorter than that of every line before: a number that
    was cut still looks like one.
    """
    options = options or TableOptions()
    content, notes = bare(path.read_bytes(), options)
    form = recognise(content, options)
    rows = _Rows(form, find_columns(form.titles, options))
    for number, line in progress(form.rows, 'reading'):
        rows.take(number, line)
    return rows.table(path.name, (*notes, *form.notes))


class _FieldError(ValueError):
    """A field that has not what should stand there; the text is for the user."""


class _Rows:
    """The rows of a table, one by one."""

    def __init__(self, form: TextForm, columns: Columns) -> None:
        self._form = form
        self._columns = columns
        self._values: dict[str, list[float]] = {name: [] for name in columns.numbers}
        self._texts: list[str] = []
        """Dates and times"""
        self._times: list[float] = []
        self._nanoseconds: list[float] = []
        self._states: list[str] = []
        self._numbers: list[int] = []
        """Of the lines"""
        self._damage: list[str] = []
        self._shortest = 0  # last field so far, in characters
        self._is_moment: bool | None = None
        self._candidates = {
            place: Candidate()
            for place in (() if columns.time else columns.others)
            if may_be_clock(form.titles[place])
        }

    def take(self, number: int, line: bytes) -> None:
        """Take a row, or name what is wrong with it."""
        titles = self._form.titles
        try:
            fields = self._form.fields(line)
            row = [self._number(fields, column) for column in self._columns.numbers.values()]
            time = self._time(fields)
            if len(fields) != len(titles):
                raise ValueError(f'{len(fields)} fields')
        except (ValueError, IndexError, csv.Error) as error:
            place = f'line {number}, {_shown(line)}'
            why = f': {error}' if isinstance(error, _FieldError) else ''
            if isinstance(error, UnicodeDecodeError):
                why = f': {no_utf_8(error)}'
            self._damage.append(
                f'{place}, is not a row of {self._form.separator.join(titles)}{why}'
            )
            return
        length = len(fields[-1])
        if not line.endswith(LINE_ENDS) and length < self._shortest:
            self._damage.append(
                f'line {number}, {_shown(line)}, is shorter than all before it and has no end, '
                'so it has been cut; if it is whole, add an end of line'
            )
            return
        self._shortest = min(self._shortest or length, length)
        self._numbers.append(number)
        for kept, value in zip(self._values.values(), row, strict=True):
            kept.append(value)
        if isinstance(time, str):
            self._texts.append(time)
        elif time is not None:
            self._times.append(time[0])
            self._nanoseconds.append(time[1])
        if self._columns.state is not None:
            self._states.append(fields[self._columns.state])
        self._candidates = {
            place: candidate
            for place, candidate in self._candidates.items()
            if candidate.take(fields[place], self._plain)
        }

    def table(self, name: str, notes: Sequence[str]) -> Table:
        """Return what was read.

        Raises
        ------
        RecordingError
            If that is no row.
        """
        if not any(self._values.values()):
            why = f'; {self._damage[0]}' if self._damage else ''
            raise RecordingError(f'there is no row of tensions in it{why}')
        times, clock_like = self._clock()
        return Table(
            name,
            self._columns,
            {quantity: np.array(values) for quantity, values in self._values.items()},
            times,
            clock_like,
            None if self._columns.state is None else self._states,
            damage=self._damage,
            notes=notes,
        )

    def _clock(self) -> tuple[Times | None, str | None]:
        """Return the times, or the title of what behaves like a clock and is not one for sure."""
        column, step = self._columns.time, self._form.step
        if column is None and step is not None:
            lines = np.array(self._numbers) - self._form.rows[0][0]
            return Times(step * lines, 0, f'time: {step:g} s from row to row, by Delta_X'), None
        if column is None:
            return self._found_clock()
        if self._is_moment:
            return times_of_moments(column, self._texts), None
        rest = None if column.nanoseconds is None else np.array(self._nanoseconds)
        return times_of(column, np.array(self._times), rest), None

    def _found_clock(self) -> tuple[Times | None, str | None]:
        titles = self._form.titles
        sure = [
            times
            for place, candidate in self._candidates.items()
            for times in [candidate.times(titles[place])]
            if times is not None
        ]
        if len(sure) == 1:
            return sure[0], None
        return None, next(
            (
                titles[place]
                for place, candidate in self._candidates.items()
                if candidate.is_clock or len(sure) > 1
            ),
            None,
        )

    def _time(self, fields: list[str]) -> str | tuple[float, float] | None:
        """Return a row's time: a date and time, or the number with what is to be added."""
        column = self._columns.time
        if column is None:
            return None
        text = fields[column.place]
        if column.date is not None and is_of_day(text):
            text = f'{fields[column.date]} {text}'
        if self._is_moment is None and text:
            self._is_moment = is_moment(text)
        if self._is_moment:
            if text and not is_moment(text):
                raise _FieldError(f'{_shown(text.encode())} is no time, as in {MOMENTS}')
            return text
        rest = 0.0
        if column.nanoseconds is not None:
            rest = self._plain(fields[column.nanoseconds])
        try:
            return self._plain(text), rest
        except _FieldError:
            raise _FieldError(
                f'{_shown(text.encode())} is no time: numbers are read, and dates as in '
                f'{MOMENTS}; --columns time=TITLE names another column'
            ) from None

    def _number(self, fields: list[str], column: Column) -> float:
        return column.factor * self._plain(fields[column.place])

    def _plain(self, text: str) -> float:
        if MISSING.fullmatch(text):
            return math.nan
        number = text
        if self._form.decimal == ',':
            # A point is one between thousands, perhaps.
            number = text.replace('.', '_').replace(',', '.')
        try:
            if '_' in number:
                raise ValueError  # Python takes 1_5 for 15.
            return float(number)
        except ValueError:
            hint = ''
            if self._form.decimal == '.' and DECIMAL_COMMA.fullmatch(text):
                hint = ' (--decimal , if commas separate decimals)'
            raise _FieldError(f'{_shown(text.encode())} is no number{hint}') from None


def _shown(line: bytes) -> str:
    text = line.decode(errors='replace').rstrip('\r\n')
    return repr(text if len(text) <= MOST_SHOWN else f'{text[:MOST_SHOWN]}…')
