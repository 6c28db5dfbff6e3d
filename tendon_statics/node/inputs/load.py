"""What sensors say of the load: where gravity points, and the force on the tip."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, Generic, TypeVar

from geometry_msgs.msg import PoseStamped, WrenchStamped
from sensor_msgs.msg import Imu

from ...estimation.estimate import KnownLoad
from ...estimation.measuring import Measuring
from ...estimation.orientation import (
    OrientationError,
    Vector,
    gravity_from_acceleration,
    gravity_in_frame,
    turned,
)
from ...physics import Load, LoadError
from ..wiring import CommonWiring

NOT_GIVEN = -1.0
"""First element of the covariance of what an IMU does not measure"""

Value = TypeVar('Value')


class Measured(Generic[Value]):
    """The newest that one sensor said, and what of it was dropped.

    Parameters
    ----------
    what : str
        What it measures.
    read : callable
        Makes a value of a message; raises a `ValueError` if there is none in it.
    """

    def __init__(self, what: str, read: Callable[[Any], Value]) -> None:
        self.what = what
        self.value: Value | None = None
        self.dropped = 0
        self.last_drop = ''
        self._read = read
        self._time = -float('inf')
        self._reported = 0

    def take(self, message: Any) -> bool:
        """Take a message; return whether it was of use."""
        try:
            self.value = self._read(message)
        except ValueError as error:
            self.dropped += 1
            self.last_drop = str(error)
            return False
        self._time = time.monotonic()
        return True

    def is_of_now(self, now: float, timeout: float) -> bool:
        """Whether the newest is not older than a time in s."""
        return now - self._time <= timeout

    def findings(self, now: float, timeout: float) -> list[str]:
        """What is not as it should be since the last call of `begin_period`."""
        found = []
        if self.value is None:
            found.append(f'no {self.what} came yet')
        elif not self.is_of_now(now, timeout):
            found.append(f'no {self.what} for {now - self._time:.1f} s')
        if self.dropped > self._reported:
            count = self.dropped - self._reported
            found.append(f'dropped {self.what} {count}; the last: {self.last_drop}')
        return found

    def begin_period(self) -> None:
        """Forget what is reported only once."""
        self._reported = self.dropped


class LoadInputs:
    """Keeps what is known of the load.

    Attributes
    ----------
    inputs : dict
        Topic → type of its messages and what takes one.

    Parameters
    ----------
    settings : callable
        Returns those of now.
    warn : callable
        Takes a text on a message that was dropped.
    """

    def __init__(
        self, wiring: CommonWiring, settings: Callable[[], Measuring], warn: Callable[[str], None]
    ) -> None:
        self._settings = settings
        self._warn = warn
        self._frame_id = wiring.frame_id
        self._known: tuple[Measuring, KnownLoad] | None = None
        self._gravity: Measured[Vector] | None = None
        self._tip_force: Measured[tuple[float, float]] | None = None
        self.inputs: dict[str, tuple[type, Callable[[Any], None]]] = {}
        if wiring.gravity_source == 'imu':
            self._gravity = self._listen('imu', Imu, 'orientation of the IMU', self._of_imu)
        elif wiring.gravity_source == 'pose':
            self._gravity = self._listen('base_pose', PoseStamped, 'pose of the base', _of_pose)
        if wiring.tip_wrench:
            self._tip_force = self._listen(
                'tip_wrench', WrenchStamped, 'force on the tip', self._of_wrench
            )

        self._measured = [of for of in (self._gravity, self._tip_force) if of is not None]

    def _listen(
        self, topic: str, message_type: type, what: str, read: Callable[[Any], Value]
    ) -> Measured[Value]:
        measured = Measured(what, read)

        def take(message: Any) -> None:
            if measured.take(message):
                self._known = None
            else:
                self._warn(
                    f'Dropped a message on {topic} ({measured.dropped} so far): '
                    f'{measured.last_drop}'
                )

        self.inputs[topic] = (message_type, take)
        return measured

    def known(self, now: float) -> KnownLoad:
        """Return the load of the present, on the steady clock in s."""
        settings = self._settings()
        if self._known is None or self._known[0] is not settings:
            self._known = settings, self._work_out(settings)
        known = self._known[1]
        for measured in self._measured:
            if not measured.is_of_now(now, settings.load_timeout):
                return known._replace(is_assured=False)
        return known

    def _work_out(self, settings: Measuring) -> KnownLoad:
        direction: Vector | None = settings.gravity_direction
        if self._gravity is not None:
            direction = self._gravity.value or direction
        tip_force = self._tip_force.value if self._tip_force is not None else None
        load = Load(direction or settings.gravity_direction)
        if tip_force is not None:
            load = Load(load.gravity_direction, tip_force, settings.tip_distance)
        return KnownLoad(load, True, all(of.value is not None for of in self._measured))

    def findings(self, now: float) -> list[str]:
        """What is not as it should be with the sensors of the load."""
        timeout = self._settings().load_timeout
        return [text for of in self._measured for text in of.findings(now, timeout)]

    def values(self) -> dict[str, str]:
        """What was counted, by what it is."""
        return {f'dropped: {of.what}': str(of.dropped) for of in self._measured}

    def begin_period(self) -> None:
        """Forget what is reported only once."""
        for of in self._measured:
            of.begin_period()

    def _of_imu(self, message: Imu) -> Vector:
        """Gravity's direction in the joint frame.

        Raises
        ------
        OrientationError
            If neither the orientation nor the acceleration tells it.
        """
        if message.orientation_covariance[0] != NOT_GIVEN:
            o = message.orientation
            direction = gravity_in_frame(o.x, o.y, o.z, o.w)
        elif message.linear_acceleration_covariance[0] != NOT_GIVEN:
            a = message.linear_acceleration
            direction = gravity_from_acceleration(a.x, a.y, a.z)
        else:
            raise OrientationError('it has neither an orientation nor an acceleration')
        return turned(direction, *self._settings().imu_mounting)

    def _of_wrench(self, message: WrenchStamped) -> tuple[float, float]:
        """Force (x, z) on the tip in N; its torque is not looked at.

        Raises
        ------
        LoadError
            If it is not finite, too large, or in another frame.
        """
        frame_id = message.header.frame_id
        if frame_id not in ('', self._frame_id):
            raise LoadError(f'it is in the frame {frame_id}; in {self._frame_id} it is needed')
        force = message.wrench.force
        return Load(tip_force=(force.x, force.z)).tip_force


def _of_pose(message: PoseStamped) -> Vector:
    """Gravity's direction in the joint frame, from its pose in a frame whose Z is up.

    Raises
    ------
    OrientationError
        If the quaternion is none.
    """
    o = message.pose.orientation
    return gravity_in_frame(o.x, o.y, o.z, o.w)
