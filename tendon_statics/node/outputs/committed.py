"""What will not be taken back any more, each with the stamp of its own tensions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from builtin_interfaces.msg import Time
from rclpy.node import Node
from std_msgs.msg import Header

from ...estimation.filtering import MOST_WAITING
from ...estimation.reading_estimator import ReadingEstimator
from .publishers import output_publisher


class CommittedOutput:
    """Publishes committed estimates, a lag behind the tensions.

    Parameters
    ----------
    node : Node
        Where it does.
    message_type : type
        Of ``~/committed_estimate``.
    fill : callable
        Puts an estimate with a header into such a message.
    frame_id : str
        Of the header.
    """

    def __init__(
        self,
        node: Node,
        message_type: type,
        fill: Callable[[Any, Any, Header], Any],
        frame_id: str,
    ) -> None:
        self._publisher = output_publisher(node, message_type, '~/committed_estimate')
        self._message, self._fill = message_type(), fill
        self._header = Header(frame_id=frame_id)
        self._stamps: dict[float, Time] = {}

    def publish(
        self, core: ReadingEstimator[Any, Any], measured: float, stamp: Callable[[], Time]
    ) -> None:
        """Publish what is committed with the newest tensions, if somebody listens.

        Parameters
        ----------
        measured : float
            When the newest were measured, in s, as the core was told.
        stamp : callable
            Returns their stamp.
        """
        if not self._publisher.handle.get_subscription_count() > 0:
            self._stamps.clear()
            return
        self._stamps[measured] = stamp()
        if len(self._stamps) > MOST_WAITING:  # of samples that were never committed
            del self._stamps[next(iter(self._stamps))]
        for estimate in core.take_committed():
            its_stamp = self._stamps.pop(estimate.measured, None)
            if its_stamp is not None:
                self._header.stamp = its_stamp
                self._fill(self._message, estimate, self._header)
                self._publisher.publish(self._message)
