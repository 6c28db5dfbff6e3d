"""The column of times in a table, by the titles that exporters give it, and its values in s."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..errors import RecordingError
from ..session import Floats
from .time_titles import RANK_OF_STAMPS, parse_time_title, place_of_date, place_of_nanoseconds
from .units import TIME

_EPOCHS = ((1e17, 1e19, 'ns'), (1e14, 1e17, 'us'), (1e11, 1e14, 'ms'))
"""Between which a time, if since 1970, is in that unit: in a larger one it would lie beyond the
year 5000"""

_CLOCK = r'(?P<clock>\d{1,2}:\d\d(?::\d\d(?:[.,]\d{1,9})?)?)'
_DAY = (
    r'(?:(?P<year>\d{4})[-/](?P<month>\d\d)[-/](?P<day>\d\d)'
    r'|(?P<german>\d{1,2}\.\d{1,2}\.\d{4}))'
)
_MOMENT = re.compile(rf'(?:{_DAY}(?:T|,?\s+))?{_CLOCK}\s*(?P<zone>Z|UTC|[+-]\d\d:?\d\d)?')
"""A date and time of day, or a time of day alone"""

DAY = 86_400_000_000_000
"""ns"""

MIDNIGHT = DAY // 24
"""ns that a time of day, which falls by nearly a day, may have gone on over midnight"""

MOMENTS = '2026-11-27T10:00:00.5, 27.11.2026 10:00:00,5 or 10:00:00.5'
"""How dates and times may be written, for people"""


class TimeColumn(NamedTuple):
    """Where the time stands in a table."""

    place: int
    title: str
    unit: str | None = None
    """None: not said, so by its magnitude"""
    nanoseconds: int | None = None
    """Place of what is to be added in ns, where seconds and the rest stand apart"""
    date: int | None = None
    """Place of the dates, where the time may be one of day"""

    @property
    def places(self) -> list[int]:
        """Places of all that makes a time."""
        return [at for at in (self.place, self.nanoseconds, self.date) if at is not None]


class Times(NamedTuple):
    """The times of a table."""

    seconds: Floats
    origin: int = 0
    """ns of the Unix epoch at which `seconds` is 0"""
    note: str = ''
    """How they were read, where that is not said in the title"""


def find_time(titles: Sequence[str]) -> TimeColumn | None:
    """Find the column of times by the titles of exporters; of several that of measurement.

    Raises
    ------
    RecordingError
        If the only one has something that is no unit where one should stand.
    """
    found: list[tuple[int, bool, TimeColumn]] = []
    strange: list[tuple[str, str]] = []
    date = place_of_date(titles)
    for place, title in enumerate(titles):
        rest = place_of_nanoseconds(titles, place)
        parsed = parse_time_title(title)
        if parsed is not None and parsed.strange_unit:
            strange.append((title, parsed.strange_unit))
        elif parsed is not None:
            column = TimeColumn(place, title.strip(), parsed.unit, rest, date)
            # Whole seconds and their rest are a stamp, whatever they are called.
            rank = parsed.rank if rest is None else min(parsed.rank, RANK_OF_STAMPS)
            found.append((rank, rest is None, column))
    if not found and strange:
        title, unit = strange[0]
        raise RecordingError(
            f'the column {title!r} looks like the time, in {unit!r}, which is no unit of it; '
            f'there are {", ".join(TIME.units)}: --columns time="{title}" --units time=UNIT '
            'says which, --columns time=TITLE names another column'
        )
    return min(found, key=lambda of: of[:2])[2] if found else None


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
    elif column.title != f'time [{unit}]':
        note = f'time: the column {column.title}, in {unit}'
    factor = TIME.units[unit]
    # Dividing by a whole number is exact where multiplying by its inverse is not.
    seconds = values / round(1.0 / factor) if factor < 1.0 else values * factor
    seconds = np.where(np.isfinite(seconds), seconds, np.nan)
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


def is_moment(text: str) -> bool:
    """Whether a field is a date and time, or a time of day."""
    return _MOMENT.fullmatch(text.strip()) is not None


def is_of_day(text: str) -> bool:
    """Whether a field is a time of day without a date."""
    match = _MOMENT.fullmatch(text.strip())
    return match is not None and match['year'] is None and match['german'] is None


def times_of_moments(column: TimeColumn, texts: Sequence[str]) -> Times:
    """Turn dates and times, or times of day, into times in s; an empty one is NaN.

    Raises
    ------
    RecordingError
        If one is something else.
    """
    moments = [_moment(text.strip(), column) for text in texts]
    nanoseconds = np.array(moments, dtype='datetime64[ns]').astype(np.int64)
    first = next((text for text in texts if text.strip()), '')
    if is_of_day(first):
        return times_of_day(column, nanoseconds)
    is_iso = '-' in first[:5]
    without_zone = any(text.strip() and not _has_zone(text) for text in texts)
    return _since_first(
        nanoseconds,
        f'time: the column {column.title}, dates and times'
        + (' of ISO 8601' if is_iso else '')
        + (', taken as UTC' if without_zone else ''),
    )


def _has_zone(text: str) -> bool:
    match = _MOMENT.fullmatch(text.strip())
    return match is not None and match['zone'] is not None


def _moment(text: str, column: TimeColumn) -> Any:
    match = _MOMENT.fullmatch(text)
    if match is None:
        if text:
            raise RecordingError(
                f'{text!r} in the column {column.title} is no time; it may be as in {MOMENTS}'
            )
        return np.datetime64('NaT', 'ns')
    date = '-'.join(match.group('year', 'month', 'day')) if match['year'] else '1970-01-01'
    if match['german']:
        day, month, year = match['german'].split('.')
        date = f'{year}-{month:0>2}-{day:0>2}'
    try:
        hour, _, rest = match['clock'].replace(',', '.').partition(':')
        moment = np.datetime64(f'{date}T{hour:0>2}:{rest}', 'ns')
    except ValueError:
        raise RecordingError(f'{text!r} in the column {column.title} is no time') from None
    zone = match['zone']
    if zone and zone not in ('Z', 'UTC'):
        sign = 1 if zone[0] == '+' else -1
        minutes = 60 * int(zone[1:3]) + int(zone[-2:])
        moment = moment - np.timedelta64(sign * minutes, 'm')
    return moment


def times_of_day(column: TimeColumn, nanoseconds: np.ndarray) -> Times:
    """Turn times of day in ns into times in s; the least of all numbers is NaN.

    Where they fall by nearly a day, and nowhere by less, it was midnight.
    """
    known = nanoseconds != np.iinfo(np.int64).min
    of_day = nanoseconds[known]
    steps = np.diff(of_day)
    midnights = (steps <= MIDNIGHT - DAY) & (steps > -DAY)
    note = f'time: the column {column.title}, times of day'
    if midnights.any() and (steps[~midnights] >= 0).all():
        of_day = of_day + DAY * np.concatenate([[0], np.cumsum(midnights)])
        count = int(midnights.sum())
        note += f', over midnight{f" {count} times" * (count > 1)}, where they begin anew'
    nanoseconds = nanoseconds.copy()
    nanoseconds[known] = of_day
    return _since_first(nanoseconds, note)._replace(origin=0)


def times_of_nanoseconds(column: TimeColumn, nanoseconds: np.ndarray) -> Times:
    """Turn ns since 1970 into times in s; the least of all numbers is NaN, as in NumPy."""
    return _since_first(nanoseconds, f'time: the column {column.title}, of timestamps')


def _since_first(nanoseconds: np.ndarray, note: str) -> Times:
    known = nanoseconds != np.iinfo(np.int64).min
    origin = int(nanoseconds[known][0]) if known.any() else 0
    seconds = np.where(known, 1e-9 * (nanoseconds - origin).astype(np.float64), np.nan)
    return Times(seconds, origin, note)
