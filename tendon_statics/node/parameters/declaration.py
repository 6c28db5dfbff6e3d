"""Declaring the parameters of a table on a node, and reading them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.exceptions import InvalidParameterValueException
from rclpy.node import Node
from rclpy.parameter import Parameter as ROSParameter

from ...files.parameter_kinds import ListParameter, NumberParameter, Parameter


def declare(node: Node, parameter: Parameter) -> Any:
    """Declare a parameter and return its value.

    Raises
    ------
    SettingError
        If it is fixed and has a value that is not allowed. What may be set again is checked as a
        whole, when it is read.
    """
    name = parameter.name
    default = list(parameter.default) if _is_sequence(parameter) else parameter.default
    # rclpy has no public view of overrides. `1` for a double would make it an integer.
    given = node._parameter_overrides.get(name)
    if given is not None:
        node._parameter_overrides[name] = converted(parameter, given)
    try:
        descriptor = _descriptor(parameter, with_range=True)
        value = node.declare_parameter(name, default, descriptor).value
    except InvalidParameterValueException:
        # Our own check says what is allowed, which rclpy does not.
        descriptor = _descriptor(parameter, with_range=False)
        value = node.declare_parameter(name, default, descriptor).value
    if isinstance(parameter, ListParameter) and not value:
        # Declaring infers a type from the value, and takes an empty list for one of bytes.
        node.set_parameters([converted(parameter, ROSParameter(name, value=[]))])
    if parameter.is_fixed:
        parameter.check(_plain(parameter, value))
    return _plain(parameter, value)


def converted(parameter: Parameter, given: ROSParameter) -> ROSParameter:
    """Return what is set in the type that the node keeps, if it can be meant as such."""
    if given.type_ == ROSParameter.Type.NOT_SET:
        return given
    value = parameter.converted(given.value)
    if isinstance(parameter, ListParameter) and value == []:  # which has no type by itself
        array = ROSParameter.Type.DOUBLE_ARRAY
        return ROSParameter(
            given.name, array if parameter.of_numbers else ROSParameter.Type.STRING_ARRAY, value
        )
    return given if value is given.value else ROSParameter(given.name, value=value)


def declare_all(node: Node, parameters: Iterable[Parameter]) -> dict[str, Any]:
    """Declare parameters and return their values by name.

    Raises
    ------
    SettingError
        As `declare` does.
    """
    return {parameter.name: declare(node, parameter) for parameter in parameters}


def read_all(
    node: Node, parameters: Iterable[Parameter], changes: Iterable[Any] = ()
) -> dict[str, Any]:
    """Return the values of declared parameters by name, with these ROS parameters changed."""
    changed = {change.name: change.value for change in changes}
    return {
        parameter.name: _plain(
            parameter,
            changed[parameter.name]
            if parameter.name in changed
            else node.get_parameter(parameter.name).value,
        )
        for parameter in parameters
    }


def _is_sequence(parameter: Parameter) -> bool:
    return isinstance(parameter.default, tuple)


def _plain(parameter: Parameter, value: Any) -> Any:
    """Make a list of an array; an empty one comes as None."""
    if not _is_sequence(parameter) or isinstance(value, (str, bool, int, float)):
        return value
    return [] if value is None else list(value)


def _descriptor(parameter: Parameter, *, with_range: bool) -> ParameterDescriptor:
    """Describe a parameter; rclpy writes to a descriptor, so that each needs one of its own."""
    description = parameter.description.replace('`', '')
    kind: dict[str, Any] = {'read_only': parameter.is_fixed}
    unit = getattr(parameter, 'unit', '')
    if unit:
        description = f'[{unit}]: {description}'
    if isinstance(parameter, NumberParameter):
        kind['additional_constraints'] = f'a number from {parameter.allowed}'
        if with_range:
            limits = {'from_value': parameter.minimum, 'to_value': parameter.maximum}
            if parameter.is_integer:
                kind['integer_range'] = [IntegerRange(**limits)]
            else:
                kind['floating_point_range'] = [FloatingPointRange(**limits)]
    else:
        kind['additional_constraints'] = parameter.allowed
    if not parameter.is_fixed or isinstance(parameter, (NumberParameter, ListParameter)):
        kind['dynamic_typing'] = True  # So that our own check says what is wrong.
    return ParameterDescriptor(description=description, **kind)
