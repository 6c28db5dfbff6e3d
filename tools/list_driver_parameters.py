"""Print the parameters of the pulley driver, for docs/rig.md."""

from __future__ import annotations

import json

from list_entities import alone
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.node.pulley_driver import PulleyDriver


def main() -> None:
    """Print the table."""
    with alone(PulleyDriver) as driver:
        rows = [row(driver, name) for name in own_parameters(driver)]
    print(markdown_table(('parameter', 'default', 'allowed', ''), rows))


def own_parameters(node: Node) -> list[str]:
    """Names of the parameters that not every node has, in the order of their declaration."""
    of_ros = ('use_sim_time', 'start_type_description_service', 'qos_overrides')
    return [name for name in node._parameters if not name.startswith(of_ros)]


def row(node: Node, name: str) -> tuple[str, str, str, str]:
    """Name, default, range and meaning of a parameter."""
    descriptor = node.describe_parameter(name)
    default = json.dumps(node.get_parameter(name).value)
    return f'`{name}`', f'`{default}`', allowed(descriptor), descriptor.description


def allowed(descriptor: ParameterDescriptor) -> str:
    """What a parameter may be, empty if all of its type."""
    for limits in (*descriptor.floating_point_range, *descriptor.integer_range):
        return f'{limits.from_value:.10g} to {limits.to_value:.10g}'
    return descriptor.additional_constraints


if __name__ == '__main__':
    main()
