"""Saying which ROS parameters came that nobody takes."""

from __future__ import annotations

from rclpy.node import Node

from ...files.known_parameters import QOS, unknown_names


def warn_of_unknown_parameters(node: Node) -> None:
    """Say which parameters came that a node does not have; call it when all are declared.

    One file or list may serve all nodes, so those of the others are left alone.
    """
    given = node._parameter_overrides
    # Driver and view have no QoS to override, an estimator has some.
    has_qos = any(name.startswith(QOS) for name in node._parameters)
    doubted = [
        *unknown_names(given),
        *(name for name in given if has_qos and name.startswith(QOS)),
    ]
    unknown = [name for name in given if name in doubted and not node.has_parameter(name)]
    if unknown:
        node.get_logger().warning(
            f'Parameters that this node does not have, ignored: {", ".join(unknown)}'
        )
