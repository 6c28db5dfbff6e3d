"""The lines of a text file with a table, and how they are split into fields."""

from __future__ import annotations

import codecs
import csv
import re
from typing import NamedTuple

from ..errors import RecordingError
from .table_options import SEPARATORS, TableOptions

Line = tuple[int, bytes]
"""Number in the file, from 1, and content with its end"""


DECIMAL_COMMA = re.compile(r'[-+]?\d*,\d+(?:[eE][-+]?\d+)?')
"""A number whose decimals a comma separates"""


class TextForm(NamedTuple):
    """How the rows of a text file are read."""

    titles: list[str]
    separator: str
    decimal: str
    rows: list[Line]
    notes: list[str]
    """What was recognised that differs from plain CSV"""
    step: float | None = None
    """s from line to line, where the rows have no times"""

    def fields(self, line: bytes) -> list[str]:
        """Split a row.

        Raises
        ------
        ValueError, csv.Error
            If it is no text in UTF-8 without NUL, or not quoted soundly.
        """
        return split(line, self.separator)


def bare(content: bytes, options: TableOptions) -> tuple[bytes, list[str]]:
    """Return a file's content in UTF-8 without mark, and what it was in, if anything else.

    Raises
    ------
    RecordingError
        If it is UTF-16 without a mark.
    """
    if options.encoding is not None:
        text = content.decode(options.encoding, errors='replace')
        return text.lstrip('\ufeff').encode(), [f'encoding: {options.encoding}']
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = content.decode('utf-16', errors='replace')
        if not text.strip():
            raise RecordingError('it is not a text file with a table, but empty')
        return text.encode(), ['encoding: UTF-16']
    if content[1:40:2].count(0) > 10 or content[0:40:2].count(0) > 10:
        raise RecordingError(
            'it is not a text file in UTF-8: it looks like UTF-16 without a byte-order mark, '
            'which --encoding utf-16-le or utf-16-be reads'
        )
    return content.removeprefix(codecs.BOM_UTF8), []


def split(line: bytes, separator: str) -> list[str]:
    """Split a line into its fields, without the blanks around them."""
    text = line.decode().rstrip('\r\n')
    if '\0' in text:
        raise ValueError('a NUL')
    if separator == ' ':
        return text.split()
    if '"' in text:
        fields = next(csv.reader([text], delimiter=separator))
    else:
        fields = text.split(separator)
    return [field.strip() for field in fields]


def no_utf_8(error: UnicodeDecodeError) -> str:
    """Say why a line is no text in UTF-8, and what may read it."""
    return (
        f'it has the byte 0x{error.object[error.start]:02x}; if it is Latin-1, --encoding latin-1 '
        'reads it'
    )


def separator_name(separator: str) -> str:
    """Return a separator as an option names it."""
    return next((name for name, of in SEPARATORS.items() if of == separator), separator)
