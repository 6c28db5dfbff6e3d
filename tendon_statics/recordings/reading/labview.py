"""The preamble of LabVIEW's measurement files, ``.lvm``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..errors import RecordingError
from .columns import find_columns
from .table_options import TableOptions
from .text_lines import Line, TextForm, separator_name, split

LABVIEW = 'LabVIEW Measurement'
"""What such a file begins with"""

NO_TIME = 'no time'
"""Title in place of X_Value where it is empty"""

LABVIEW_END = '***End_of_Header***'


def labview_form(lines: list[Line], options: TableOptions) -> TextForm:
    """Read the preamble of a LabVIEW measurement file.

    Raises
    ------
    RecordingError
        If no titles follow it.
    """
    header: dict[str, str] = {}
    ends = [at for at, (_, line) in enumerate(lines) if line.startswith(LABVIEW_END.encode())]
    start = next(
        (at for at, (_, line) in enumerate(lines) if line.startswith(b'X_Value')),
        ends[-1] + 1 if ends else len(lines),
    )
    for _, line in lines[:start]:
        key, _, value = (
            line.decode(errors='replace').strip().partition('\t' if b'\t' in line else ',')
        )
        header.setdefault(key, value.strip())
    separator = options.separator or {'Tab': '\t', 'Comma': ','}.get(
        header.get('Separator', 'Tab'), '\t'
    )
    decimal = options.decimal or header.get('Decimal_Separator', '.')
    if start >= len(lines):
        raise RecordingError('after the preamble of LabVIEW there are no titles')
    titles = split(lines[start][1], separator)
    if titles and titles[0] == 'X_Value':
        titles[0] = NO_TIME if header.get('X_Columns') == 'No' else 'time'
    rows = [line for line in lines[start + 1 :] if not line[1].startswith(LABVIEW_END.encode())]
    if titles and titles[-1] == 'Comment':
        # LabVIEW ends its rows before it where there is none.
        titles = titles[:-1]
        rows = [(number, _cut(line, separator, len(titles))) for number, line in rows]
    find_columns(titles, options)
    notes = [
        'a measurement file of LabVIEW: columns are separated by '
        f'{separator_name(separator)}, decimals by {decimal!r}'
    ]
    return TextForm(titles, separator, decimal, rows, [*notes, *_unread(header, titles)])


def _unread(header: Mapping[str, str], titles: Sequence[str]) -> Iterator[str]:
    """Say what of the preamble has to be said by options."""
    step = header.get('Delta_X', '').split('\t')[0].replace(',', '.')
    if NO_TIME in titles and step:
        yield f'it has no times, but a Delta_X of {step} s from row to row, which --rate can say'
    units = header.get('Y_Unit_Label', '').split()
    if any(unit not in ('N', 'Newton', 'Newtons') for unit in units):
        yield f'its Y_Unit_Label is {" ".join(units)}, which --units can say'


def _cut(line: bytes, separator: str, count: int) -> bytes:
    """Return a row without what stands after so many fields."""
    mark = separator.encode()
    if line.count(mark) < count:
        return line
    return mark.join(line.split(mark)[:count]) + b'\n'
