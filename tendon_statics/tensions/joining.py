"""From messages about some cables to sets of all at one time, as node and replay make them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

from .named_values import NamedValues
from .pairing import Pairing, Part
from .reason import Fault, Reason
from .stamp_order import StampOrder, seconds


class Whole(NamedTuple):
    """What was measured of all cables at one time."""

    time: int
    """ns, the latest of its messages"""
    values: Sequence[float]
    """In the order of the cables"""
    sources: Sequence[Any]
    """What came along with its messages, that of the latest at the end"""


DropMessage = Callable[[Fault, Part], None]
"""Takes why a message gives nothing, and what it said, without values if they are not known"""


class Joining:
    """Checks the order of stamps, and joins messages of some cables each.

    Messages go by their stamps, or by arrival where they have none. The stamps of each cable have
    to rise: of several publishers with equal stamps the first counts.

    Parameters
    ----------
    deliver, drop : callable
        Take what comes of the messages.
    cable_names : tuple of str
        What the cables are called in texts.
    max_skew : callable
        Returns the most that two times of a whole may differ, in s.
    """

    def __init__(
        self,
        deliver: Callable[[Whole], None],
        drop: DropMessage,
        cable_names: tuple[str, ...],
        max_skew: Callable[[], float],
    ) -> None:
        self._deliver = deliver
        self._drop = drop
        self._cable_names = cable_names
        self._max_skew = max_skew
        self._orders = tuple(StampOrder() for _ in cable_names)
        self._pairing = Pairing(len(cable_names), max_skew, self._deliver_parts, self._drop_part)

    def loosen(self) -> None:
        """Take it that the driver may have begun anew, with an earlier clock, until `tighten`."""
        for order in self._orders:
            order.is_loose = True

    def tighten(self) -> None:
        """Take it that the stamps are sound again, since tensions came of them."""
        for order in self._orders:
            order.is_loose = False

    def forget(self) -> None:
        """Forget what came before; what still waits is dropped."""
        for order in self._orders:
            order.forget()
        self._pairing.forget()

    def take(self, values: NamedValues, stamp: int, arrival: int, source: Any = None) -> None:
        """Take what a message says of the cables.

        Parameters
        ----------
        stamp : int
            ns; 0 is none, unless the driver has stamped before.
        arrival : int
            ns, of the clock that messages without a stamp go by.
        source : object
            Whatever should come along with the values.
        """
        if values.is_foreign:
            return
        if values.fault is not None:
            self._drop(values.fault, Part(stamp or arrival, {}, source))
            return
        known = {cable: of for cable, of in enumerate(values.values) if of is not None}
        if len(known) == len(self._cable_names):
            self.take_whole(tuple(known.values()), stamp, arrival, source)
            return
        stamped, fault = self._checked(stamp, known)
        part = Part(stamp if stamped else arrival, known, source)
        if fault is None:
            self._pairing.take(part)
        else:
            reason, text = fault
            self._drop((reason, f'{self._named(known)}: {text}'), part)

    def take_whole(
        self, values: Sequence[float], stamp: int, arrival: int, source: Any = None
    ) -> None:
        """Take a message with the values of all cables, in their order."""
        stamped, fault = self._checked(stamp, range(len(values)))
        time = stamp if stamped else arrival
        if fault is not None:
            self._drop(fault, Part(time, dict(enumerate(values)), source))
            return
        self._pairing.forget()  # A whole as it is needs no partner of another time.
        self._deliver(Whole(time, values, (source,)))

    def _checked(self, stamp: int, cables: Iterable[int]) -> tuple[bool, Fault | None]:
        """Return whether a stamp is one, and what is against it in the order of its cables."""
        orders = [self._orders[cable] for cable in cables]
        if not stamp and not any(order.has_begun for order in orders):
            return False, None
        objections = [order.objection(stamp) for order in orders]
        return True, next(filter(None, objections), None)

    def _deliver_parts(self, parts: list[Part]) -> None:
        by_time = sorted(parts, key=lambda part: part.time)
        values = {cable: value for part in parts for cable, value in part.values.items()}
        in_order = tuple(values[cable] for cable in range(len(values)))
        self._deliver(Whole(by_time[-1].time, in_order, [part.source for part in by_time]))

    def _drop_part(self, part: Part) -> None:
        text = (
            f'{self._named(part.values)} of {seconds(part.time)} s has no partner of its own '
            f'within max_skew, {self._max_skew():g} s'
        )
        self._drop((Reason.UNPAIRED, text), part)

    def _named(self, cables: Iterable[int]) -> str:
        return ', '.join(self._cable_names[cable] for cable in cables)
