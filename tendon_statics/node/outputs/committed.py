"""What will not be taken back any more, each with the stamp of its own tensions."""

from __future__ import annotations

from collections.abc import Callable

from builtin_interfaces.msg import Time
from rclpy.publisher import Publisher
from std_msgs.msg import Header

from ...estimation.filtering import MOST_WAITING
from ...estimation.unit_estimator import UnitEstimator
from . import messages


class CommittedOutput:
    """Publishes committed estimates, a lag behind the tensions."""

    def __init__(self, publisher: Publisher, frame_id: str) -> None:
        self._publisher = publisher
        self._message = messages.Estimate()
        self._header = Header(frame_id=frame_id)
        self._stamps: dict[float, Time] = {}

    def publish(self, unit: UnitEstimator, measured: float, stamp: Callable[[], Time]) -> None:
        """Publish what is committed with the newest tensions, if somebody listens.

        Parameters
        ----------
        measured : float
            When the newest were measured, in s, as the unit was told.
        stamp : callable
            Returns their stamp.
        """
        if not self._publisher.handle.get_subscription_count() > 0:
            self._stamps.clear()
            return
        self._stamps[measured] = stamp()
        if len(self._stamps) > MOST_WAITING:  # of samples that were never committed
            del self._stamps[next(iter(self._stamps))]
        for estimate in unit.take_committed():
            its_stamp = self._stamps.pop(estimate.measured, None)
            if its_stamp is not None:
                self._header.stamp = its_stamp
                messages.fill_estimate(self._message, estimate, self._header)
                self._publisher.publish(self._message)
