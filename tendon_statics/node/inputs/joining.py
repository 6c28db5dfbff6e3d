"""Readings from messages that have a part of the cables each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from builtin_interfaces.msg import Time

from ...tensions.pairing import Pairing, Part
from ...tensions.reason import Fault, Reason
from .stamp_order import nanoseconds, seconds
from .tension_source import Deliver, Drop, Reading, TensionSource


class JoiningSource(TensionSource):
    """What joins messages of some cables each, by their stamps, or by arrival without them.

    The reading has the latest of the stamps. One message has one partner of each other kind, the
    nearest that is free when the last of them comes.

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
        super().__init__(deliver, drop, *cable_names)
        self._cable_names = cable_names
        self._of_cable = tuple(self._orders.values())
        self._max_skew = max_skew
        self._pairing = Pairing(len(cable_names), max_skew, self._deliver_whole, self._drop_part)

    def forget(self) -> None:
        """As in `TensionSource`; what still waits is dropped."""
        super().forget()
        self._pairing.forget()

    def _take_part(self, values: Mapping[int, float], stamp: Time, arrival: int) -> None:
        """Take the values of some cables, by their place among the names."""
        stamp_or_none, fault = self._checked(stamp, values)
        if fault:
            self._drop(fault[0], f'{self._named(values)}: {fault[1]}')
            return
        time = arrival if stamp_or_none is None else nanoseconds(stamp)
        self._pairing.take(Part(time, values, stamp_or_none))

    def _checked(self, stamp: Time, cables: Iterable[int]) -> tuple[Time | None, Fault | None]:
        """Return a stamp, None if it is none, and what is against it in the order of its cables.

        A stamp of 0 is none, unless the driver has stamped before.
        """
        orders = [self._of_cable[cable] for cable in cables]
        if not (stamp.sec or stamp.nanosec or any(order.has_begun for order in orders)):
            return None, None
        time = nanoseconds(stamp)
        objections = [order.objection(time) for order in orders]
        return stamp, next(filter(None, objections), None)

    def _deliver_whole(self, parts: list[Part]) -> None:
        latest = max(parts, key=lambda part: part.time)
        values = {cable: value for part in parts for cable, value in part.values.items()}
        in_order = tuple(values[cable] for cable in range(len(values)))
        self._deliver(Reading(in_order, latest.source))

    def _drop_part(self, part: Part) -> None:
        self._drop(
            Reason.UNPAIRED,
            f'{self._named(part.values)} of {seconds(part.time)} s has no partner of its own '
            f'within max_skew, {self._max_skew():g} s',
        )

    def _named(self, cables: Iterable[int]) -> str:
        return ', '.join(self._cable_names[cable] for cable in cables)
