"""The force at the tip: what the estimator publishes and answers of it, if it is asked to."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import WrenchStamped
from rclpy.publisher import Publisher
from std_msgs.msg import Header

from ..estimation.estimate import Estimate
from ..estimation.tip_force_watch import Pushed, TipForceWatch
from ..physics import TendonStaticsError, TipForce, tip_force
from ..physics.load import push_along
from .outputs import messages
from .outputs.publishers import output_publisher
from .services import offer

if TYPE_CHECKING:
    from .estimator import Estimator

__all__ = ['PERIOD', 'TipForceMessage', 'TipForces', 'tip_force_message', 'tip_wrench_message']

PERIOD = 0.02
"""Least time in s between two of them, each of which takes some 2 ms"""

# The interfaces may be missing, or older than the node.
try:
    from tendon_statics_interfaces.msg import TipForce as TipForceMessage
    from tendon_statics_interfaces.srv import SolveTipForce
except ImportError:
    TipForceMessage = SolveTipForce = None


class TipForces:
    """Publishes ``~/tip_force`` and ``~/tip_wrench``, and answers ``~/solve_tip_force``."""

    def __init__(self, node: Estimator) -> None:
        self._node = node
        self._watch = TipForceWatch()
        self._next = 0.0
        self._wrench = output_publisher(node, WrenchStamped, '~/tip_wrench')
        self._forces: Publisher | None = None
        if TipForceMessage is None:
            node.get_logger().warning(
                'No ~/tip_force and ~/solve_tip_force, since tendon_statics_interfaces is not '
                'there or older than this; build the folder interfaces/ with it: '
                'colcon build --base-paths . interfaces'
            )
        else:
            self._forces = output_publisher(node, TipForceMessage, '~/tip_force')
            offer(node, SolveTipForce, 'solve_tip_force', self._solve, _refuse)

    def note_angle(self, bend_angle: float) -> None:
        """Take a measured angle in rad.

        Raises
        ------
        BendAngleError
            If it is not a number or lies beyond the stop.
        """
        self._watch.note_angle(bend_angle, time.monotonic(), self._node.core.settings)

    def forget(self) -> None:
        """Forget what was measured."""
        self._watch.forget()

    def publish(self, estimate: Estimate, stamp: Callable[[], Time]) -> None:
        """Publish what an estimate tells, if it does, somebody listens, and it is time again."""
        now = time.monotonic()
        listeners = [
            publisher
            for publisher in (self._forces, self._wrench)
            if publisher is not None and publisher.handle.get_subscription_count() > 0
        ]
        if not listeners or now < self._next:
            return
        settings = self._node.core.settings
        pushed = self._watch.ask(estimate, settings, now)
        if pushed is None:
            return
        self._next = now + PERIOD
        header = Header(stamp=stamp(), frame_id=self._node.wiring.frame_id)
        direction = push_along(settings.tip_direction, settings.tip_distance)[:2]
        if self._forces is not None:
            self._forces.publish(
                tip_force_message(
                    header,
                    pushed,
                    direction,
                    settings.tip_distance,
                    load_assured=estimate.known.is_assured,
                )
            )
        wrench = tip_wrench_message(header, pushed, direction)
        if wrench is not None:
            self._wrench.publish(wrench)

    def _solve(self, request: Any, response: Any) -> Any:
        settings, known = self._node.core.settings, self._node.known_load()
        direction, distance = tuple(map(float, request.direction)), request.tip_distance
        if not any(direction):
            if distance:
                return _refuse(
                    response,
                    f'tip_distance is {distance!r} m, but direction is 0, which asks for the line '
                    'of the node: give the direction too',
                )
            direction, distance = settings.tip_direction, settings.tip_distance
        try:
            found = tip_force(
                settings.design,
                request.tension_l,
                request.tension_s,
                bend_angle=request.bend_angle,
                direction=direction,
                distance=distance,
                load=known.load,
                tension_stddev=settings.tension_stddev,
                bend_angle_stddev=settings.measured_bend_angle_stddev,
                design_covariance=settings.design_uncertainty,
                level=settings.tip_force_level,
                slipping=request.slipping,
                at_stop=request.at_stop,
            )
        except (TendonStaticsError, ValueError) as error:
            return _refuse(response, str(error))
        response.success = True
        response.load_assured = known.is_assured
        return _fill(response, found)


def tip_force_message(
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


def tip_wrench_message(
    header: Header, pushed: Pushed, direction: tuple[float, float]
) -> WrenchStamped | None:
    """Return the force as a wrench at the tip, where it is a number that was measured."""
    force = pushed.found.force
    if force is None or not pushed.is_measured:
        return None
    message = WrenchStamped(header=header)
    message.wrench.force.x, message.wrench.force.z = (force * part for part in direction)
    return message


def _fill(message: Any, found: TipForce) -> Any:
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
