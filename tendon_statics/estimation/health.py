"""How an estimator is: what it counted, and what there is to say of it."""

from __future__ import annotations

import time
from collections import Counter
from enum import IntEnum

from ..tensions.reason import Reason
from .estimate import AnyEstimate, Remark


class Level(IntEnum):
    """Levels of a status, the worse the higher; a known fault is worse than silence."""

    OK = 0
    WARN = 1
    STALE = 2
    ERROR = 3


class Health:
    """Counts what happens, since the start and since the last periodic report.

    Every message received is used in a set of tensions that was solved, dropped for a reason, or,
    of those with a part of the cables, still waiting for its partner. What is about no cable is
    none of them. Times are those of a steady clock, in s.

    Parameters
    ----------
    counts_lost : bool
        Whether it is seen how many are lost on the way; else no number is given.
    solved_are, foreign_are : str
        What reports call those that were solved, and those about no cable.
    """

    def __init__(
        self,
        *,
        counts_lost: bool = True,
        solved_are: str = 'pairs solved',
        foreign_are: str = 'messages about neither cable',
    ) -> None:
        self._words = solved_are, foreign_are
        self.counts_lost = counts_lost
        self.received = 0
        self.solved = 0
        self.lost = 0
        self.foreign = 0
        self.dropped: Counter[Reason] = Counter()
        self.last_drop = ''
        self.stale = False
        self._since = time.monotonic()
        self._newest: float | None = None
        self.newest: AnyEstimate | None = None
        self._rate: float | None = None
        self._logged: set[Remark] = set()
        self._to_log: list[Remark] = []
        self._forget_period()

    def _forget_period(self) -> None:
        self._solved_before = self.solved
        self._lost_before = self.lost
        self._dropped_before = self.dropped.copy()
        self._remarks: Counter[Remark] = Counter()
        self._at_a_look: list[Remark] = []
        self._solve_time = self._longest_solve = 0.0
        self._longest_lag = 0.0
        self._offset = 0.0
        self._is_warned = False
        self._is_implausible = False

    @property
    def level(self) -> Level:
        """The worst since the last periodic report, or now if the input is stale."""
        if self._is_implausible:
            return Level.ERROR
        if self.stale:
            return Level.STALE
        return Level.WARN if self._is_warned else Level.OK

    def note_estimate(self, estimate: AnyEstimate, solve_time: float) -> None:
        """Count a set of tensions that was solved, in so many seconds."""
        self.solved += 1
        self.stale = False
        self._newest = time.monotonic()
        self.newest = estimate
        self._solve_time += solve_time
        self._longest_solve = max(self._longest_solve, solve_time)
        for remark in estimate.remarks:
            self._remarks[remark] += 1
            self._note(remark)

    def _note(self, remark: Remark) -> None:
        self._is_warned = True
        if remark.is_logged and remark not in self._logged:
            self._logged.add(remark)
            self._to_log.append(remark)

    def look_closer(self) -> None:
        """Look at the newest estimate for what takes too long to be looked at in each."""
        if self.newest is not None and not self.stale:
            self._at_a_look = self.newest.slow_remarks
            for remark in self._at_a_look:
                self._note(remark)

    def count(self, remark: Remark) -> int:
        """How many estimates of the period had a remark."""
        return self._remarks[remark]

    def take_what_is_to_log(self) -> list[Remark]:
        """Return what is to be logged since the last call; each remark comes once."""
        remarks, self._to_log = self._to_log, []
        return remarks

    def note_lag(self, lag: float, most: float) -> None:
        """Note that the newest tensions waited `lag` seconds to be taken, `most` is still good."""
        self._newest = time.monotonic() - lag
        if lag > most:
            self._longest_lag = max(self._longest_lag, lag)
            self._is_warned = True

    def note_offset(self, offset: float, most: float) -> None:
        """Note by how many seconds a stamp is after the node's clock; up to `most` is good."""
        if not abs(offset) <= most:
            self._offset = max(self._offset, offset, key=abs)
            self._is_warned = True

    def note_drop(self, reason: Reason, text: str) -> None:
        """Count a message that was dropped."""
        self.dropped[reason] += 1
        self.last_drop = text
        self._is_warned = True
        self._is_implausible |= reason is Reason.IMPLAUSIBLE

    def note_lost(self, count: int) -> None:
        """Count messages that were sent and never came."""
        self.lost += count
        self._is_warned = True

    def begin_period(self) -> None:
        """Forget what is reported only once."""
        now = time.monotonic()
        period = now - self._since
        self._rate = (self.solved - self._solved_before) / period if period > 0.0 else None
        self._since = now
        self._forget_period()

    @property
    def age(self) -> float | None:
        """Age of the newest tensions in s; None if there are none yet."""
        return None if self._newest is None else time.monotonic() - self._newest

    @property
    def summary(self) -> str:
        """What the newest tensions mean, in a word or few; empty if there are none yet."""
        return '' if self.newest is None else self.newest.summary

    def values(self) -> dict[str, str]:
        """What was counted and measured, by what it is."""
        age, solved = self.age, self.solved - self._solved_before
        solved_are, foreign_are = self._words
        return {
            'regime of newest tensions': self.summary,
            'age of newest tensions [s]': '' if age is None else f'{age:.3f}',
            'rate [Hz]': '' if self._rate is None else f'{self._rate:.1f}',
            'mean solve time [ms]': f'{self._solve_time / solved * 1e3:.3f}' if solved else '',
            'longest solve time [ms]': f'{self._longest_solve * 1e3:.3f}' if solved else '',
            'messages received': str(self.received),
            foreign_are: str(self.foreign),
            solved_are: str(self.solved),
            'messages lost on the way': str(self.lost) if self.counts_lost else 'not counted',
            **{f'dropped: {reason.value}': str(self.dropped[reason]) for reason in Reason},
            'last drop': self.last_drop,
        }

    def findings(self) -> list[str]:
        """What is not as it should be, the worst first."""
        age, solved = self.age, self.solved - self._solved_before
        findings = []
        dropped = self.dropped - self._dropped_before
        if self._is_implausible:
            findings.append('implausible tension')
        if self.stale:
            findings.append(
                'no valid tensions came yet'
                if age is None
                else f'no valid tensions for {age:.1f} s'
            )
        if dropped:
            reasons = ', '.join(f'{reason.value} {count}' for reason, count in dropped.items())
            findings.append(f'dropped {reasons}; the last: {self.last_drop}')
        if self.lost > self._lost_before:
            findings.append(f'{self.lost - self._lost_before} messages lost on the way')
        if self._longest_lag > 0.0:
            findings.append(f'behind: tensions waited {self._longest_lag:.1f} s to be taken')
        if self._offset:
            findings.append(
                f'stamps differ from the clock of the node by {self._offset:+.3g} s: clocks that '
                'are not set alike, or messages that are old'
            )
        findings += [
            f'{remark.value}{self._place_of(remark)} ({self._remarks[remark]} of {solved})'
            for remark in Remark
            if self._remarks[remark]
        ]
        findings += [f'{remark.value}{self._place_of(remark)}' for remark in self._at_a_look]
        return findings

    @property
    def worst_part(self) -> str:
        """The summary of the newest tensions, where it says which joint asks for attention."""
        return self.summary if self.newest is not None and self.newest.has_parts else ''

    def _place_of(self, remark: Remark) -> str:
        """Say of which part the newest estimate has a remark, if it has several parts."""
        place = '' if self.newest is None else self.newest.place_of(remark)
        return f': {place}' if place else ''
