"""Where tensions come from: the kinds of messages that drivers publish, as sets of values."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from ...tensions.named_values import cable_values
from ...tensions.pairing import Pairing, Part
from ...tensions.reason import Fault, Reason
from ..parameters.estimator import Wiring
from .stamp_order import StampOrder, nanoseconds, seconds

COMPONENTS: dict[str, Callable[[Vector3], float]] = {
    'z': lambda force: force.z,
    'x': lambda force: force.x,
    'y': lambda force: force.y,
    'norm': lambda force: math.hypot(force.x, force.y, force.z),
}
"""Of the force of a load cell"""


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


class ArraySource(TensionSource):
    """``std_msgs/Float64MultiArray`` of one value a cable; its layout is not looked at.

    Parameters
    ----------
    needed : tuple of str
        What the values are called, in their order.
    """

    kind = 'array'

    def __init__(
        self, deliver: Deliver, drop: Drop, needed: tuple[str, ...] = ('tension_l', 'tension_s')
    ) -> None:
        super().__init__(deliver, drop)
        self._needed = needed
        self.inputs = {'tensions': (Float64MultiArray, self._take)}

    def _take(self, message: Float64MultiArray, _arrival: int) -> None:
        values = message.data
        if len(values) == len(self._needed):
            self._deliver(Reading(tuple(values)))
        else:
            self._drop(
                Reason.WRONG_LENGTH,
                f'{len(values)} values came, [{", ".join(self._needed)}] is needed',
            )


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


class JointStateSource(JoiningSource):
    """``sensor_msgs/JointState`` with tensions in ``effort``, found by name.

    A message has all cables or some, which are then joined with those of others. Other publishers
    may say other things on the topic: messages about no cable are none of ours.
    """

    kind = 'joint_state'
    has_one_publisher = False

    def __init__(
        self,
        deliver: Deliver,
        drop: Drop,
        cable_names: tuple[str, ...],
        max_skew: Callable[[], float],
    ) -> None:
        super().__init__(deliver, drop, cable_names, max_skew)
        self._is_ours = frozenset(cable_names).intersection
        self._all = range(len(cable_names))
        self._names_of_whole: list[str] | None = None
        self._places: tuple[int, ...] = ()
        """Where the cables stand among those names, which a driver mostly repeats"""
        self.inputs = {'tensions': (JointState, self._take)}

    def is_foreign(self, message: JointState) -> bool:
        """Whether no cable is among the names."""
        names = message.name
        return names != self._names_of_whole and not self._is_ours(names)

    def _take(self, message: JointState, arrival: int) -> None:
        names, values = message.name, message.effort
        if names == self._names_of_whole and len(values) == len(names):
            self._take_whole(tuple([values[place] for place in self._places]), message)
            return
        found = cable_values(names, values, self._cable_names)
        if found.is_foreign:
            return
        if found.fault is not None:
            self._drop(*found.fault)
            return
        known = {cable: value for cable, value in enumerate(found.values) if value is not None}
        if len(known) < len(self._cable_names):
            self._take_part(known, message.header.stamp, arrival)
            return
        self._names_of_whole = list(names)
        self._places = tuple(names.index(cable) for cable in self._cable_names)
        self._take_whole(tuple(known.values()), message)

    def _take_whole(self, values: tuple[float, ...], message: JointState) -> None:
        stamp_or_none, late = self._checked(message.header.stamp, self._all)
        if late:
            self._drop(*late)
            return
        self._pairing.forget()  # A whole as it is needs no partner of another time.
        self._deliver(Reading(values, stamp_or_none))


class WrenchPairSource(JoiningSource):
    """Two ``geometry_msgs/WrenchStamped``, one of each load cell.

    Parameters
    ----------
    component : str
        One of `COMPONENTS`.
    """

    kind = 'wrench_pair'

    def __init__(
        self, deliver: Deliver, drop: Drop, component: str, max_skew: Callable[[], float]
    ) -> None:
        topics = ('tension_l', 'tension_s')
        super().__init__(deliver, drop, topics, max_skew)
        self._component = COMPONENTS[component]
        self.inputs = {
            topic: (WrenchStamped, partial(self._take, cable))
            for cable, topic in enumerate(topics)
        }

    def _take(self, cable: int, message: WrenchStamped, arrival: int) -> None:
        value = self._component(message.wrench.force)
        self._take_part({cable: value}, message.header.stamp, arrival)


def arm_tension_source(
    deliver: Deliver,
    drop: Drop,
    kind: str,
    cable_names: tuple[str, ...],
    max_skew: Callable[[], float],
) -> TensionSource:
    """Make the source that an arm's parameter ``tension_source`` asks for."""
    if kind == 'array':
        return ArraySource(deliver, drop, cable_names)
    return JointStateSource(deliver, drop, cable_names, max_skew)


def tension_source(
    deliver: Deliver, drop: Drop, wiring: Wiring, max_skew: Callable[[], float]
) -> TensionSource:
    """Make the source that the parameters ask for."""
    if wiring.tension_source == 'joint_state':
        return JointStateSource(deliver, drop, wiring.cable_names, max_skew)
    if wiring.tension_source == 'wrench_pair':
        return WrenchPairSource(deliver, drop, wiring.wrench_component, max_skew)
    return ArraySource(deliver, drop)
