"""Dates and times of day, and spans of time, as programs write them in texts."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import RecordingError

MOMENTS = '2026-11-27T10:00:00.5, 27.11.2026 10:00:00,5 or 10:00:00.5'
"""How dates and times may be written, for people"""

SECOND = 1_000_000_000
"""ns"""

UNKNOWN = np.iinfo(np.int64).min
"""In place of the ns of a moment that is missing"""

_MONTHS = ('jan', 'feb', 'mar', 'apr', 'may', 'jun', 'jul', 'aug', 'sep', 'oct', 'nov', 'dec')

_CLOCK = (
    r'(?P<clock>\d{1,2}:\d\d(?::\d\d(?:[.,]\d{1,9})?)?)(?:\s*(?P<half>[AaPp])\.?[Mm]\.?(?!\w))?'
)
_DAY = (
    r'(?:(?P<iso>\d{4})(?P<mark>[-/])(?P<month>\d\d)(?P=mark)(?P<day>\d\d)'
    r'|(?P<german>\d{1,2}\.\d{1,2}\.\d{4})'
    r'|(?P<english>\d{1,2}-[A-Za-z]{3}-\d{4})'
    r'|(?P<slashed>\d{1,2}/\d{1,2}/\d{4}))'
)
_MOMENT = re.compile(
    rf'(?:{_DAY}(?:T|,?\s+))?{_CLOCK}\s*(?P<zone>Z|UTC|[+-]\d\d:?\d\d)?'
    r'|(?P<days>\d+) days?'
    r'(?:,?\s+(?P<hours>\d\d):(?P<minutes>\d\d):(?P<seconds>\d\d(?:\.\d{1,9})?))?'
    r'|(?P<number>\d+(?:\.\d+)?) (?P<unit>sec|min|hr)'
)
"""A date and time of day, or a time of day alone; a span as pandas or MATLAB writes it"""

_SPANS = {'sec': 1, 'min': 60, 'hr': 3600}


def is_moment(text: str) -> bool:
    """Whether a field is a date and time, a time of day, or a span of time."""
    return _MOMENT.fullmatch(text.strip()) is not None


def is_of_day(text: str) -> bool:
    """Whether a field is a time of day without a date."""
    match = _MOMENT.fullmatch(text.strip())
    return match is not None and match['clock'] is not None and not _date_in(match)


def is_span(text: str) -> bool:
    """Whether a field is a span of time."""
    match = _MOMENT.fullmatch(text.strip())
    return match is not None and match['clock'] is None


def is_iso(text: str) -> bool:
    """Whether a field has a date as in ISO 8601."""
    match = _MOMENT.fullmatch(text.strip())
    return match is not None and match['iso'] is not None


def has_zone(text: str) -> bool:
    """Whether a field says its time zone."""
    match = _MOMENT.fullmatch(text.strip())
    return match is not None and match['zone'] is not None


def nanoseconds_of(texts: Sequence[str], title: str) -> NDArray[np.int64]:
    """Return ns since 1970, or of the day or span, of texts in a column; `UNKNOWN` of empty ones.

    Raises
    ------
    RecordingError
        If one is something else, or may be of two days.
    """
    matches = [_MOMENT.fullmatch(text.strip()) for text in texts]
    for text, match in zip(texts, matches, strict=True):
        if match is None and text.strip():
            raise _no_time(text, title)
    day_first = _day_first(texts, matches, title)
    found = np.full(len(texts), UNKNOWN)
    for place, (text, match) in enumerate(zip(texts, matches, strict=True)):
        try:
            if match is not None:
                found[place] = _nanoseconds(match, day_first)
        except ValueError:
            raise _no_time(text, title) from None
    return found


def _no_time(text: str, title: str, why: str = '') -> RecordingError:
    return RecordingError(
        f'{text.strip()!r} in the column {title} is no time: {why}it may be as in {MOMENTS}; '
        '--columns time=TITLE names another column'
    )


def _date_in(match: re.Match[str]) -> bool:
    return any(match[name] for name in ('iso', 'german', 'english', 'slashed'))


def _day_first(texts: Sequence[str], matches: Sequence[re.Match[str] | None], title: str) -> bool:
    """Whether dates with strokes have the day first, as most do, or the month, as in the US.

    Raises
    ------
    RecordingError
        If no date tells it.
    """
    slashed = {match['slashed']: text for text, match in zip(texts, matches, strict=True) if match}
    slashed.pop(None, None)
    pairs = [tuple(map(int, date.split('/')[:2])) for date in slashed]
    first, second = (any(pair[at] > 12 for pair in pairs) for at in (0, 1))
    if pairs and first == second:
        raise _no_time(
            next(iter(slashed.values())), title, 'its day may be the first or the second number; '
        )
    return first


def _nanoseconds(match: re.Match[str], day_first: bool) -> int:
    """Return the ns of a moment; ValueError if there is none such."""
    if match['clock'] is None:
        return _span(match)
    hour, _, rest = match['clock'].replace(',', '.').partition(':')
    if match['half']:
        if not 1 <= int(hour) <= 12:
            raise ValueError(hour)
        hour = str(int(hour) % 12 + 12 * (match['half'] in 'pP'))
    moment: Any = np.datetime64(f'{_date(match, day_first)}T{hour:0>2}:{rest}', 'ns')
    zone = match['zone']
    if zone and zone not in ('Z', 'UTC'):
        sign = 1 if zone[0] == '+' else -1
        moment -= np.timedelta64(sign * (60 * int(zone[1:3]) + int(zone[-2:])), 'm')
    return int(moment.astype(np.int64))


def _date(match: re.Match[str], day_first: bool) -> str:
    if match['iso']:
        return '-'.join(match.group('iso', 'month', 'day'))
    if match['german']:
        day, month, year = match['german'].split('.')
    elif match['english']:
        day, name, year = match['english'].split('-')
        month = str(_MONTHS.index(name.casefold()) + 1)
    elif match['slashed']:
        day, month, year = match['slashed'].split('/')
        if not day_first:
            day, month = month, day
    else:
        return '1970-01-01'
    return f'{year}-{month:0>2}-{day:0>2}'


def _span(match: re.Match[str]) -> int:
    if match['number']:
        return round(float(match['number']) * _SPANS[match['unit']] * SECOND)
    whole = 86_400 * int(match['days'])
    if match['hours']:
        whole += 3600 * int(match['hours']) + 60 * int(match['minutes'])
    return whole * SECOND + round(float(match['seconds'] or 0.0) * SECOND)
