"""The joint design as ROS parameters ``design.*``."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from ..design_file import default_design_path, load_design
from ..physics import DesignError, JointDesign, design_parameters

PREFIX = 'design.'


def declare_design(node: Node) -> JointDesign:
    """Declare ``design.*`` on a node and return the design that its overrides make.

    What the overrides leave out comes from the installed preliminary design, with a warning if
    they give only a part.

    Raises
    ------
    DesignError
        If an override is unknown, of a wrong type or out of range, or the whole is not valid.
    """
    defaults = dataclasses.asdict(load_design(default_design_path()))
    # rclpy has no public view of overrides that nobody declares; a misspelt key would be ignored.
    overrides = {
        name[len(PREFIX) :]: parameter.value
        for name, parameter in node._parameter_overrides.items()
        if name.startswith(PREFIX)
    }
    design = _design({**defaults, **overrides})
    left_out = [
        parameter.name
        for parameter in design_parameters()
        if parameter.name not in overrides and parameter.default is None
    ]
    if overrides and left_out:
        node.get_logger().warning(
            'The parameters give a part of the design only; taken from the preliminary design: '
            + ', '.join(f'{PREFIX}{name} = {defaults[name]!r}' for name in left_out)
        )
    for parameter in design_parameters():
        unit = f' [{parameter.unit}]' if parameter.unit else ''
        descriptor = ParameterDescriptor(
            description=f'{parameter.symbol}{unit}: {parameter.description}',
            additional_constraints=f'a number from {parameter.allowed}',
            floating_point_range=[
                FloatingPointRange(from_value=parameter.minimum, to_value=parameter.maximum)
            ],
            # So that `1` is as good as `1.0`; JointDesign refuses what is not a number.
            dynamic_typing=True,
        )
        value = getattr(design, parameter.name)
        node.declare_parameter(PREFIX + parameter.name, value, descriptor)
    return design


def changed_design(design: JointDesign, parameters: Sequence[Parameter]) -> JointDesign:
    """Return a design with the ``design.*`` among the parameters changed, the others ignored.

    Raises
    ------
    DesignError
        If the whole is not valid.
    """
    changes: Mapping[str, object] = {
        parameter.name[len(PREFIX) :]: parameter.value
        for parameter in parameters
        if parameter.name.startswith(PREFIX)
    }
    if not changes:
        return design
    return _design({**dataclasses.asdict(design), **changes})


def _design(values: Mapping[str, object]) -> JointDesign:
    try:
        return JointDesign.from_mapping(values)
    except DesignError as error:
        raise DesignError(f'{PREFIX if error.key else ""}{error}', key=error.key) from None
