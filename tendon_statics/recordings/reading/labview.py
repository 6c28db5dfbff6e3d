"""The preamble of LabVIEW's measurement files, ``.lvm``."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ..errors import RecordingError
from .columns import find_columns
from .table_options import TableOptions
from .text_lines import Line, TextForm, separator_name, split
from .units import common_unit, split_title

LABVIEW = 'LabVIEW Measurement'
"""What such a file begins with"""

X_TITLE = 'X_Value'
"""Of times"""

NO_TIME = ''
"""Title in place of X_Value where it is empty"""

LABVIEW_END = '***End_of_Header***'


def labview_form(lines: list[Line], options: TableOptions) -> TextForm:
    """Read the preamble of a LabVIEW measurement file.

    Raises
    ------
    RecordingError
        If no titles follow it.
    """
    starts = [at for at, (_, line) in enumerate(lines) if line.startswith(X_TITLE.encode())]
    ends = [at for at, (_, line) in enumerate(lines) if line.startswith(LABVIEW_END.encode())]
    start = next(iter(starts), ends[-1] + 1 if ends else len(lines))
    header: dict[str, list[str]] = {}
    for _, line in lines[:start]:
        mark = '\t' if b'\t' in line else ','
        key, *values = line.decode(errors='replace').rstrip('\r\n').split(mark)
        header.setdefault(key.strip(), [value.strip() for value in values])
    named = _first(header, 'Separator', 'Tab')
    separator = options.separator or {'Tab': '\t', 'Comma': ','}.get(named, '\t')
    decimal = options.decimal or _first(header, 'Decimal_Separator', '.')
    if start >= len(lines):
        raise RecordingError('after the preamble of LabVIEW there are no titles')
    titles = split(lines[start][1], separator)
    has_times = _first(header, 'X_Columns', 'One') != 'No'
    if titles and titles[0] == X_TITLE:
        titles[0] = 'time' if has_times else NO_TIME
    rows = [line for line in lines[start + 1 :] if not line[1].startswith(LABVIEW_END.encode())]
    if titles and titles[-1] == 'Comment':
        # LabVIEW ends its rows before it where there is none.
        titles = titles[:-1]
        rows = [(number, _cut(line, separator, len(titles))) for number, line in rows]
    notes = [
        'a measurement file of LabVIEW: columns are separated by '
        f'{separator_name(separator)}, decimals by {decimal!r}'
    ]
    titles, said = _with_units(
        titles, _by_channel(header.get('Y_Unit_Label', ()), titles), options
    )
    notes += said
    columns, step = find_columns(titles, options), None
    if X_TITLE in titles[1:]:
        tensions = [columns.numbers[name].place for name in options.quantities.required]
        _refuse_times_apart(header, titles, tensions)
    if columns.time is None and options.rate is None:
        step, said = _step(header, len(starts))
        notes += said
    return TextForm(titles, separator, decimal, rows, notes, step)


def _first(header: Mapping[str, Sequence[str]], key: str, default: str) -> str:
    return next(filter(None, header.get(key, ())), default)


def _by_channel(values: Sequence[str], titles: Sequence[str]) -> dict[int, str]:
    """Place of each channel in a row → what a line of the preamble says of it.

    A value stands above its column, or the next one does where each channel has times.
    """
    channels = [at for at in range(1, len(titles)) if titles[at] != X_TITLE]
    above = {at: values[at - 1] for at in channels if at <= len(values)}
    told = [value for value in values if value]
    if len(told) == len(channels) and not all(above.get(at) for at in channels):
        return dict(zip(channels, told, strict=True))
    return above


def _with_units(
    titles: Sequence[str], labels: Mapping[int, str], options: TableOptions
) -> tuple[list[str], list[str]]:
    """Put the units of channels into their titles, where they are units; say what is not.

    What a title or an option says counts before. Raises what `find_columns` does.
    """
    columns = find_columns(titles, options)
    found, notes = [*titles], []
    for quantity, column in columns.numbers.items():
        label = labels.get(column.place, '')
        if not label or column.has_unit:
            continue
        unit = common_unit(label, options.quantities.kinds[quantity])
        if unit is not None:
            found[column.place] = f'{split_title(titles[column.place])[0]} [{unit}]'
            notes.append(f'{quantity}: in {unit}, by Y_Unit_Label')
        else:
            notes.append(
                f'{quantity}: its Y_Unit_Label is {label}, which is no unit of it, so it is taken '
                f'to be in SI or what a gain is for; --units {quantity}=UNIT says what it is in'
            )
    return found, notes


def _refuse_times_apart(
    header: Mapping[str, Sequence[str]], titles: Sequence[str], tensions: Sequence[int]
) -> None:
    """Raise RecordingError if tensions, each with times, were not measured together."""
    for key in ('X0', 'Delta_X'):
        told = _by_channel(header.get(key, ()), titles)
        values = {_number(told[place]) for place in tensions if told.get(place)}
        if len(values) > 1:
            raise RecordingError(
                f'its tensions were not measured at the same times, as their {key} is '
                f'{" and ".join(f"{of:g}" for of in sorted(values))}: they have to be sampled '
                'together, and saved with one X column or none'
            )


def _step(header: Mapping[str, Sequence[str]], segments: int) -> tuple[float | None, list[str]]:
    """Return how many s the preamble has from row to row, and why there are none."""
    steps = {_number(text) for text in header.get('Delta_X', ()) if text}
    dimensions = {text for text in header.get('X_Dimension', ()) if text} or {'Time'}
    if not steps:
        return None, []
    step = next(iter(steps))
    if len(steps) == segments == 1 and dimensions == {'Time'} and 0.0 < step < math.inf:
        return step, []
    why = (
        f'{segments} parts, of which the preamble does not say how far they are apart'
        if segments > 1
        else f'a Delta_X of {", ".join(f"{of:g}" for of in sorted(steps))}, which does not tell '
        'the times of rows'
    )
    return None, [f'it has no times, and {why}; --rate HZ says it']


def _number(text: str) -> float:
    try:
        return float(text.replace(',', '.'))
    except ValueError:
        return math.nan


def _cut(line: bytes, separator: str, count: int) -> bytes:
    """Return a row without what stands after so many fields."""
    mark = separator.encode()
    if line.count(mark) < count:
        return line
    return mark.join(line.split(mark)[:count]) + b'\n'
