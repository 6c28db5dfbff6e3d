"""How a text file writes a table: separator, decimals, and where its titles stand."""

from __future__ import annotations

import csv
import dataclasses
import re
from collections.abc import Iterator, Sequence

from ..errors import RecordingError
from .columns import find_columns
from .labview import LABVIEW, labview_form
from .table_options import SEPARATORS, TableOptions
from .text_lines import Line, TextForm, separator_name, split
from .units import Quantities, split_title

COMMENTS = ('#', '%')
"""How a line begins that is ignored, unless it has the titles"""

LOOKED_AT = 100
"""Rows that tell how numbers are written"""

_EXCEL_SEPARATOR = re.compile(rb'"?sep=(.)"?')
_DECIMAL_COMMA = re.compile(r'[-+]?\d*,\d+(?:[eE][-+]?\d+)?')
_DECIMAL_POINT = re.compile(r'[-+]?\d*\.\d*(?:[eE][-+]?\d+)?')


def recognise(content: bytes, options: TableOptions) -> TextForm:
    """Find out how a text file writes its table.

    Raises
    ------
    RecordingError
        If it has no titles with tensions, or can be read in more than one way; the text names the
        option that decides.
    """
    lines = [line for line in _lines(content) if line[0] > options.skip_rows and line[1].strip()]
    if lines and lines[0][1].startswith(LABVIEW.encode()):
        return labview_form(lines, options)
    told = _EXCEL_SEPARATOR.fullmatch(lines[0][1].strip()) if lines else None
    if told is not None:  # as Excel writes, and reads, it
        lines = lines[1:]
        options = dataclasses.replace(options, separator=told[1].decode())
    comments = [line for line in lines if _is_comment(line[1])]
    rows = [line for line in lines if not _is_comment(line[1])]
    separator, titles, at = _titles(comments, rows, options)
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
    try:
        fields = split(line, separator)
    except (ValueError, csv.Error):
        return False
    return len(fields) == count + 1 and fields[-1] == ''


def _lines(content: bytes) -> Iterator[Line]:
    yield from enumerate(content.splitlines(keepends=True), start=1)


def _is_comment(line: bytes) -> bool:
    return line.lstrip().startswith(tuple(mark.encode() for mark in COMMENTS))


def _titles(
    comments: Sequence[Line], rows: Sequence[Line], options: TableOptions
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
    failures: list[tuple[int, RecordingError]] = []
    for (number, line), taken in candidates:
        for separator in separators:
            titles = _header(number, line, separator, as_comment=not taken)
            try:
                find_columns(titles, options)
            except RecordingError as error:
                failures.append((sum(map(_is_title, titles)), error))
            else:
                return separator, titles, taken
    if not failures:
        find_columns([], options)
    for number, line in rows[1:LOOKED_AT]:
        if any(_has_tensions(number, line, separator, options) for separator in separators):
            raise RecordingError(
                f'{failures[0][1]}; line {number} has them: --skip-rows {number - 1}'
            )
    # What is wrong with the tensions that were found, rather than that there are none; else what
    # there is by the separator that makes most titles.
    of_found = [error for _, error in failures if 'no column' not in str(error)]
    raise of_found[0] if of_found else max(failures, key=lambda failure: failure[0])[1]


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
        byte = line[error.start]
        raise RecordingError(
            f'it is not a text file in UTF-8 whose first line names columns: line {number} has '
            f'the byte 0x{byte:02x}; if it is Latin-1, --encoding latin-1 reads it'
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
    """Take a row of units below the titles into these."""
    try:
        units = [field.strip('[]()') for field in split(rows[0][1], separator)] if rows else []
    except (ValueError, csv.Error):
        return titles, rows, []
    names = [split_title(title) for title in titles]
    known = [
        unit in quantities.kinds[name].units if quantities.has_units(name) else True
        for (name, _), unit in zip(names, units, strict=False)
    ]
    numbers = any(field.replace('.', '').replace(',', '').strip('-+').isdigit() for field in units)
    if len(units) != len(titles) or numbers or not all(known) or not any(units):
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
        If some have commas and others points, or a comma separates both columns and decimals.
    """
    if options.decimal is not None:
        return options.decimal
    columns = find_columns(titles, options)
    places = [column.place for column in columns.numbers.values()]
    if columns.time is not None:
        places.append(columns.time.place)
    with_comma = with_point = looked_at = longer = 0
    for _, line in rows:
        if with_comma + with_point + (separator == ',') * looked_at >= LOOKED_AT:
            break
        if separator != ',' and b',' not in line and b'.' not in line:
            continue  # whole numbers, which tell nothing
        looked_at += 1
        try:
            fields = split(line, separator)
        except (ValueError, csv.Error):
            continue
        longer += len(fields) == 2 * len(titles)
        values = [fields[place] for place in places if place < len(fields)]
        with_comma += any(_DECIMAL_COMMA.fullmatch(value) is not None for value in values)
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
    return ',' if with_comma else '.'
