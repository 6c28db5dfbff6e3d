"""A bare rclpy relay, as a process: what any node in Python costs that answers each message.

It is called as the estimator is, answers on the same topics with the same quality of service, in
rclpy's default executor, and says the same whatever comes; with ``--estimate`` also on
``~/estimate``.
"""

from __future__ import annotations

import sys
from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64, Float64MultiArray, Header
from tendon_statics_interfaces.msg import Estimate

from tendon_statics.node.inputs.subscriptions import INPUT_DEPTH
from tendon_statics.node.outputs.publishers import OUTPUT_DEPTH
from tendon_statics.physics import paper

ESTIMATE = Estimate(
    header=Header(frame_id='joint'),
    regime=Estimate.EQUILIBRIUM,
    bend_angle=paper.BEND_ANGLE,
    pressure=paper.PRESSURE,
    admissible_angles=[-0.5, paper.BEND_ANGLE],
)


class Relay(Node):
    """Answers each message with two that are always the same, or three with the estimate."""

    def __init__(self, with_estimate: bool) -> None:
        super().__init__('estimator')
        self._answers = [
            (self.create_publisher(Float64, topic, OUTPUT_DEPTH), Float64(data=value))
            for topic, value in (
                ('~/bend_angle', paper.BEND_ANGLE),
                ('~/joint_pressure', paper.PRESSURE),
            )
        ]
        if with_estimate:
            publisher = self.create_publisher(Estimate, '~/estimate', OUTPUT_DEPTH)
            self._answers.append((publisher, ESTIMATE))
        quality = QoSProfile(depth=INPUT_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.create_subscription(Float64MultiArray, 'tensions', self._answer, quality)

    def _answer(self, _message: Float64MultiArray) -> None:
        for publisher, message in self._answers:
            publisher.publish(message)


def main() -> None:
    """Relay until a signal."""
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Relay('--estimate' in sys.argv))
    with suppress(ExternalShutdownException):
        executor.spin()


if __name__ == '__main__':
    main()
