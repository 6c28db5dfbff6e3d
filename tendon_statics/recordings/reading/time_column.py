"""The column of times in a table, by the titles that exporters give it, and its values in s."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..errors import RecordingError
from ..session import Floats
from .units import TIME, split_title

TITLES = ('%time', 'timestamp', 'stamp', 'header.stamp', 'field.header.stamp', 't', '__time')
"""Titles of times besides ``time``, of which the first that is there counts; a leading path, and a
unit after an underscore or in brackets, make no difference"""

_SECONDS = re.compile(r'(?P<path>(?:.*[./])?stamp)[./](?:sec|secs)', re.IGNORECASE)
_UNIT = re.compile(r'(?P<name>.+?)\s*(?:_|\[|\()(?P<unit>s|ms|us|ns)[\])]?', re.IGNORECASE)

_EPOCHS = ((1e17, 1e19, 'ns'), (1e14, 1e17, 'us'), (1e11, 1e14, 'ms'))
"""Between which a time, if since 1970, is in that unit: in a larger one it would lie beyond the
year 5000"""

_ISO = re.compile(
    r'(\d{4}-\d\d-\d\d)[T ](\d\d:\d\d(?::\d\d(?:[.,]\d{1,9})?)?)\s*(Z|UTC|[+-]\d\d:?\d\d)?'
)


class TimeColumn(NamedTuple):
    """Where the time stands in a table."""

    place: int
    title: str
    unit: str | None = None
    """None: not said, so by its magnitude"""
    nanoseconds: int | None = None
    """Place of what is to be added in ns, where seconds and the rest stand apart"""


class Times(NamedTuple):
    """The times of a table."""

    seconds: Floats
    origin: int = 0
    """ns of the Unix epoch at which `seconds` is 0"""
    note: str = ''
    """How they were read, where that is not said in the title"""


def find_time(titles: Sequence[str]) -> TimeColumn | None:
    """Find the column of times among titles none of which is ``time``."""
    found: dict[str, TimeColumn] = {}
    for place, title in enumerate(titles):
        apart = _SECONDS.fullmatch(title.strip())
        rest = apart and _place_of_nanoseconds(titles, apart['path'])
        if rest is not None:
            found.setdefault('header.stamp', TimeColumn(place, title, 's', rest))
            continue
        name, unit = split_title(title)
        match = None if unit else _UNIT.fullmatch(name)
        if match:
            name, unit = match['name'], match['unit'].lower()
        for known in TITLES:
            if _means(name, known) and (unit is None or unit in TIME.units):
                found.setdefault(known, TimeColumn(place, title, unit))
    return next((found[title] for title in TITLES if title in found), None)


def _place_of_nanoseconds(titles: Sequence[str], path: str) -> int | None:
    for place, title in enumerate(titles):
        if re.fullmatch(rf'{re.escape(path)}[./](?:nanosec|nsecs|nsec)', title.strip(), re.I):
            return place
    return None


def _means(name: str, known: str) -> bool:
    name = name.strip().casefold().replace('/', '.')
    return name == known or (known.endswith('stamp') and name.endswith(f'.{known}'))


def times_of(column: TimeColumn, values: Floats, nanoseconds: Floats | None = None) -> Times:
    """Turn numbers into times in s.

    Without a unit they are in s, unless they are so large that they can only be in ms, µs or ns
    since 1970.
    """
    unit, note = column.unit, ''
    if unit is None:
        finite = abs(values[np.isfinite(values)])
        first, last = (finite.min(), finite.max()) if len(finite) else (0.0, 0.0)
        unit = next((u for least, most, u in _EPOCHS if least < first and last < most), 's')
        since = f' since 1970, as {last:.4g} s would be far from now' if unit != 's' else ''
        if since or column.title != 'time':
            note = f'time: the column {column.title}, in {unit}{since}'
    elif column.title.strip() != f'time [{unit}]':
        note = f'time: the column {column.title}, in {unit}'
    factor = TIME.units[unit]
    # Dividing by a whole number is exact where multiplying by its inverse is not.
    seconds = values / round(1.0 / factor) if factor < 1.0 else values
    if nanoseconds is not None:
        first = np.flatnonzero(np.isfinite(values))
        whole = float(values[first[0]]) if len(first) else 0.0
        # The whole seconds apart, or there is no room for the digits of the rest.
        return Times(
            (values - whole) + nanoseconds / 1e9,
            round(whole * 1e9),
            f'time: the columns {column.title} and its nanoseconds',
        )
    return Times(seconds, 0, note)


def is_iso(text: str) -> bool:
    """Whether a field is a date and time of ISO 8601."""
    return _ISO.fullmatch(text.strip()) is not None


def times_of_iso(column: TimeColumn, texts: Sequence[str]) -> Times:
    """Turn dates and times of ISO 8601 into times in s; an empty one is NaN.

    Raises
    ------
    RecordingError
        If one is something else.
    """
    moments: list[Any] = []
    without_zone = False
    for text in texts:
        match = _ISO.fullmatch(text.strip())
        if match is None:
            if text.strip():
                raise RecordingError(f'{text!r} in the column {column.title} is no time')
            moments.append(np.datetime64('NaT', 'ns'))
            continue
        day, clock, zone = match.groups()
        moment = np.datetime64(f'{day}T{clock.replace(",", ".")}', 'ns')
        if zone and zone not in ('Z', 'UTC'):
            sign = 1 if zone[0] == '+' else -1
            minutes = 60 * int(zone[1:3]) + int(zone[-2:])
            moment = moment - np.timedelta64(sign * minutes, 'm')
        without_zone = without_zone or not zone
        moments.append(moment)
    zone_note = ', taken as UTC' if without_zone else ''
    return _since_first(
        np.array(moments, dtype='datetime64[ns]').astype(np.int64),
        f'time: the column {column.title}, dates and times of ISO 8601{zone_note}',
    )


def times_of_nanoseconds(column: TimeColumn, nanoseconds: np.ndarray) -> Times:
    """Turn ns since 1970 into times in s; the least of all numbers is NaN, as in NumPy."""
    return _since_first(nanoseconds, f'time: the column {column.title}, of timestamps')


def _since_first(nanoseconds: np.ndarray, note: str) -> Times:
    known = nanoseconds != np.iinfo(np.int64).min
    origin = int(nanoseconds[known][0]) if known.any() else 0
    seconds = np.where(known, 1e-9 * (nanoseconds - origin).astype(np.float64), np.nan)
    return Times(seconds, origin, note)
