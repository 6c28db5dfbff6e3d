"""Declaring ROS parameters, for both nodes alike."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.exceptions import InvalidParameterValueException
from rclpy.node import Node

from ..files.number_parameter import NumberParameter, SettingError
from ..files.unit_file import check_cable_names
from ..files.unit_parameters import CABLES, TENSION_SOURCES
from .tension_source import COMPONENTS


def declare_fixed(node: Node, name: str, default: Any, description: str, **more: Any) -> Any:
    """Declare a read-only parameter and return its value."""
    descriptor = ParameterDescriptor(description=description, read_only=True, **more)
    return node.declare_parameter(name, default, descriptor).value


def declare_choice(node: Node, name: str, choices: Sequence[str], description: str) -> str:
    """Declare a read-only parameter with a few values, the first of them the default.

    Raises
    ------
    SettingError
        If it is set to another.
    """
    allowed = ' or '.join(choices)
    value: str = declare_fixed(node, name, choices[0], description, additional_constraints=allowed)
    if value not in choices:
        raise SettingError(f'{name} is {value!r}, allowed is {allowed}')
    return value


def declare_tension_source(node: Node) -> str:
    """Declare ``tension_source``; raise a `SettingError` if it is no kind of messages."""
    return declare_choice(
        node,
        'tension_source',
        TENSION_SOURCES,
        'kind of messages that tensions come in',
    )


def declare_cable_names(node: Node) -> tuple[str, str]:
    """Declare ``cable_names``; raise a `SettingError` unless they are two different names."""
    names = declare_fixed(
        node,
        'cable_names',
        list(CABLES),
        'joint_state: names of cables l and s, whose tensions are in effort',
    )
    return check_cable_names(list(names or ()))  # an empty list comes as None


def declare_wrench_component(node: Node) -> str:
    """Declare ``wrench_component``; raise a `SettingError` if there is no such component."""
    return declare_choice(
        node,
        'wrench_component',
        tuple(COMPONENTS),
        "wrench_pair: component of a load cell's force",
    )


def declare_number(node: Node, parameter: NumberParameter, **more: Any) -> Any:
    """Declare a number and return its value, which need not be allowed."""
    limits = {'from_value': parameter.minimum, 'to_value': parameter.maximum}
    unit = f'[{parameter.unit}]: ' if parameter.unit else ''
    kind = {
        'description': unit + parameter.description,
        'additional_constraints': f'a number from {parameter.allowed}',
        # So that `1` is as good as `1.0`.
        'dynamic_typing': True,
        **more,
    }
    ranges = (
        {'integer_range': [IntegerRange(**limits)]}
        if parameter.is_integer
        else {'floating_point_range': [FloatingPointRange(**limits)]}
    )
    try:
        descriptor = ParameterDescriptor(**kind, **ranges)
        return node.declare_parameter(parameter.name, parameter.default, descriptor).value
    except InvalidParameterValueException:
        # Our own check says what is allowed, which rclpy does not.
        descriptor = ParameterDescriptor(**kind)
        return node.declare_parameter(parameter.name, parameter.default, descriptor).value
