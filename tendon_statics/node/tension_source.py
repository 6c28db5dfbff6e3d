"""Where tensions come from: the kinds of messages that drivers publish, as pairs of values."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from enum import Enum
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

NANOSECONDS = 1_000_000_000

MOST_WAITING = 1000
"""Messages of one load cell that wait for those of the other"""

ROUNDING = 1e-15
"""Relative error of a sum of two numbers that nearly cancel"""

RISING = 3
"""Stamps in a row"""

COMPONENTS: dict[str, Callable[[Vector3], float]] = {
    'z': lambda force: force.z,
    'x': lambda force: force.x,
    'y': lambda force: force.y,
    'norm': lambda force: math.hypot(force.x, force.y, force.z),
}
"""Of the force of a load cell"""


class Reason(str, Enum):
    """Why a message was dropped."""

    WRONG_LENGTH = 'wrong length'
    MISSING_CABLE = 'missing cable'
    NOT_FINITE = 'not finite'
    NEGATIVE = 'negative'
    IMPLAUSIBLE = 'implausible'
    BELOW_WEIGHT = 'below the weight'
    OUT_OF_ORDER = 'out of order'
    REPEATED_STAMP = 'repeated stamp'
    UNPAIRED = 'unpaired'

    @property
    def is_of_content(self) -> bool:
        """Whether the message holds no pair of tensions, and not only comes at the wrong time."""
        return self not in (Reason.OUT_OF_ORDER, Reason.REPEATED_STAMP, Reason.UNPAIRED)


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
        names, efforts = message.name, message.effort
        values: list[float] = []
        for cable in self._cable_names:
            if cable not in names:
                there = ', '.join(names) or 'none'
                self._drop(Reason.MISSING_CABLE, f'no {cable} among the names: {there}')
                return
            place = names.index(cable)
            if place >= len(efforts):
                self._drop(
                    Reason.WRONG_LENGTH,
                    f'{len(names)} names came with {len(efforts)} efforts, {cable} has none',
                )
                return
            values.append(efforts[place])
        self._deliver(Reading(values[0], values[1], message.header.stamp))


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
        self._paired = dict.fromkeys(self._orders, -math.inf)
        self._waiting: dict[str, deque[tuple[int, float, Time]]] = {
            topic: deque() for topic in self._orders
        }
        self.inputs = {
            'tension_l': (WrenchStamped, lambda message: self._take('tension_l', message)),
            'tension_s': (WrenchStamped, lambda message: self._take('tension_s', message)),
        }

    def forget(self) -> None:
        """As in `TensionSource`; what still waits is dropped."""
        super().forget()
        self._paired = dict.fromkeys(self._orders, -math.inf)
        for topic, waiting in self._waiting.items():
            while waiting:
                self._drop_first(topic)

    def _take(self, topic: str, message: WrenchStamped) -> None:
        order, waiting = self._orders[topic], self._waiting[topic]
        late = order.objection(message.header.stamp)
        if late:
            self._drop(late[0], f'{topic}: {late[1]}')
            return
        stamp = nanoseconds(message.header.stamp)
        while waiting and waiting[-1][0] >= stamp:  # The order has begun anew.
            self._drop_first(topic)
        waiting.append((stamp, self._component(message.wrench.force), message.header.stamp))
        if len(waiting) > MOST_WAITING:
            self._drop_first(topic)
        self._pair()

    def _pair(self) -> None:
        """Deliver every pair, and drop what has no partner any more."""
        at_l, at_s = self._waiting.values()
        skew = self._max_skew() * NANOSECONDS
        while at_l and at_s:
            difference = at_l[0][0] - at_s[0][0]
            if abs(difference) > skew:
                self._drop_first('tension_l' if difference < 0 else 'tension_s')
                continue
            # Where max_skew exceeds the period, one lost message must not shift all pairs after
            # it: what is much nearer to a message that already has a partner is left out. Not
            # what is a little nearer: cells that run freely may be half a period apart.
            if abs(at_l[0][0] - self._paired['tension_s']) < 0.5 * abs(difference):
                self._drop_first('tension_l')
                continue
            if abs(at_s[0][0] - self._paired['tension_l']) < 0.5 * abs(difference):
                self._drop_first('tension_s')
                continue
            (stamp_l, value_l, time_l), (stamp_s, value_s, time_s) = at_l.popleft(), at_s.popleft()
            self._paired = {'tension_l': stamp_l, 'tension_s': stamp_s}
            self._deliver(Reading(value_l, value_s, time_l if stamp_l >= stamp_s else time_s))

    def _drop_first(self, topic: str) -> None:
        stamp, _, _ = self._waiting[topic].popleft()
        self._drop(
            Reason.UNPAIRED,
            f'{topic} of {_seconds(stamp)} s has no partner of its own within max_skew, '
            f'{self._max_skew():g} s',
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


class Calibration(NamedTuple):
    """How a cable's tension in N follows from what is measured: gain * value + bias."""

    gain: float
    bias: float
    max_tension: float


def calibrated(
    name: str, value: float, calibration: Calibration
) -> tuple[float, tuple[Reason, str] | None]:
    """Return a measured value as a tension in N, and what is against it."""
    tension = calibration.gain * value + calibration.bias
    if abs(tension) < ROUNDING * abs(calibration.bias):  # of a slack cable
        tension = 0.0
    if 0.0 <= tension <= calibration.max_tension:
        return tension, None
    allowed = f'allowed is 0 to {calibration.max_tension:g} N'
    if not math.isfinite(tension):
        reason = Reason.NOT_FINITE
    elif abs(tension) > calibration.max_tension:
        reason = Reason.IMPLAUSIBLE
    else:
        reason = Reason.NEGATIVE
    return tension, (reason, f'{name} is {tension!r} N, {allowed}')


def nanoseconds(stamp: Time) -> int:
    """Return a stamp as nanoseconds since its clock's start."""
    return stamp.sec * NANOSECONDS + stamp.nanosec


def _seconds(time: int) -> str:
    return f'{time // NANOSECONDS}.{time % NANOSECONDS:09d}'
