"""Where tensions come from: the kinds of messages that drivers publish, as pairs of values."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from ...files.cable_parameters import CABLES
from ...tensions.named_values import cable_values
from ...tensions.pairing import Pairing, Single
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
    """What was measured of the two cables at one time."""

    value_l: float
    """In the driver's unit, as `value_s`"""
    value_s: float
    stamp: Time | None = None
    """None if the message has none, or 0, which means the same"""


Deliver = Callable[[Reading], None]
Drop = Callable[[Reason, str], None]
TakesPair = Callable[[Any, int], None]
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

    inputs: dict[str, tuple[type, TakesPair]]
    kind: str
    """As the parameter ``tension_source`` has it"""
    has_one_publisher = True
    """Whether each topic is to have one publisher alone"""

    def __init__(self, deliver: Deliver, drop: Drop, *stamped: str) -> None:
        self._deliver = deliver
        self._drop = drop
        self._orders = {what: StampOrder() for what in stamped}

    def is_foreign(self, _message: Any) -> bool:
        """Whether a message is about neither cable, so that it is none of ours."""
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
    """``std_msgs/Float64MultiArray`` ``[T_l, T_s]``; its layout is not looked at."""

    kind = 'array'

    def __init__(self, deliver: Deliver, drop: Drop) -> None:
        super().__init__(deliver, drop)
        self.inputs = {'tensions': (Float64MultiArray, self._take)}

    def _take(self, message: Float64MultiArray, _arrival: int) -> None:
        values = message.data
        if len(values) == 2:
            self._deliver(Reading(values[0], values[1]))
        else:
            self._drop(
                Reason.WRONG_LENGTH,
                f'{len(values)} values came, [tension_l, tension_s] is needed',
            )


class PairedSource(TensionSource):
    """What joins messages of one cable each, by their stamps, or by arrival where they have none.

    The reading has the later of the two stamps. One message has one partner, the nearest that is
    free when the later of the two comes.

    Parameters
    ----------
    cable_names : tuple of str
        What cables l and s are called.
    max_skew : callable
        Returns the most that two times of a pair may differ, in s.
    """

    def __init__(
        self,
        deliver: Deliver,
        drop: Drop,
        cable_names: tuple[str, str],
        max_skew: Callable[[], float],
    ) -> None:
        super().__init__(deliver, drop, *CABLES)
        self._cable_names = cable_names
        self._max_skew = max_skew
        self._pairing = Pairing(max_skew, self._deliver_pair, self._drop_single)

    def forget(self) -> None:
        """As in `TensionSource`; what still waits is dropped."""
        super().forget()
        self._pairing.forget()

    def _take_one(self, cable: int, value: float, stamp: Time, arrival: int) -> None:
        """Take a value of cable 0 (l) or 1 (s)."""
        stamp_or_none, fault = self._checked(stamp, cable)
        if fault:
            self._drop(fault[0], f'{self._cable_names[cable]}: {fault[1]}')
            return
        time = arrival if stamp_or_none is None else nanoseconds(stamp)
        self._pairing.take(cable, Single(time, value, stamp_or_none))

    def _checked(self, stamp: Time, *cables: int) -> tuple[Time | None, Fault | None]:
        """Return a stamp, None if it is none, and what is against it in the order of its cables.

        A stamp of 0 is none, unless the driver has stamped before.
        """
        orders = [self._orders[CABLES[cable]] for cable in cables]
        if not (stamp.sec or stamp.nanosec or any(order.has_begun for order in orders)):
            return None, None
        objections = [order.objection(stamp) for order in orders]
        return stamp, next(filter(None, objections), None)

    def _deliver_pair(self, of_l: Single, of_s: Single) -> None:
        later = of_l if of_l.time >= of_s.time else of_s
        self._deliver(Reading(of_l.value, of_s.value, later.source))

    def _drop_single(self, cable: int, single: Single) -> None:
        self._drop(
            Reason.UNPAIRED,
            f'{self._cable_names[cable]} of {seconds(single.time)} s has no partner of its own '
            f'within max_skew, {self._max_skew():g} s',
        )


class JointStateSource(PairedSource):
    """``sensor_msgs/JointState`` with tensions in ``effort``, found by name.

    A message has both cables or one, which is then joined with the other's. Other publishers may
    say other things on the topic: messages about neither cable are none of ours.
    """

    kind = 'joint_state'
    has_one_publisher = False

    def __init__(
        self,
        deliver: Deliver,
        drop: Drop,
        cable_names: tuple[str, str],
        max_skew: Callable[[], float],
    ) -> None:
        super().__init__(deliver, drop, cable_names, max_skew)
        self.inputs = {'tensions': (JointState, self._take)}

    def is_foreign(self, message: JointState) -> bool:
        """Whether no cable is among the names."""
        names = message.name
        return not (self._cable_names[0] in names or self._cable_names[1] in names)

    def _take(self, message: JointState, arrival: int) -> None:
        found = cable_values(message.name, message.effort, self._cable_names)
        if found.is_foreign:
            return
        if found.fault is not None:
            self._drop(*found.fault)
            return
        stamp = message.header.stamp
        if found.value_l is None:
            self._take_one(1, found.value_s or 0.0, stamp, arrival)
        elif found.value_s is None:
            self._take_one(0, found.value_l, stamp, arrival)
        else:
            stamp_or_none, late = self._checked(stamp, 0, 1)
            if late:
                self._drop(*late)
                return
            self._pairing.forget()  # A pair as it is needs no partner of another time.
            self._deliver(Reading(found.value_l, found.value_s, stamp_or_none))


class WrenchPairSource(PairedSource):
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
        self._take_one(cable, value, message.header.stamp, arrival)


def tension_source(
    deliver: Deliver, drop: Drop, wiring: Wiring, max_skew: Callable[[], float]
) -> TensionSource:
    """Make the source that the parameters ask for."""
    if wiring.tension_source == 'joint_state':
        return JointStateSource(deliver, drop, wiring.cable_names, max_skew)
    if wiring.tension_source == 'wrench_pair':
        return WrenchPairSource(deliver, drop, wiring.wrench_component, max_skew)
    return ArraySource(deliver, drop)
