"""Saying which ROS parameters came that nobody takes."""

from __future__ import annotations

from rclpy.node import Node

from ...files.arm_parameters import ARM_PARAMETERS, CABLES
from ...files.driver_parameters import DRIVER_PARAMETERS
from ...files.estimator_parameters import known_names
from ...files.view_parameters import VIEW_PARAMETERS

QOS = 'qos_overrides.'


def warn_of_unknown_parameters(node: Node) -> None:
    """Say which parameters came that a node does not have; call it when all are declared.

    One file or list may serve all nodes, so those of the others are left alone.
    """
    of_others = (*DRIVER_PARAMETERS, *VIEW_PARAMETERS, *ARM_PARAMETERS)
    names = known_names() | {of.name for of in of_others}
    # Driver and view have no QoS to override, an estimator has some.
    has_qos = any(name.startswith(QOS) for name in node._parameters)
    left_alone = (CABLES,) if has_qos else (CABLES, QOS)
    unknown = [
        name
        for name in node._parameter_overrides
        if not (node.has_parameter(name) or name in names or name.startswith(left_alone))
    ]
    if unknown:
        node.get_logger().warning(
            f'Parameters that this node does not have, ignored: {", ".join(unknown)}'
        )
