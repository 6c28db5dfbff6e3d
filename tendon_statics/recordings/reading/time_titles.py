"""The titles that exporters give to times: which they are, and in which unit."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple


def _listed(text: str) -> frozenset[str]:
    return frozenset(text.split())


_IN_SECONDS = {
    's': 's sec secs second seconds sekunde sekunden',
    'ms': 'ms msec msecs millis millisecond milliseconds millisekunden',
    'us': 'us µs μs usec usecs micros microsecond microseconds mikrosekunden',
    'ns': 'ns nanos nanosecond nanoseconds nanosekunden',
    'min': 'min mins minute minutes minuten',
    'h': 'h hour hours stunden',
    'd': 'd day days tage',
}
_UNITS = {name: unit for unit, names in _IN_SECONDS.items() for name in names.split()}
"""Name of a unit, in small letters → as it is written here"""

_LONG_UNITS = ('min', 'h', 'd')
"""Those that stand in a title only where it is plain that they are units: ``t_min`` may be a least
time"""

_ALONE = {
    name
    for name in _UNITS
    if len(name) > 1 and _UNITS[name] not in _LONG_UNITS and name != 'second'
}
"""Units that are the whole of a title, as in ``millis``; ``s`` is a cable"""

RANK_OF_STAMPS = 2

_RANKS = {
    **dict.fromkeys(
        _listed('time zeit messzeit laufzeit uhrzeit temps tiempo tempo tijd tid czas'), 0
    ),
    **dict.fromkeys(_listed('elapsed uptime walltime systime simtime rostime unixtime'), 0),
    **dict.fromkeys(('timestamp', 'timestamps', 'zeitstempel'), 1),
    'stamp': RANK_OF_STAMPS,
    **dict.fromkeys(('datetime', 'epoch', 'clock'), 3),
    **dict.fromkeys(('t', 'tout'), 4),
}
"""What a title of times has in it → its rank, where there are several; the least counts"""

TIME_WORDS = frozenset(_RANKS)
"""Words of which each is in the title of some times"""

_HIDDEN, _LONE, _ARRIVAL = 5, 6, 10
"""Ranks of ``__time``, of a unit alone, and what is added for times that are not of measurement"""

_OF_ARRIVAL = _listed(
    'rosbag bag log publish published receive received recv record recorded recording system sys '
    'wall host'
)
_BESIDE = _OF_ARRIVAL | _listed(
    'elapsed relative rel absolute abs header field ros unix posix epoch sim simulation sensor '
    'utc gmt local boot since start x value date msg message data measurement test run in '
    'datum abgelaufene verstrichene der seit'
)
"""What else may stand in a title of times"""

_DATES = (['date'], ['datum'])

_NANOSECONDS = ('nanosec', 'nanosecs', 'nsec', 'nsecs')
"""What is called so beside seconds is to be added to them"""

_WORD = re.compile(r'[A-ZÄÖÜ]+(?![a-zäöüß])|[A-ZÄÖÜ]?[^\W\d_A-ZÄÖÜ]+|\d+')
_MARKED_UNIT = re.compile(
    r'(?P<name>.*?[^\W_].*?)\s*(?:[\[(]\s*(?P<inside>[^\[\]()]*?)\s*[\])]'
    r'|(?:\s*/\s*|,\s*|\s+in\s+)(?P<after>[^\W\d_]+))\s*'
)


class TimeTitle(NamedTuple):
    """What a title of times says."""

    rank: int
    """Where there are several, the least counts"""
    unit: str | None = None
    """None: not said"""
    strange_unit: str = ''
    """What stands where a unit should, if it is none"""


def time_unit(name: str) -> str | None:
    """Return a unit of time as it is written here, by any name of it; None if it is none."""
    return name if name in _IN_SECONDS else _UNITS.get(name.casefold())


def parse_time_title(title: str) -> TimeTitle | None:
    """Return what a title says if it is one of times, else None."""
    title = title.strip()
    whole = _parse(title)
    if whole is not None:
        return whole
    # With a path before it, as ROS has them.
    last = re.split(r'[./]', title)[-1]
    parsed = _parse(last) if last != title else None
    if parsed is not None and _RANKS['t'] != parsed.rank < _LONE:
        return parsed
    words = _words(title)
    unit = _UNITS.get(words[-1]) if words else None
    if words[-3:-1] == ['header', 'stamp'] and unit is not None:
        return TimeTitle(RANK_OF_STAMPS, unit)
    return TimeTitle(RANK_OF_STAMPS) if words[-2:] == ['header', 'stamp'] else None


def _parse(title: str) -> TimeTitle | None:
    marked = _MARKED_UNIT.fullmatch(title)
    if marked is not None:
        inside = marked['inside']
        given = marked['after'] if inside is None else inside
        rank = _rank(marked['name'], _words(marked['name']))
        if rank is None or rank == _LONE:
            return None
        unit = time_unit(given)
        if unit is not None:
            return TimeTitle(rank, unit)
        if inside is None:
            return None
        if all(word in _BESIDE for word in _words(given)):
            return TimeTitle(rank)
        return TimeTitle(rank, strange_unit=given)
    words = _words(title)
    unit = _UNITS.get(words[-1]) if len(words) > 1 else None
    if unit is not None and unit not in _LONG_UNITS:
        rank = _rank(title, words[:-1])
        return None if rank is None or rank == _LONE else TimeTitle(rank, unit)
    rank = _rank(title, words)
    if rank == _LONE:
        return TimeTitle(rank, _UNITS[words[0]])
    return None if rank is None else TimeTitle(rank)


def _words(title: str) -> list[str]:
    """The words of a title in small letters, of which a capital begins one, too."""
    words = [word.casefold() for word in _WORD.findall(title)]
    joined: list[str] = []
    for word in words:
        if joined and (joined[-1], word) in (('time', 'stamp'), ('date', 'time')):
            joined[-1] += word
        else:
            joined.append(word)
    return joined


def _rank(title: str, words: list[str]) -> int | None:
    if len(words) == 1 and words[0] in _ALONE:
        return _LONE
    heads = [word for word in words if word in _RANKS]
    if not heads or not all(word in _RANKS or word in _BESIDE for word in words):
        return None
    if title.startswith('_'):
        return _HIDDEN
    return min(_RANKS[word] for word in heads) + _ARRIVAL * any(
        word in _OF_ARRIVAL for word in words
    )


def place_of_nanoseconds(titles: Sequence[str], place: int) -> int | None:
    """Return where the rest in ns stands of times whose whole seconds are at a place."""
    path = _before(titles[place], ('sec', 'secs'))
    if path is None or not (not path or path[-1] in ('stamp', 'timestamp', 'time')):
        return None
    return next(
        (at for at, title in enumerate(titles) if _before(title, _NANOSECONDS) == path), None
    )


def _before(title: str, last: Sequence[str]) -> list[str] | None:
    words = _words(title)
    return words[:-1] if words and words[-1] in last else None


def place_of_date(titles: Sequence[str]) -> int | None:
    """Return where dates stand, of times of day."""
    return next((at for at, title in enumerate(titles) if _words(title) in _DATES), None)
