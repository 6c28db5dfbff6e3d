"""Streams of values, each of one cable or several, as sets of all cables at one time."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from .stamp_order import NANOSECONDS

MOST_WAITING = 1000
"""Parts of one stream that wait for those of the others"""


class Part(NamedTuple):
    """What was measured at one time of one cable, or of several together."""

    time: int
    """ns"""
    values: Mapping[int, float]
    """By the number of the cable, from 0 on"""
    source: Any = None
    """Whatever the whole should carry along"""


class Pairing:
    """Joins parts to wholes: each with the nearest ones of the others when the last of them comes.

    Parts of the same cables are a stream. Where a part comes of other cables than any before, the
    streams with which it shares a cable have ended.

    Parameters
    ----------
    count : int
        How many cables there are.
    max_skew : callable
        Returns the most that two times of a whole may differ, in s.
    deliver : callable
        Takes the parts of a whole, in the order of their cables.
    drop : callable
        Takes a part that has no partner.
    """

    def __init__(
        self,
        count: int,
        max_skew: Callable[[], float],
        deliver: Callable[[list[Part]], None],
        drop: Callable[[Part], None],
    ) -> None:
        self._count = count
        self._max_skew = max_skew
        self._deliver = deliver
        self._drop = drop
        self._waiting: dict[tuple[int, ...], deque[Part]] = {}
        """Stream, by its cables → its parts"""
        self._joined: dict[tuple[int, ...], float] = {}
        """Stream → time of the newest part that was delivered"""

    def take(self, part: Part) -> None:
        """Take a part; it has some of the cables, not all."""
        stream = tuple(part.values)
        if stream not in self._waiting:
            self._begin(stream)
        waiting = self._waiting[stream]
        while waiting and waiting[-1].time >= part.time:  # The stream has started over.
            self._drop(waiting.popleft())
        waiting.append(part)
        if len(waiting) > MOST_WAITING:
            self._drop(waiting.popleft())
        if sum(map(len, self._waiting)) == self._count:
            self._join()

    def forget(self) -> None:
        """Drop what waits, and forget what was joined."""
        for waiting in self._waiting.values():
            while waiting:
                self._drop(waiting.popleft())
        self._waiting.clear()
        self._joined.clear()

    def _begin(self, stream: tuple[int, ...]) -> None:
        for other in [other for other in self._waiting if not set(other).isdisjoint(stream)]:
            for part in self._waiting.pop(other):
                self._drop(part)
            del self._joined[other]
        self._waiting[stream] = deque()
        self._joined[stream] = -math.inf
        self._waiting = dict(sorted(self._waiting.items()))

    def _join(self) -> None:
        """Deliver every whole, and drop what has no partner any more."""
        skew = self._max_skew() * NANOSECONDS
        while all(self._waiting.values()):
            first = {stream: waiting[0] for stream, waiting in self._waiting.items()}
            earliest = min(first, key=lambda stream: first[stream].time)
            latest = max(part.time for part in first.values())
            if latest - first[earliest].time > skew:
                self._drop(self._waiting[earliest].popleft())
                continue
            late = next((stream for stream in first if self._is_left_over(stream, first)), None)
            if late is not None:
                self._drop(self._waiting[late].popleft())
                continue
            for stream, waiting in self._waiting.items():
                self._joined[stream] = waiting.popleft().time
            self._deliver(list(first.values()))

    def _is_left_over(
        self, stream: tuple[int, ...], first: Mapping[tuple[int, ...], Part]
    ) -> bool:
        """Whether a part belongs to the whole before, where its stream has been replaced.

        Where max_skew exceeds the period, one lost message must not shift all wholes after it:
        what is much nearer to a part that already has its partners is left out. Not what is a
        little nearer: n streams that run freely may be a nth of a period apart.
        """
        time = first[stream].time
        apart = max(abs(part.time - time) for part in first.values())
        before = min(
            abs(time - joined) for other, joined in self._joined.items() if other != stream
        )
        return before < 0.5 * apart / (len(first) - 1)
