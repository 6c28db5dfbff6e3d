"""How the estimator is connected, as read-only ROS parameters."""

from __future__ import annotations

from typing import Any, NamedTuple

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node

from .settings import SettingError
from .tension_source import COMPONENTS


class Wiring(NamedTuple):
    """What is fixed while the node runs; the fields are the names of the parameters."""

    autostart: bool
    estimation: str
    tension_source: str
    cable_names: tuple[str, str]
    wrench_component: str
    frame_id: str
    joint_name: str
    markers: bool


def declare_wiring(node: Node) -> Wiring:
    """Declare the parameters on a node and return what they are set to.

    Raises
    ------
    SettingError
        If one has a value that is not allowed.
    """
    return Wiring(
        autostart=_declare(
            *(node, 'autostart', True),
            'whether the node configures and activates itself at the start',
        ),
        estimation=_declare_choice(
            *(node, 'estimation', ('equilibrium', 'tracking')),
            'equilibrium: each pair of tensions is solved by itself; '
            'tracking: the estimator remembers where the unit was',
        ),
        tension_source=_declare_choice(
            *(node, 'tension_source', ('array', 'joint_state', 'wrench_pair')),
            'kind of messages that tensions come in',
        ),
        cable_names=_checked_names(
            _declare(
                *(node, 'cable_names', ['cable_l', 'cable_s']),
                'joint_state: names of cables l and s, whose tensions are in effort',
            )
        ),
        wrench_component=_declare_choice(
            *(node, 'wrench_component', tuple(COMPONENTS)),
            "wrench_pair: component of a load cell's force",
        ),
        frame_id=_declare(
            *(node, 'frame_id', 'joint'),
            'frame of the joint, in every stamped message: origin in the centre of the ball, '
            'Z along the unit at zero bend, X towards cable s',
        ),
        joint_name=_declare(node, 'joint_name', 'bend', 'name of the joint in ~/joint_state'),
        markers=_declare(node, 'markers', False, 'whether there is ~/markers, for RViz'),
    )


def _declare(node: Node, name: str, default: Any, description: str, **more: str) -> Any:
    descriptor = ParameterDescriptor(description=description, read_only=True, **more)
    return node.declare_parameter(name, default, descriptor).value


def _declare_choice(node: Node, name: str, choices: tuple[str, ...], description: str) -> str:
    """Declare a parameter with a few values, the first of them the default."""
    allowed = ' or '.join(choices)
    value: str = _declare(node, name, choices[0], description, additional_constraints=allowed)
    if value not in choices:
        raise SettingError(f'{name} is {value!r}, allowed is {allowed}')
    return value


def _checked_names(names: list[str]) -> tuple[str, str]:
    if len(set(names)) != 2 or len(names) != 2 or '' in names:
        raise SettingError(
            f'cable_names is {names!r}, two different names are needed, of cables l and s'
        )
    return names[0], names[1]
