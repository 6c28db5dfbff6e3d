"""What pushes at the end of an arm, as its node publishes it, if it is asked to."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from builtin_interfaces.msg import Time
from std_msgs.msg import Header

from ..estimation.arm_estimate import ArmEstimate
from ..physics import TendonStaticsError
from ..physics.arm import ArmTipForce, arm_tip_force
from ..physics.load import push_along
from ..physics.tip_force import may_be_at_stop
from .outputs.publishers import output_publisher
from .tip_force import PERIOD, TipForceMessage

if TYPE_CHECKING:
    from .arm_estimator import ArmEstimator

SHARE = 0.2
"""Of the time that it may take at most: of many joints it is slow, and messages must not wait"""


class ArmTipForces:
    """Publishes ``~/tip_force`` of an arm: the forces along a line that all joints explain.

    A joint whose angle was measured lately is there; of the others the estimate has to do, with
    its deviation. The largest deviation of an angle is taken for all.
    """

    def __init__(self, node: ArmEstimator) -> None:
        self._node = node
        self._measured: dict[int, tuple[float, float]] = {}
        """Joint, counted from 1 → when, in s, and the angle in rad"""
        self._next = 0.0
        self._publisher = None
        if TipForceMessage is None:
            node.get_logger().warning(
                'No ~/tip_force, since tendon_statics_interfaces is not there or older than this; '
                'build the folder interfaces/ with it: colcon build --base-paths . interfaces'
            )
        else:
            self._publisher = output_publisher(node, TipForceMessage, '~/tip_force')

    def note_angles(self, bend_angles: Mapping[int, float]) -> None:
        """Take measured angles in rad by the joint; those beyond a stop are told by the arm."""
        now, stops = time.monotonic(), self._node.arm.stops
        for joint, angle in bend_angles.items():
            if abs(angle) <= stops[joint - 1]:
                self._measured[joint] = now, angle

    def forget(self) -> None:
        """Forget what was measured."""
        self._measured.clear()

    def publish(self, estimate: ArmEstimate, stamp: Callable[[], Time]) -> None:
        """Publish what an estimate tells, if it does, somebody listens, and it is time again."""
        now = time.monotonic()
        if (
            self._publisher is None
            or estimate.bend_angles is None
            or now < self._next
            or not self._publisher.handle.get_subscription_count() > 0
        ):
            return
        settings = self._node.core.settings
        oldest = now - settings.input_timeout
        measured = {joint: angle for joint, (at, angle) in self._measured.items() if at >= oldest}
        angles, stddevs = list(estimate.bend_angles), list(estimate.bend_angle_stddevs)
        for joint, angle in measured.items():
            angles[joint - 1] = angle
            stddevs[joint - 1] = settings.measured_bend_angle_stddev
        known = [stddev for stddev in stddevs if stddev is not None]
        if len(known) < len(stddevs):  # Of a joint it is not known where it is, or how well.
            return
        at_stop = [
            joint
            for joint, (design, angle, stddev) in enumerate(
                zip(estimate.arm.designs, angles, known, strict=True), start=1
            )
            if angle and may_be_at_stop(design, angle, stddev)
        ]
        try:
            found = arm_tip_force(
                estimate.arm,
                estimate.state.cable_tensions,
                bend_angles=angles,
                direction=settings.tip_direction,
                load=estimate.known.load,
                at_stop=at_stop,
                tension_stddev=settings.tension_stddev,
                bend_angle_stddev=max(known),
                level=settings.tip_force_level,
            )
        except TendonStaticsError:  # tensions that let no joint be seated
            return
        header = Header(stamp=stamp(), frame_id=self._node.wiring.frame_id)
        message = _message(header, found, estimate)
        message.bend_angle_measured = len(measured) == len(angles)
        self._publisher.publish(message)
        done = time.monotonic()
        self._next = done + max(PERIOD, (done - now) / SHARE)


def _message(header: Header, found: ArmTipForce, estimate: ArmEstimate) -> Any:
    settings, length = estimate.settings, estimate.arm.units[-1].length
    message = TipForceMessage(header=header, tip_distance=length)
    message.intervals = [end for interval in found.intervals for end in interval]
    message.direction_x, message.direction_z = push_along(settings.tip_direction, length)[:2]
    message.level, message.probability_free = found.level, found.probability_free
    # An arm has several angles.
    message.bend_angle = message.bend_angle_stddev = math.nan
    message.force = message.force_stddev = math.nan
    message.load_assured = estimate.known.is_assured
    return message
