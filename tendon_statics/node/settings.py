"""What the estimator computes with, as ROS parameters: the design and what goes with it."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.exceptions import InvalidParameterValueException
from rclpy.node import Node

from ..design_file import default_design_path, load_design
from ..physics import BendAngleError, DesignError, JointDesign, design_parameters
from ..physics.admissible import check_bend_angle
from ..physics.solver import MAX_TENSION

PREFIX = 'design.'


class SettingError(ValueError):
    """A parameter has a value that is not allowed."""


class NumberParameter(NamedTuple):
    """A parameter that takes a number, beside those of the design."""

    name: str
    default: float
    minimum: float
    maximum: float
    unit: str
    description: str


def _of_cable(cable: str) -> tuple[NumberParameter, ...]:
    tension = f'tension_{cable}'
    return (
        NumberParameter(
            *(f'cable_{cable}.gain', 1.0, -1e6, 1e6, 'N'),
            f'newtons per unit of the measured value: {tension} = gain * value + bias',
        ),
        NumberParameter(
            *(f'cable_{cable}.bias', 0.0, -1e6, 1e6, 'N'), f'{tension} at the measured value 0'
        ),
        NumberParameter(
            *(f'cable_{cable}.max_tension', 1000.0, 0.001, MAX_TENSION, 'N'),
            f'above it {tension} is implausible',
        ),
    )


NUMBERS = (
    NumberParameter(
        *('tension_stddev', 0.01, 0.0, 1000.0, 'N'),
        'standard deviation of each measured tension, the two independent',
    ),
    NumberParameter(
        *('initial_bend_angle', 0.0, -0.5 * math.pi, 0.5 * math.pi, 'rad'),
        'where a tracked unit is at the start and after ~/reset, within its stops',
    ),
    NumberParameter(
        *('input_timeout', 0.5, 0.001, 3600.0, 's'),
        'without valid tensions for so long the input is stale',
    ),
    NumberParameter(
        *('max_skew', 0.005, 0.0, 10.0, 's'),
        'wrench_pair: most that the stamps of two load cells may differ in a pair',
    ),
    *_of_cable('l'),
    *_of_cable('s'),
)
"""Those that may change while the node runs"""


class Calibration(NamedTuple):
    """How a cable's tension in N follows from what is measured: gain · value + bias."""

    gain: float
    bias: float
    max_tension: float


@dataclasses.dataclass(frozen=True)
class Settings:
    """A valid set of those parameters that may change while the node runs."""

    design: JointDesign
    tension_stddev: float
    initial_bend_angle: float
    input_timeout: float
    max_skew: float
    cable_l: Calibration
    cable_s: Calibration

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
        number = {
            parameter.name: _checked_number(parameter, values[parameter.name])
            for parameter in NUMBERS
        }
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
            cable_l=_calibration('cable_l', number),
            cable_s=_calibration('cable_s', number),
        )


def declare_settings(node: Node) -> None:
    """Declare the parameters on a node; `read_settings` has what they are set to.

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
    known = {parameter.name for parameter in design_parameters()}
    for name in given:
        if name not in known:
            _design({PREFIX + name: overrides[PREFIX + name].value})
    left_out = [
        parameter.name
        for parameter in design_parameters()
        if parameter.name not in given and parameter.default is None
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
    for parameter in design_parameters():
        unit = f' [{parameter.unit}]' if parameter.unit else ''
        _declare_number(
            node,
            PREFIX + parameter.name,
            getattr(default, parameter.name),
            f'{parameter.symbol}{unit}: {parameter.description}',
            (parameter.minimum, parameter.maximum),
        )
    for number in NUMBERS:
        _declare_number(
            node,
            number.name,
            number.default,
            f'[{number.unit}]: {number.description}',
            (number.minimum, number.maximum),
        )


def read_settings(node: Node, changes: Iterable[Any] = ()) -> Settings:
    """Return what the parameters of a node are set to, with these ROS parameters changed.

    Raises
    ------
    SettingError
        If the whole is not valid.
    """
    names = [number.name for number in NUMBERS]
    names += [PREFIX + parameter.name for parameter in design_parameters()]
    values = {name: node.get_parameter(name).value for name in names}
    return Settings.from_values(values | {change.name: change.value for change in changes})


def warn_of_unknown_parameters(node: Node) -> None:
    """Say which parameters came that the node does not have; call it when all are declared."""
    unknown = [name for name in node._parameter_overrides if not node.has_parameter(name)]
    if unknown:
        node.get_logger().warning(
            f'Parameters that this node does not have, ignored: {", ".join(unknown)}'
        )


def _declare_number(
    node: Node, name: str, default: float, description: str, limits: tuple[float, float]
) -> None:
    low, high = limits
    kind = {
        'description': description,
        'additional_constraints': f'a number from {low:.6g} to {high:.6g}',
        # So that `1` is as good as `1.0`; Settings refuses what is not a number.
        'dynamic_typing': True,
    }
    allowed = FloatingPointRange(from_value=low, to_value=high)
    try:
        node.declare_parameter(
            name, default, ParameterDescriptor(**kind, floating_point_range=[allowed])
        )
    except InvalidParameterValueException:
        # A value that is not allowed keeps the node from configuring, until it is set to another.
        node.declare_parameter(name, default, ParameterDescriptor(**kind))


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


def _calibration(cable: str, number: Mapping[str, float]) -> Calibration:
    calibration = Calibration(*(number[f'{cable}.{field}'] for field in Calibration._fields))
    if calibration.gain == 0.0:
        raise SettingError(
            f'{cable}.gain is 0.0, with which the tension does not follow what is measured'
        )
    return calibration


def _checked_number(parameter: NumberParameter, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise SettingError(
            f'{parameter.name} is {value!r}, which is not a number in {parameter.unit}'
        )
    if not parameter.minimum <= value <= parameter.maximum:
        raise SettingError(
            f'{parameter.name} is {value!r}, allowed is {parameter.minimum:.6g} to '
            f'{parameter.maximum:.6g} {parameter.unit}'
        )
    return float(value)
