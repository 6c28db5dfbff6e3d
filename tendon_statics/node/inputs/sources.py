"""Where tensions come from: the kinds of messages that drivers publish, as sets of values."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from ...tensions.joining import Joining, Whole
from ...tensions.named_values import NamedValues, cable_values
from ...tensions.reason import Reason
from ...tensions.stamp_order import NANOSECONDS
from ..parameters.estimator import Wiring

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
    """

    inputs: dict[str, tuple[type, Takes]]
    kind: str
    """As the parameter ``tension_source`` has it"""
    has_one_publisher = True
    """Whether each topic is to have one publisher alone"""

    def __init__(self, deliver: Deliver, drop: Drop) -> None:
        self._deliver = deliver
        self._drop = drop

    def is_foreign(self, _message: Any) -> bool:
        """Whether a message is about no cable, so that it is none of ours."""
        return False

    def loosen(self) -> None:
        """Take it that the driver may have begun anew, with an earlier clock, until `tighten`."""

    def tighten(self) -> None:
        """Take it that the stamps are sound again, since tensions came of them."""

    def forget(self) -> None:
        """Forget what came before, for the clock was set back or the node was inactive."""


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
            stamp = message.header.stamp
            in_order = tuple([values[place] for place in self._places])
            self._joining.take_whole(in_order, nanoseconds(stamp), arrival, stamp)
            return
        found = cable_values(names, values, self._cable_names)
        if found.fault is None and found.values and None not in found.values:
            self._names_of_whole = list(names)
            self._places = tuple(names.index(cable) for cable in self._cable_names)
        self._take_values(found, message.header.stamp, arrival)


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
        values = NamedValues((value, None) if cable == 0 else (None, value))
        self._take_values(values, message.header.stamp, arrival)


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


def nanoseconds(stamp: Time) -> int:
    """Return a stamp as nanoseconds since its clock's start."""
    return stamp.sec * NANOSECONDS + stamp.nanosec
