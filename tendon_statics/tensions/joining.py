"""From messages about one cable or both to pairs of one time, as node and replay make them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .named_values import NamedValues
from .pairing import Pairing, Single
from .reason import Fault, Reason
from .stamp_order import StampOrder, seconds

DeliverPair = Callable[[Single, Single], None]
"""Takes a pair, cable l first"""

DropMessage = Callable[[Fault, Single], None]
"""Takes why a message gives no pair, and its time, its value of one cable and its source"""


class Joining:
    """Checks the order of stamps, and joins messages of one cable each.

    Messages go by their stamps, or by arrival where they have none. The stamps of each cable have
    to rise: of several publishers with equal stamps the first counts.

    Parameters
    ----------
    deliver, drop : callable
        Take what comes of the messages.
    cable_names : tuple of str
        What cables l and s are called in texts.
    max_skew : callable
        Returns the most that two times of a pair may differ, in s.
    """

    def __init__(
        self,
        deliver: DeliverPair,
        drop: DropMessage,
        cable_names: tuple[str, str],
        max_skew: Callable[[], float],
    ) -> None:
        self._deliver = deliver
        self._drop = drop
        self._cable_names = cable_names
        self._max_skew = max_skew
        self._orders = StampOrder(), StampOrder()
        self._pairing = Pairing(max_skew, deliver, self._drop_single)

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
        value_l, value_s, fault = values
        if value_l is None and value_s is None and fault is None:
            return
        if fault is None:
            stamped, fault = self._checked(values, stamp)
            time = stamp if stamped else arrival
        else:
            time = stamp or arrival
        if fault is not None:
            self._drop(fault, Single(time, float('nan'), source))
        elif value_l is None or value_s is None:
            cable, value = (1, value_s) if value_l is None else (0, value_l)
            self._pairing.take(cable, Single(time, value or 0.0, source))
        else:
            self._pairing.forget()  # A pair as it is needs no partner of another time.
            self._deliver(Single(time, value_l, source), Single(time, value_s, source))

    def _checked(self, values: NamedValues, stamp: int) -> tuple[bool, Fault | None]:
        """Return whether a stamp is one, and what is against it in the order of its cables."""
        cables = [cable for cable in (0, 1) if values[cable] is not None]
        orders = [self._orders[cable] for cable in cables]
        if not stamp and not any(order.has_begun for order in orders):
            return False, None
        objections = [order.objection(stamp) for order in orders]
        reason, text = next(filter(None, objections), (None, ''))
        if reason is None:
            return True, None
        if len(cables) == 1:
            text = f'{self._cable_names[cables[0]]}: {text}'
        return True, (reason, text)

    def _drop_single(self, cable: int, single: Single) -> None:
        text = (
            f'{self._cable_names[cable]} of {seconds(single.time)} s has no partner of its own '
            f'within max_skew, {self._max_skew():g} s'
        )
        self._drop((Reason.UNPAIRED, text), single)
