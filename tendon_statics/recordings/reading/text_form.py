"""How a text file writes a table: separator, decimals, and where its titles stand."""

from __future__ import annotations

import csv
import dataclasses
import itertools
import re
from collections.abc import Iterator, Sequence

from ..errors import RecordingError
from .columns import find_columns
from .labview import LABVIEW, labview_form
from .table_options import SEPARATORS, TableOptions
from .text_lines import DECIMAL_COMMA, Line, TextForm, no_utf_8, separator_name, split
from .units import Quantities, split_title

COMMENTS = ('#', '%')
"""How a line begins that is ignored, unless it has the titles"""

LOOKED_AT = 100
"""Rows that tell how numbers are written"""

_SEPARATORS_ALONE = b' \t,;|"\r\n'
_EXCEL_SEPARATOR = re.compile(rb'"?sep=(.)"?')
_THOUSANDS = re.compile(r'[-+]?[1-9]\d{0,2},\d{3}')
_DECIMAL_POINT = re.compile(r'[-+]?\d*\.\d*(?:[eE][-+]?\d+)?')


def recognise(content: bytes, options: TableOptions) -> TextForm:
    """Find out how a text file writes its table.

    Raises
    ------
    RecordingError
        If it has no titles with tensions, or can be read in more than one way; the text names the
        option that decides.
    """
    every = list(_lines(content))
    lines = [line for line in every if line[0] > options.skip_rows and line[1].strip()]
    if lines and lines[0][1].startswith(LABVIEW.encode()):
        return labview_form(lines, options)
    told = _EXCEL_SEPARATOR.fullmatch(lines[0][1].strip()) if lines else None
    if told is not None:  # as Excel writes, and reads, it
        lines = lines[1:]
        options = dataclasses.replace(options, separator=told[1].decode())
    comments = [line for line in lines if _is_comment(line[1])]
    rows = _without_empty_ends([line for line in lines if not _is_comment(line[1])])
    separator, titles, at = _titles(comments, rows, options, every[: options.skip_rows])
    notes = []
    if separator != ',':
        notes.append(f'columns are separated by {separator_name(separator)}')
    titles, rows, said = _with_units_row(titles, rows[at:], separator, options.quantities)
    if rows and _ends_with_separator(rows[0][1], separator, len(titles)):
        titles = [*titles, '']
    decimal = _decimal(rows, separator, titles, options)
    if decimal != '.':
        notes.append('decimals are written with a comma')
    return TextForm(titles, separator, decimal, rows, notes + said)


def _ends_with_separator(line: bytes, separator: str, count: int) -> bool:
    """Whether a row has an empty field more than there are titles, as data loggers write it."""
    fields = _fields(line, separator)
    return len(fields) == count + 1 and fields[-1] == ''


def _lines(content: bytes) -> Iterator[Line]:
    yield from enumerate(content.splitlines(keepends=True), start=1)


def _is_comment(line: bytes) -> bool:
    return line.lstrip().startswith(tuple(mark.encode() for mark in COMMENTS))


def _without_empty_ends(rows: list[Line]) -> list[Line]:
    """Leave out rows before the titles and at the end in which there are separators alone."""
    full = [place for place, (_, line) in enumerate(rows) if line.strip(_SEPARATORS_ALONE)]
    return rows[full[0] : full[-1] + 1] if full else []


def _titles(
    comments: Sequence[Line],
    rows: Sequence[Line],
    options: TableOptions,
    skipped: Sequence[Line],
) -> tuple[str, list[str], int]:
    """Find separator and titles; return them with the number of rows that they take.

    The titles are the first line that is no comment or, if that has none, the last comment before
    it: NumPy and `rostopic echo -p` write them so.

    Raises
    ------
    RecordingError
        If neither names the tensions.
    """
    candidates = [(rows[0], 1)] if rows else []
    before = [line for line in comments if not rows or line[0] < rows[0][0]]
    candidates += [(line, 0) for line in before[-1:]]
    separators = [options.separator] if options.separator else [*SEPARATORS.values()]
    failures: list[tuple[tuple[bool, int], RecordingError]] = []
    for (number, line), taken in candidates:
        for separator in separators:
            titles = _header(number, line, separator, as_comment=not taken)
            try:
                find_columns(titles, options)
            except RecordingError as error:
                count = sum(map(_is_title, titles))
                # Blanks stand within titles too, so they separate columns where nothing else does.
                failures.append(((separator != ' ' and count > 1, count), error))
            else:
                return separator, titles, taken
    if not failures:
        find_columns([], options)
    # What is wrong with the tensions that were found, rather than that there are none; else what
    # there is by the separator that makes most titles.
    of_found = [failure for failure in failures if 'no column' not in str(failure[1])]
    _, worst = max(of_found or failures, key=lambda failure: failure[0])
    raise (None if of_found else _elsewhere(rows, skipped, separators, options)) or worst


def _elsewhere(
    rows: Sequence[Line],
    skipped: Sequence[Line],
    separators: Sequence[str],
    options: TableOptions,
) -> RecordingError | None:
    """Say in which line the titles stand, if that is not the first."""
    first = f'line {rows[0][0]}, the first, has no titles of tensions' if rows else ''
    if skipped:
        first += f' (--skip-rows {options.skip_rows})'
    for number, line in (*skipped[-LOOKED_AT:], *rows[1:LOOKED_AT]):
        if any(_has_tensions(number, line, separator, options) for separator in separators):
            return RecordingError(f'{first}; line {number} has them: --skip-rows {number - 1}')
    for titled, numbered in itertools.pairwise(rows[:LOOKED_AT]):
        for separator in sorted(separators, key=' '.__eq__):
            titles = _fields(titled[1], separator)
            fields = _fields(numbered[1], separator)
            if len(titles) != len(fields) or len(fields) < 2 or any(map(_is_title, fields)):
                continue
            if titled is rows[0] or not all(map(_is_title, titles)):
                return None
            return RecordingError(
                f'{first}; line {titled[0]} looks like the titles, {", ".join(titles)}: '
                f'--skip-rows {titled[0] - 1} --columns tension_l=TITLE,tension_s=TITLE'
            )
    return None


def _fields(line: bytes, separator: str) -> list[str]:
    try:
        return split(line, separator)
    except (ValueError, csv.Error):
        return []


def _is_title(text: str) -> bool:
    try:
        float(text.replace(',', '.'))
    except ValueError:
        return bool(text)
    return False


def _has_tensions(number: int, line: bytes, separator: str, options: TableOptions) -> bool:
    try:
        find_columns(_header(number, line, separator, as_comment=False), options)
    except RecordingError:
        return False
    return True


def _header(number: int, line: bytes, separator: str, *, as_comment: bool) -> list[str]:
    try:
        titles = split(line, separator)
    except UnicodeDecodeError as error:
        raise RecordingError(
            'it is not a text file in UTF-8 whose first line names columns: in line '
            f'{number} {no_utf_8(error)}'
        ) from None
    except (ValueError, csv.Error):
        raise RecordingError(
            'it is not a text file in UTF-8 whose first line names columns'
        ) from None
    if as_comment and titles and titles[0].lower() != '%time':
        titles[0] = titles[0].lstrip(''.join(COMMENTS)).strip()
        titles = titles if titles[0] else titles[1:]
    return titles


def _with_units_row(
    titles: list[str], rows: list[Line], separator: str, quantities: Quantities
) -> tuple[list[str], list[Line], list[str]]:
    """Take a row of units below the titles into these; one that is known makes it one."""
    try:
        units = [field.strip('[]()') for field in split(rows[0][1], separator)] if rows else []
    except (ValueError, csv.Error):
        return titles, rows, []
    names = [split_title(title) for title in titles]
    known = [
        quantities.common(name, unit) is not None or quantities.is_foreign(name, unit)
        for (name, _), unit in zip(names, units, strict=False)
        if quantities.has_units(name)
    ]
    numbers = any(field.replace('.', '').replace(',', '').strip('-+').isdigit() for field in units)
    if len(units) != len(titles) or numbers or not any(known):
        return titles, rows, []
    with_units = [
        f'{name} [{unit}]' if quantities.has_units(name) and given is None else title
        for title, (name, given), unit in zip(titles, names, units, strict=True)
    ]
    return with_units, rows[1:], [f'units: those of line {rows[0][0]}']


def _decimal(
    rows: Sequence[Line], separator: str, titles: Sequence[str], options: TableOptions
) -> str:
    """Return how the numbers of the recording's columns are written.

    Raises
    ------
    RecordingError
        If some have commas and others points, a comma separates both columns and decimals, or
        all with a comma may be thousands.
    """
    if options.decimal is not None:
        return options.decimal
    columns = find_columns(titles, options)
    places = [column.place for column in columns.numbers.values()]
    if columns.time is not None:
        places.append(columns.time.place)
    with_comma = with_point = looked_at = longer = 0
    sure, shown = False, ''
    for _, line in rows:
        if with_comma + with_point + (separator == ',') * looked_at >= LOOKED_AT:
            break
        if separator != ',' and b',' not in line and b'.' not in line:
            continue  # whole numbers, which tell nothing
        looked_at += 1
        fields = _fields(line, separator)
        longer += len(fields) == 2 * len(titles)
        values = [fields[place] for place in places if place < len(fields)]
        commas = [value for value in values if DECIMAL_COMMA.fullmatch(value)]
        sure = sure or not all(map(_THOUSANDS.fullmatch, commas))
        shown = shown or next(iter(commas), '')
        with_comma += bool(commas)
        with_point += any(_DECIMAL_POINT.fullmatch(value) is not None for value in values)
    if separator == ',' and longer and longer == looked_at:
        raise RecordingError(
            'commas separate both its columns and its decimals, and cannot be told apart: '
            'write it with semicolons or tabs'
        )
    if with_comma and with_point:
        raise RecordingError(
            'some of its numbers have commas, others points; --decimal , or --decimal . says '
            'which separates decimals'
        )
    if with_comma and not sure:
        raise RecordingError(
            f'it is not sure whether {shown!r} is a few or some thousands: --decimal , '
            'says that commas separate decimals; write numbers without those between thousands'
        )
    return ',' if with_comma else '.'
