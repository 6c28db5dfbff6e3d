"""Saying which ROS parameters came that nobody takes."""

from __future__ import annotations

from rclpy.node import Node

from ..files.unit_parameters import NUMBERS
from ..physics import design_fields
from .faults import fault_parameters
from .settings import PREFIX
from .wiring import Wiring

ESTIMATOR_PARAMETERS = (
    *Wiring._fields,
    *(number.name for number in NUMBERS),
    *(PREFIX + field.name for field in design_fields()),
)
DRIVER_PARAMETERS = (
    *('file', 'loop', 'rate', 'count', 'awaited_subscribers'),
    *(parameter.name for parameter in fault_parameters()),
)
"""What the driver has beside parameters of the estimator"""

QOS = 'qos_overrides.'


def warn_of_unknown_parameters(node: Node) -> None:
    """Say which parameters came that a node does not have; call it when all are declared.

    One file or list may serve both nodes, so those of the other are let be.
    """
    names = {*ESTIMATOR_PARAMETERS, *DRIVER_PARAMETERS}
    # A driver has no QoS to override, an estimator has some.
    let_be = () if any(name.startswith(QOS) for name in node._parameters) else (QOS,)
    unknown = [
        name
        for name in node._parameter_overrides
        if not (node.has_parameter(name) or name in names or name.startswith(let_be))
    ]
    if unknown:
        node.get_logger().warning(
            f'Parameters that this node does not have, ignored: {", ".join(unknown)}'
        )
