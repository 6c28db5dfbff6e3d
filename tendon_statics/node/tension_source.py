"""Where tensions come from: the kinds of messages that drivers publish, as pairs of values."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from ..tensions.named_values import cable_values
from ..tensions.pairing import NANOSECONDS, Pairing, Single
from ..tensions.reason import Reason

RISING = 3
"""Stamps in a row"""

COMPONENTS: dict[str, Callable[[Vector3], float]] = {
    'z': lambda force: force.z,
    'x': lambda force: force.x,
    'y': lambda force: force.y,
    'norm': lambda force: math.hypot(force.x, force.y, force.z),
}
"""Of the force of a load cell"""


class Reading(NamedTuple):
    """What was measured of the two cables at one time."""

    value_l: float
    """In the driver's unit, as `value_s`"""
    value_s: float
    stamp: Time | None = None
    """None if the message has none"""


Deliver = Callable[[Reading], None]
Drop = Callable[[Reason, str], None]


class TensionSource:
    """Turns messages of one kind into readings.

    Attributes
    ----------
    inputs : dict
        Topic → type of its messages and what takes one.

    Parameters
    ----------
    deliver, drop : callable
        Take what comes of the messages: a reading, or the reason for none with a text.
    stamped : str
        Topics whose messages have a stamp.
    """

    inputs: dict[str, tuple[type, Callable[[Any], None]]]

    def __init__(self, deliver: Deliver, drop: Drop, *stamped: str) -> None:
        self._deliver = deliver
        self._drop = drop
        self._orders = {topic: StampOrder() for topic in stamped}

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


class ArraySource(TensionSource):
    """``std_msgs/Float64MultiArray`` ``[T_l, T_s]``; its layout is not looked at."""

    def __init__(self, deliver: Deliver, drop: Drop) -> None:
        super().__init__(deliver, drop)
        self.inputs = {'tensions': (Float64MultiArray, self._take)}

    def _take(self, message: Float64MultiArray) -> None:
        values = message.data
        if len(values) == 2:
            self._deliver(Reading(values[0], values[1]))
        else:
            self._drop(
                Reason.WRONG_LENGTH,
                f'{len(values)} values came, [tension_l, tension_s] is needed',
            )


class JointStateSource(TensionSource):
    """One ``sensor_msgs/JointState`` with both tensions in ``effort``, found by name.

    Parameters
    ----------
    cable_names : tuple of str
        Names of cables l and s.
    """

    def __init__(self, deliver: Deliver, drop: Drop, cable_names: tuple[str, str]) -> None:
        super().__init__(deliver, drop, 'tensions')
        self._cable_names = cable_names
        self.inputs = {'tensions': (JointState, self._take)}

    def _take(self, message: JointState) -> None:
        late = self._orders['tensions'].objection(message.header.stamp)
        if late:
            self._drop(*late)
            return
        found = cable_values(message.name, message.effort, self._cable_names)
        if found.fault is not None:
            self._drop(*found.fault)
            return
        if found.value_l is None or found.value_s is None:
            missing = self._cable_names[0 if found.value_l is None else 1]
            there = ', '.join(message.name) or 'none'
            self._drop(Reason.MISSING_CABLE, f'no {missing} among the names: {there}')
            return
        self._deliver(Reading(found.value_l, found.value_s, message.header.stamp))


class WrenchPairSource(TensionSource):
    """Two ``geometry_msgs/WrenchStamped``, one of each load cell, paired by stamp.

    The reading has the later of the two stamps. One message has one partner, the nearest that is
    free when the later of the two comes.

    Parameters
    ----------
    component : str
        One of `COMPONENTS`.
    max_skew : callable
        Returns the most that two stamps of a pair may differ, in s.
    """

    def __init__(
        self, deliver: Deliver, drop: Drop, component: str, max_skew: Callable[[], float]
    ) -> None:
        super().__init__(deliver, drop, 'tension_l', 'tension_s')
        self._component = COMPONENTS[component]
        self._max_skew = max_skew
        self._pairing = Pairing(max_skew, self._deliver_pair, self._drop_single)
        self.inputs = {
            'tension_l': (WrenchStamped, lambda message: self._take('tension_l', message)),
            'tension_s': (WrenchStamped, lambda message: self._take('tension_s', message)),
        }

    def forget(self) -> None:
        """As in `TensionSource`; what still waits is dropped."""
        super().forget()
        self._pairing.forget()

    def _take(self, topic: str, message: WrenchStamped) -> None:
        stamp = message.header.stamp
        late = self._orders[topic].objection(stamp)
        if late:
            self._drop(late[0], f'{topic}: {late[1]}')
            return
        value = self._component(message.wrench.force)
        cable = 0 if topic == 'tension_l' else 1
        self._pairing.take(cable, Single(nanoseconds(stamp), value, stamp))

    def _deliver_pair(self, of_l: Single, of_s: Single) -> None:
        later = of_l if of_l.time >= of_s.time else of_s
        self._deliver(Reading(of_l.value, of_s.value, later.source))

    def _drop_single(self, cable: int, single: Single) -> None:
        self._drop(
            Reason.UNPAIRED,
            f'{"tension_s" if cable else "tension_l"} of {_seconds(single.time)} s has no partner '
            f'of its own within max_skew, {self._max_skew():g} s',
        )


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

    def objection(self, stamp: Time) -> tuple[Reason, str] | None:
        """Return what is against this stamp, None if it is in order."""
        time, newest = nanoseconds(stamp), self._newest
        self._rising = self._rising + 1 if time > self._before else 1
        self._before = time
        if newest is None or time > newest or (self.is_loose and self._rising >= RISING):
            self._newest = time
            return None
        if time == 0:
            text = 'the stamp is 0: the driver does not stamp its messages'
        else:
            text = f'the stamp is {_seconds(time)} s, after {_seconds(newest)} s'
        return (Reason.REPEATED_STAMP if time == newest else Reason.OUT_OF_ORDER), text


def nanoseconds(stamp: Time) -> int:
    """Return a stamp as nanoseconds since its clock's start."""
    return stamp.sec * NANOSECONDS + stamp.nanosec


def _seconds(time: int) -> str:
    return f'{time // NANOSECONDS}.{time % NANOSECONDS:09d}'
