"""Whether the stamps of a driver rise, as they have to."""

from __future__ import annotations

from .reason import Fault, Reason

NANOSECONDS = 1_000_000_000
"""In a second"""

RISING = 3
"""Stamps in a row"""


class StampOrder:
    """Objects to a stamp that is not later than the newest before it.

    A driver that begins anew with an earlier clock would be shut out for ever, and so would one
    after a single stamp far in the future. So while it is loose, the last of `RISING` stamps in a
    row that rise is taken, however early they are.
    """

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Take any stamp next."""
        self._newest: int | None = None
        self._before = 0
        self._rising = 0
        self.is_loose = False

    @property
    def has_begun(self) -> bool:
        """Whether it has taken a stamp."""
        return self._newest is not None

    def objection(self, time: int) -> Fault | None:
        """Return what is against a stamp in ns, None if it is in order."""
        newest = self._newest
        self._rising = self._rising + 1 if time > self._before else 1
        self._before = time
        if newest is None or time > newest or (self.is_loose and self._rising >= RISING):
            self._newest = time
            return None
        text = f'the stamp is {seconds(time)} s, after {seconds(newest)} s'
        return (Reason.REPEATED_STAMP if time == newest else Reason.OUT_OF_ORDER), text


def seconds(time: int) -> str:
    """Return nanoseconds as a person reads them, in s."""
    whole, rest = divmod(abs(time), NANOSECONDS)
    return f'{"-" * (time < 0)}{whole}.{rest:09d}'
