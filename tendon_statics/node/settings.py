"""What the estimator computes with, as ROS parameters: the design and what goes with it."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node

from ..files.design_file import default_design_path, load_design
from ..files.number_parameter import NumberParameter, SettingError
from ..files.unit_file import cable_scale
from ..files.unit_parameters import NUMBERS
from ..physics import (
    BendAngleError,
    DesignError,
    DesignParameter,
    JointDesign,
    design_fields,
)
from ..physics.admissible import check_bend_angle
from ..tensions.cable_scale import CableScale
from .parameters import declare_number

PREFIX = 'design.'


@dataclasses.dataclass(frozen=True)
class Settings:
    """A valid set of those parameters that may change while the node runs."""

    design: JointDesign
    tension_stddev: float
    initial_bend_angle: float
    input_timeout: float
    max_skew: float
    cable_l: CableScale
    cable_s: CableScale

    @classmethod
    def from_values(cls, values: Mapping[str, object]) -> Settings:
        """Make settings of the values of all ROS parameters by name; foreign ones are let be.

        Raises
        ------
        SettingError
            If the whole is not valid; the text names the parameter, its value and what is
            allowed.
        """
        design = _design(values)
        number: dict[str, float] = {}
        for parameter in NUMBERS:
            value: Any = values[parameter.name]
            parameter.check(value)
            number[parameter.name] = float(value)
        initial_bend_angle = number['initial_bend_angle']
        try:
            check_bend_angle(design, initial_bend_angle)
        except BendAngleError as error:
            raise SettingError(f'initial_{error}') from None
        return cls(
            design=design,
            tension_stddev=number['tension_stddev'],
            initial_bend_angle=initial_bend_angle,
            input_timeout=number['input_timeout'],
            max_skew=number['max_skew'],
            cable_l=cable_scale('cable_l', number),
            cable_s=cable_scale('cable_s', number),
        )


def declare_settings(node: Node) -> set[str]:
    """Declare the parameters on a node; `read_settings` has what they are set to.

    Returned are the names of those of the design that were not given.

    Design parameters that are left out come from the installed preliminary design, with a warning
    if only a part is given. Values that are not allowed are kept, for `read_settings` to refuse.

    Raises
    ------
    SettingError
        If there is no design parameter of a name that was given.
    """
    default = load_design(default_design_path())
    # rclpy has no public view of overrides that nobody declares; a misspelt key would be ignored.
    overrides = node._parameter_overrides
    if PREFIX[:-1] in overrides:
        value = overrides[PREFIX[:-1]].value
        raise SettingError(f'design is {value!r}, but its parameters have names: {PREFIX}mass')
    given = [name[len(PREFIX) :] for name in overrides if name.startswith(PREFIX)]
    known = {field.name for field in design_fields()}
    for name in given:
        if name not in known:
            _design({PREFIX + name: overrides[PREFIX + name].value})
    left_out = [
        field.name
        for field in design_fields()
        if field.name not in given and field.default is None
    ]
    if not given:
        node.get_logger().warning(
            "No design.* parameters came, so this is the paper's preliminary design, two values "
            'of which are identified, not measured'
        )
    elif left_out:
        node.get_logger().warning(
            'The parameters give a part of the design only; taken from the preliminary design: '
            + ', '.join(f'{PREFIX}{name} = {getattr(default, name)!r}' for name in left_out)
        )
    for field in design_fields():
        if isinstance(field, DesignParameter):
            declare_number(
                node,
                NumberParameter(
                    name=PREFIX + field.name,
                    default=getattr(default, field.name),
                    minimum=field.minimum,
                    maximum=field.maximum,
                    unit=field.unit,
                    description=f'{field.description} ({field.symbol})',
                ),
            )
        else:
            node.declare_parameter(
                PREFIX + field.name,
                getattr(default, field.name),
                ParameterDescriptor(
                    description=field.description, additional_constraints=field.allowed
                ),
            )
    for number in NUMBERS:
        declare_number(node, number)
    return {PREFIX + name for name in left_out}


def read_settings(node: Node, changes: Iterable[Any] = ()) -> Settings:
    """Return what the parameters of a node are set to, with these ROS parameters changed.

    Raises
    ------
    SettingError
        If the whole is not valid.
    """
    names = [number.name for number in NUMBERS]
    names += [PREFIX + field.name for field in design_fields()]
    values = {name: node.get_parameter(name).value for name in names}
    return Settings.from_values(values | {change.name: change.value for change in changes})


def _design(values: Mapping[str, object]) -> JointDesign:
    try:
        return JointDesign.from_mapping(
            {
                name[len(PREFIX) :]: value
                for name, value in values.items()
                if name.startswith(PREFIX)
            }
        )
    except DesignError as error:
        raise SettingError(f'{PREFIX if error.key else ""}{error}') from None
