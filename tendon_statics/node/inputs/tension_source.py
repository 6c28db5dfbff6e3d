"""What turns messages of a driver into readings of all cables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time

from ...tensions.reason import Reason
from .stamp_order import StampOrder


class Reading(NamedTuple):
    """What was measured of all cables at one time."""

    values: Sequence[float]
    """In the driver's unit, in the order of the cables: of a unit l and s"""
    stamp: Time | None = None
    """None if the message has none, or 0, which means the same"""


Deliver = Callable[[Reading], None]
Drop = Callable[[Reason, str], None]
Takes = Callable[[Any, int], None]
"""Takes a message, and when it arrived in ns since 1970"""


class TensionSource:
    """Turns messages of one kind into readings.

    Attributes
    ----------
    inputs : dict
        Topic → type of its messages and what takes one, with its time of arrival.

    Parameters
    ----------
    deliver, drop : callable
        Take what comes of the messages: a reading, or the reason for none with a text.
    stamped : str
        What has stamps of an order of its own.
    """

    inputs: dict[str, tuple[type, Takes]]
    kind: str
    """As the parameter ``tension_source`` has it"""
    has_one_publisher = True
    """Whether each topic is to have one publisher alone"""

    def __init__(self, deliver: Deliver, drop: Drop, *stamped: str) -> None:
        self._deliver = deliver
        self._drop = drop
        self._orders = {what: StampOrder() for what in stamped}

    def is_foreign(self, _message: Any) -> bool:
        """Whether a message is about no cable, so that it is none of ours."""
        return False

    def loosen(self) -> None:
        """Take it that the driver may have begun anew, with an earlier clock, until `tighten`."""
        for order in self._orders.values():
            order.is_loose = True

    def tighten(self) -> None:
        """Take it that the stamps are sound again, since tensions came of them."""
        for order in self._orders.values():
            order.is_loose = False

    def forget(self) -> None:
        """Forget what came before, for the clock was set back or the node was inactive."""
        for order in self._orders.values():
            order.forget()
