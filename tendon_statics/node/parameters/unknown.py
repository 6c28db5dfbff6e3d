"""Saying which ROS parameters came that nobody takes."""

from __future__ import annotations

from rclpy.node import Node

from ...files.driver_parameters import DRIVER_PARAMETERS
from ...files.estimator_parameters import known_names
from ...files.view_parameters import VIEW_PARAMETERS

QOS = 'qos_overrides.'


def warn_of_unknown_parameters(node: Node) -> None:
    """Say which parameters came that a node does not have; call it when all are declared.

    One file or list may serve all nodes, so those of the others are left alone.
    """
    names = known_names() | {of.name for of in (*DRIVER_PARAMETERS, *VIEW_PARAMETERS)}
    # Driver and view have no QoS to override, an estimator has some.
    left_alone = () if any(name.startswith(QOS) for name in node._parameters) else (QOS,)
    unknown = [
        name
        for name in node._parameter_overrides
        if not (node.has_parameter(name) or name in names or name.startswith(left_alone))
    ]
    if unknown:
        node.get_logger().warning(
            f'Parameters that this node does not have, ignored: {", ".join(unknown)}'
        )
