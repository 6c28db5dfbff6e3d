"""Readings from messages that have a part of the cables each."""

from __future__ import annotations

from collections.abc import Callable

from builtin_interfaces.msg import Time

from ...tensions.joining import Joining, Whole
from ...tensions.named_values import NamedValues
from .tension_source import Deliver, Drop, Reading, TensionSource, nanoseconds


class JoiningSource(TensionSource):
    """What has stamps, and may come with some cables a message: see `Joining`.

    The reading has the latest of the stamps.

    Parameters
    ----------
    cable_names : tuple of str
        What the cables are called.
    max_skew : callable
        Returns the most that two times of a reading may differ, in s.
    """

    def __init__(
        self,
        deliver: Deliver,
        drop: Drop,
        cable_names: tuple[str, ...],
        max_skew: Callable[[], float],
    ) -> None:
        super().__init__(deliver, drop)
        self._cable_names = cable_names
        self._joining = Joining(
            self._deliver_whole, lambda fault, _: self._drop(*fault), cable_names, max_skew
        )

    def loosen(self) -> None:
        """As in `TensionSource`."""
        self._joining.loosen()

    def tighten(self) -> None:
        """As in `TensionSource`."""
        self._joining.tighten()

    def forget(self) -> None:
        """As in `TensionSource`; what still waits is dropped."""
        self._joining.forget()

    def _take_values(self, values: NamedValues, stamp: Time, arrival: int) -> None:
        self._joining.take(values, nanoseconds(stamp), arrival, stamp)

    def _deliver_whole(self, whole: Whole) -> None:
        stamp: Time = whole.sources[-1]
        self._deliver(Reading(whole.values, stamp if nanoseconds(stamp) else None))
