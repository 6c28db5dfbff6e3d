"""Whether a tension has changed faster than its driver can change it."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

MOST_UNCONFIRMED = 3
"""Readings that are kept until one of them is confirmed"""

BACK = 0.1
"""Share of the way back to the last tension believed at which a reading comes back"""


@dataclasses.dataclass
class RateCheck:
    """Believes readings that no faster change explains than is believed.

    The first reading has none before it that it could be held against, and nor has one after so
    long a time that the rate allows anything: another has to confirm it. After one that was too
    fast, a true step stays, and is believed once there was time for it; what comes back is on the
    way down of a spike, and believed only when it has come back.
    """

    newest: float = math.nan
    """N; the newest that was believed, NaN until one is confirmed"""
    time: float = math.nan
    """s; of it"""
    before: tuple[float, float] = (math.nan, math.nan)
    """N and s of the newest reading of all"""
    level: tuple[float, float] = (math.nan, math.nan)
    """N and s since which readings stay where they are, after one that was too fast"""
    unconfirmed: list[tuple[float, float]] = dataclasses.field(default_factory=list)
    """The readings of all in N and s until one is confirmed"""

    @property
    def is_confirmed(self) -> bool:
        """Whether another reading agreed with those that are believed."""
        return not math.isnan(self.newest)

    def allows(self, tension: float, time: float, max_rate: float, most: float) -> bool:
        """Take a reading in N at a time in s; return whether it came slowly enough.

        A rate between readings of one time, or of none, is not checked.

        Parameters
        ----------
        max_rate : float
            N/s.
        most : float
            Largest tension of all in N.
        """
        if max_rate * (time - self.time) >= most:
            self.newest = self.time = math.nan
            self.unconfirmed.clear()
        allowed = self._allows(tension, time, max_rate)
        if allowed and (self.is_confirmed or self._is_unchecked(time)):
            self.newest, self.time = tension, time
            self.level = (math.nan, math.nan)
        self.before = (tension, time)
        return allowed

    def _is_unchecked(self, time: float) -> bool:
        return math.isnan(time) or (self.is_confirmed and not time > self.time)

    def _allows(self, tension: float, time: float, max_rate: float) -> bool:
        if self._is_unchecked(time):
            return True
        if not self.is_confirmed:
            is_first = not self.unconfirmed
            if any(
                not time > at or abs(tension - of) <= max_rate * (time - at)
                for of, at in self.unconfirmed
            ):
                self.newest, self.time = tension, time
                self.unconfirmed.clear()
                return True
            self.unconfirmed = [*self.unconfirmed, (tension, time)][-MOST_UNCONFIRMED:]
            return is_first
        away = abs(tension - self.newest)
        if away > max_rate * (time - self.time):
            self._note_level(tension, time, away)
            return False
        if math.isnan(self.level[0]):  # none was too fast since
            return True
        last, at = self.before
        in_one_step = max_rate * (time - at)
        if away <= in_one_step:
            return True
        self._note_level(tension, time, away)
        is_coming_back = away < abs(last - self.newest)
        stayed = max_rate * (time - self.level[1])
        return away <= stayed or not (is_coming_back or abs(tension - last) > in_one_step)

    def _note_level(self, tension: float, time: float, away: float) -> None:
        level = self.level[0]
        if math.isnan(level) or abs(tension - level) > BACK * away:
            self.level = (tension, time)

    def rescale(self, scale: Callable[[float], float]) -> None:
        """Go on with readings in other newtons."""
        self.newest = scale(self.newest)
        self.before = (scale(self.before[0]), self.before[1])
        self.level = (scale(self.level[0]), self.level[1])
        self.unconfirmed = [(scale(of), at) for of, at in self.unconfirmed]
