"""A bare rclpy relay of joint states, as a process: what any node in Python costs for an arm.

It is called as the estimator of an arm is, answers each `JointState` with one of ten joints, with
the same quality of service, in rclpy's default executor, and says the same whatever comes.
"""

from __future__ import annotations

from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

from tendon_statics.node.inputs.subscriptions import INPUT_DEPTH
from tendon_statics.node.outputs.publishers import OUTPUT_DEPTH

JOINTS = 10


class Relay(Node):
    """Answers each message with the same joint angles, under the stamp that came."""

    def __init__(self) -> None:
        super().__init__('arm_estimator')
        names = [f'arm_joint_{number}' for number in range(1, JOINTS + 1)]
        self._message = JointState(name=names)
        self._message.header.frame_id = 'base'
        self._publisher = self.create_publisher(JointState, '~/joint_states', OUTPUT_DEPTH)
        quality = QoSProfile(depth=INPUT_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.create_subscription(JointState, 'tensions', self._answer, quality)

    def _answer(self, message: JointState) -> None:
        self._message.header.stamp = message.header.stamp
        self._message.position = [0.0] * JOINTS
        self._publisher.publish(self._message)


def main() -> None:
    """Relay until a signal."""
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Relay())
    with suppress(ExternalShutdownException):
        executor.spin()


if __name__ == '__main__':
    main()
