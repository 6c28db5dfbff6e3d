"""Two streams of values, one of each cable, as pairs of one time."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import Any, NamedTuple

from .stamp_order import NANOSECONDS

MOST_WAITING = 1000
"""Values of one cable that wait for those of the other"""


class Single(NamedTuple):
    """What was measured of one cable."""

    time: int
    """ns"""
    value: float
    source: Any = None
    """Whatever the pair should carry along"""


class Pairing:
    """Pairs each value with the nearest one of the other cable that is free when the later comes.

    Parameters
    ----------
    max_skew : callable
        Returns the most that two times of a pair may differ, in s.
    deliver : callable
        Takes a pair, cable l first.
    drop : callable
        Takes a value that has no partner, with its cable, 0 for l and 1 for s.
    """

    def __init__(
        self,
        max_skew: Callable[[], float],
        deliver: Callable[[Single, Single], None],
        drop: Callable[[int, Single], None],
    ) -> None:
        self._max_skew = max_skew
        self._deliver = deliver
        self._drop = drop
        self._waiting: tuple[deque[Single], deque[Single]] = (deque(), deque())
        self._paired = [-math.inf, -math.inf]

    def take(self, cable: int, single: Single) -> None:
        """Take a value of cable 0 (l) or 1 (s)."""
        waiting = self._waiting[cable]
        while waiting and waiting[-1].time >= single.time:  # The stream has started over.
            self._drop_first(cable)
        waiting.append(single)
        if len(waiting) > MOST_WAITING:
            self._drop_first(cable)
        self._pair()

    def forget(self) -> None:
        """Drop what waits, and forget what was paired."""
        self._paired = [-math.inf, -math.inf]
        for cable, waiting in enumerate(self._waiting):
            while waiting:
                self._drop_first(cable)

    def _pair(self) -> None:
        """Deliver every pair, and drop what has no partner any more."""
        at_l, at_s = self._waiting
        skew = self._max_skew() * NANOSECONDS
        while at_l and at_s:
            difference = at_l[0].time - at_s[0].time
            if abs(difference) > skew:
                self._drop_first(0 if difference < 0 else 1)
                continue
            # Where max_skew exceeds the period, one lost message must not shift all pairs after
            # it: what is much nearer to a message that already has a partner is left out. Not
            # what is a little nearer: cells that run freely may be half a period apart.
            if abs(at_l[0].time - self._paired[1]) < 0.5 * abs(difference):
                self._drop_first(0)
                continue
            if abs(at_s[0].time - self._paired[0]) < 0.5 * abs(difference):
                self._drop_first(1)
                continue
            value_l, value_s = at_l.popleft(), at_s.popleft()
            self._paired = [value_l.time, value_s.time]
            self._deliver(value_l, value_s)

    def _drop_first(self, cable: int) -> None:
        self._drop(cable, self._waiting[cable].popleft())
