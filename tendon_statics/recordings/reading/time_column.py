"""The column of times in a table, by the titles that exporters give it, and its values in s."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..errors import RecordingError
from ..session import Floats
from .moments import MOMENTS, UNKNOWN, has_zone, is_iso, is_of_day, is_span, nanoseconds_of
from .time_titles import RANK_OF_STAMPS, parse_time_title, place_of_date, place_of_nanoseconds
from .units import TIME

_EPOCHS = ((1e17, 1e19, 'ns'), (1e14, 1e17, 'us'), (1e11, 1e14, 'ms'))
"""Between which a time, if since 1970, is in that unit: in a larger one it would lie beyond the
year 5000"""

_WRITTEN_OUT = ((1.9e13, 2.1e13), (1.9e16, 2.1e16))
"""Between which a number is a date and time without marks, ``20261127100000``, if need be with
ms"""

DAY = 86_400_000_000_000
"""ns"""

MIDNIGHT = DAY // 24
"""ns that a time of day, which falls by nearly a day, may have gone on over midnight"""


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

    Raises
    ------
    RecordingError
        If they look like dates and times without marks.
    """
    unit, note = column.unit, ''
    if unit is None:
        finite = abs(values[np.isfinite(values)])
        first, last = (finite.min(), finite.max()) if len(finite) else (0.0, 0.0)
        if any(least <= first and last < most for least, most in _WRITTEN_OUT):
            raise RecordingError(
                f'{first:.0f} in the column {column.title} looks like a date and time without '
                f'marks: write it as in {MOMENTS}, or say --units time=UNIT if it is none'
            )
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


def times_of_moments(column: TimeColumn, texts: Sequence[str]) -> Times:
    """Turn dates and times, times of day or spans into times in s; an empty one is NaN.

    Raises
    ------
    RecordingError
        If one is something else, or may be of two days.
    """
    nanoseconds = nanoseconds_of(texts, column.title)
    first = next((text for text in texts if text.strip()), '')
    if is_of_day(first):
        return times_of_day(column, nanoseconds)
    if is_span(first):
        spans = f'time: the column {column.title}, of spans'
        return _since_first(nanoseconds, spans)._replace(origin=0)
    without_zone = any(text.strip() and not has_zone(text) for text in texts)
    return _since_first(
        nanoseconds,
        f'time: the column {column.title}, dates and times'
        + (' of ISO 8601' if is_iso(first) else '')
        + (', taken as UTC' if without_zone else ''),
    )


def times_of_day(column: TimeColumn, nanoseconds: np.ndarray) -> Times:
    """Turn times of day in ns into times in s; the least of all numbers is NaN.

    Where they fall by nearly a day, and nowhere by less, it was midnight.
    """
    known = nanoseconds != UNKNOWN
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
    known = nanoseconds != UNKNOWN
    origin = int(nanoseconds[known][0]) if known.any() else 0
    seconds = np.where(known, 1e-9 * (nanoseconds - origin).astype(np.float64), np.nan)
    return Times(seconds, origin, note)
