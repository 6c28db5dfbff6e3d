"""Where tensions come from: the kinds of messages that drivers publish, as sets of values."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from geometry_msgs.msg import Vector3, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from ...tensions.named_values import cable_values
from ...tensions.reason import Reason
from ..parameters.estimator import Wiring
from .joining import JoiningSource
from .tension_source import Deliver, Drop, Reading, TensionSource

COMPONENTS: dict[str, Callable[[Vector3], float]] = {
    'z': lambda force: force.z,
    'x': lambda force: force.x,
    'y': lambda force: force.y,
    'norm': lambda force: math.hypot(force.x, force.y, force.z),
}
"""Of the force of a load cell"""


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
