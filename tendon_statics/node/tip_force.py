"""The force at the tip: what an estimator publishes and answers of it, if it is asked to.

What it is of a unit and of an arm is in `unit_tip_force` and `arm_tip_force`.
"""

from __future__ import annotations

import math
import time
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from builtin_interfaces.msg import Time
from geometry_msgs.msg import WrenchStamped
from rclpy.publisher import Publisher
from std_msgs.msg import Header

from ..estimation.estimate import AnyEstimate
from ..estimation.tip_force_watch import Pushed
from ..physics import TendonStaticsError, TipForce
from ..physics.load import push_along
from .outputs import messages
from .outputs.publishers import output_publisher
from .services import offer

if TYPE_CHECKING:
    from ..physics.arm import ArmTipForce
    from .managed_estimator import ManagedEstimator

PERIOD = 0.02
"""Least time in s between two of them, each of which takes some 2 ms"""

SHARE = 0.2
"""Of the time that it may take at most: of an arm it is slow, and messages must not wait"""

# The interfaces may be missing, or older than the node.
try:
    from tendon_statics_interfaces.msg import TipForce as TipForceMessage
except ImportError:
    TipForceMessage = None

Line = tuple[tuple[float, float, float], float]
"""Direction of the force that is looked for, and where it acts along the unit's axis, in m"""


class Watch(Protocol):
    """What knows the measured angles of a unit or an arm, and asks."""

    def forget(self) -> None:
        """Forget what was measured."""

    def ask(self, state: Any, settings: Any, now: float, /) -> Pushed | None:
        """Return what a state or an estimate tells of the tip force; None if nothing."""


class TipForces(ABC):
    """Publishes ``~/tip_force`` and ``~/tip_wrench``, and answers ``~/solve_tip_force``."""

    service: type | None
    """Of ``~/solve_tip_force``; None if the interfaces do not have it"""

    def __init__(self, node: ManagedEstimator[Any, Any], watch: Watch) -> None:
        self._node = node
        self._watch = watch
        self._next = 0.0
        self._wrench = output_publisher(node, WrenchStamped, '~/tip_wrench')
        self._forces: Publisher | None = None
        if TipForceMessage is None or self.service is None:
            node.get_logger().warning(
                'No ~/tip_force and ~/solve_tip_force, since tendon_statics_interfaces is not '
                'there or older than this; build the folder interfaces/ with it: '
                'colcon build --base-paths . interfaces'
            )
        else:
            self._forces = output_publisher(node, TipForceMessage, '~/tip_force')
            offer(node, self.service, 'solve_tip_force', self._solve, _refuse)

    def forget(self) -> None:
        """Forget what was measured."""
        self._watch.forget()

    @property
    @abstractmethod
    def _line(self) -> Line:
        """The line of the node's settings."""

    @abstractmethod
    def _answer(self, request: Any) -> TipForce | ArmTipForce:
        """Return what a request asks for.

        Raises
        ------
        TendonStaticsError, ValueError
            If that is not allowed.
        """

    def publish(self, estimate: AnyEstimate, stamp: Callable[[], Time]) -> None:
        """Publish what an estimate tells, if it does, somebody listens, and it is time again."""
        now = time.monotonic()
        listeners = [
            publisher
            for publisher in (self._forces, self._wrench)
            if publisher is not None and publisher.handle.get_subscription_count() > 0
        ]
        if not listeners or now < self._next:
            return
        pushed = self._watch.ask(estimate, self._node.core.settings, now)
        done = time.monotonic()
        self._next = done + max(PERIOD, (done - now) / SHARE)
        if pushed is None:
            return
        header = Header(stamp=stamp(), frame_id=self._node.wiring.frame_id)
        direction, distance = self._line
        along = push_along(direction, distance)[:2]
        if self._forces is not None:
            is_assured = estimate.known.is_assured
            self._forces.publish(
                _force_message(header, pushed, along, distance, load_assured=is_assured)
            )
        wrench = _wrench_message(header, pushed, along)
        if wrench is not None:
            self._wrench.publish(wrench)

    def _solve(self, request: Any, response: Any) -> Any:
        try:
            found = self._answer(request)
        except (TendonStaticsError, ValueError) as error:
            return _refuse(response, str(error))
        response.success = True
        response.load_assured = self._node.known_load().is_assured
        return self._filled(response, found)

    def _filled(self, response: Any, found: Any) -> Any:
        """Return a response with what was found."""
        return _fill(response, found)


def _force_message(
    header: Header,
    pushed: Pushed,
    direction: tuple[float, float],
    distance: float,
    *,
    load_assured: bool,
) -> Any:
    """Return what is known as a message of `TipForce`."""
    message = TipForceMessage(header=header, tip_distance=distance, load_assured=load_assured)
    message.direction_x, message.direction_z = direction
    message.bend_angle = pushed.bend_angle
    message.bend_angle_stddev = pushed.bend_angle_stddev
    message.bend_angle_measured = pushed.is_measured
    return _fill(message, pushed.found)


def _wrench_message(
    header: Header, pushed: Pushed, direction: tuple[float, float]
) -> WrenchStamped | None:
    """Return the force as a wrench at the tip, where it is a number that was measured."""
    force = pushed.found.force
    if force is None or not pushed.is_measured:
        return None
    message = WrenchStamped(header=header)
    message.wrench.force.x, message.wrench.force.z = (force * part for part in direction)
    return message


def _fill(message: Any, found: TipForce | ArmTipForce) -> Any:
    message.intervals = [end for interval in found.intervals for end in interval]
    message.level = found.level
    message.probability_free = found.probability_free
    message.at_limit = found.at_limit
    message.force = math.nan if found.force is None else found.force
    message.force_stddev = math.nan if found.force_stddev is None else found.force_stddev
    return message


def _refuse(response: Any, reason: str) -> Any:
    messages.refuse(response, reason)
    response.intervals = []
    response.level = response.probability_free = math.nan
    response.force = response.force_stddev = math.nan
    return response
