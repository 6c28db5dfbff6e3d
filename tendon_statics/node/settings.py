"""What the estimator computes with, as ROS parameters: the design and what goes with it."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.node import Node

from ..design_file import default_design_path, load_design
from ..physics import BendAngleError, DesignError, JointDesign, design_parameters
from ..physics.admissible import check_bend_angle

PREFIX = 'design.'

MAX_TENSION_STDDEV = 1000.0
"""Largest standard deviation of a tension in N that is taken."""


class SettingError(ValueError):
    """A parameter has a value that is not allowed."""


@dataclasses.dataclass(frozen=True)
class Settings:
    """A valid set of those parameters that may change while the node runs."""

    design: JointDesign
    tension_stddev: float = 0.01
    initial_bend_angle: float = 0.0

    def changed(self, parameters: Iterable[Any]) -> Settings:
        """Return the settings with these ROS parameters changed, foreign ones left alone.

        Raises
        ------
        SettingError
            If the whole is not valid; the text names the parameter, its value and what is
            allowed.
        """
        values = {parameter.name: parameter.value for parameter in parameters}
        design = {
            name[len(PREFIX) :]: value for name, value in values.items() if name.startswith(PREFIX)
        }
        settings = dataclasses.replace(
            self,
            design=_design({**dataclasses.asdict(self.design), **design}),
            tension_stddev=values.get('tension_stddev', self.tension_stddev),
            initial_bend_angle=values.get('initial_bend_angle', self.initial_bend_angle),
        )
        try:
            return dataclasses.replace(
                settings,
                tension_stddev=_checked_stddev(settings.tension_stddev),
                initial_bend_angle=check_bend_angle(settings.design, settings.initial_bend_angle),
            )
        except BendAngleError as error:
            raise SettingError(f'initial_{error}') from None


def declare_settings(node: Node) -> Settings:
    """Declare the parameters on a node and return what they are set to at the start.

    Design parameters that are left out come from the installed preliminary design, with a warning
    if only a part is given.

    Raises
    ------
    SettingError
        If a design parameter is unknown, or the whole is not valid.
    """
    defaults = Settings(load_design(default_design_path()))
    # rclpy has no public view of overrides that nobody declares; a misspelt key would be ignored.
    overrides = node._parameter_overrides
    if PREFIX[:-1] in overrides:
        value = overrides[PREFIX[:-1]].value
        raise SettingError(f'design is {value!r}, but its parameters have names: {PREFIX}mass')
    settings = defaults.changed(overrides.values())
    given = [name[len(PREFIX) :] for name in overrides if name.startswith(PREFIX)]
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
            + ', '.join(
                f'{PREFIX}{name} = {getattr(settings.design, name)!r}' for name in left_out
            )
        )
    for parameter in design_parameters():
        unit = f' [{parameter.unit}]' if parameter.unit else ''
        _declare_number(
            node,
            PREFIX + parameter.name,
            getattr(defaults.design, parameter.name),
            f'{parameter.symbol}{unit}: {parameter.description}',
            (parameter.minimum, parameter.maximum),
        )
    _declare_number(
        node,
        'tension_stddev',
        defaults.tension_stddev,
        '[N]: standard deviation of each measured tension, the two independent',
        (0.0, MAX_TENSION_STDDEV),
    )
    _declare_number(
        node,
        'initial_bend_angle',
        defaults.initial_bend_angle,
        '[rad]: where a tracked unit is at the start and after ~/reset, within its stops',
        (-0.5 * math.pi, 0.5 * math.pi),
    )
    return settings


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
    descriptor = ParameterDescriptor(
        description=description,
        additional_constraints=f'a number from {low:.6g} to {high:.6g}',
        floating_point_range=[FloatingPointRange(from_value=low, to_value=high)],
        # So that `1` is as good as `1.0`; Settings refuses what is not a number.
        dynamic_typing=True,
    )
    node.declare_parameter(name, default, descriptor)


def _design(values: Mapping[str, object]) -> JointDesign:
    try:
        return JointDesign.from_mapping(values)
    except DesignError as error:
        raise SettingError(f'{PREFIX if error.key else ""}{error}') from None


def _checked_stddev(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise SettingError(f'tension_stddev is {value!r}, which is not a number in N')
    if not 0.0 <= value <= MAX_TENSION_STDDEV:
        raise SettingError(
            f'tension_stddev is {value!r}, allowed is 0 to {MAX_TENSION_STDDEV:g} N'
        )
    return float(value)
