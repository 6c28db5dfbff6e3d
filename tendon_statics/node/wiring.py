"""How the estimator is connected, as read-only ROS parameters."""

from __future__ import annotations

from typing import NamedTuple

from rclpy.node import Node

from ..joint_names import JointNames
from .parameters import (
    declare_cable_names,
    declare_choice,
    declare_fixed,
    declare_tension_source,
    declare_wrench_component,
)


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
    executor: str


def declare_wiring(node: Node) -> Wiring:
    """Declare the parameters on a node and return what they are set to.

    Raises
    ------
    SettingError
        If one has a value that is not allowed.
    """
    return Wiring(
        autostart=declare_fixed(
            *(node, 'autostart', True),
            'whether the node configures and activates itself at the start',
        ),
        estimation=declare_choice(
            *(node, 'estimation', ('equilibrium', 'tracking')),
            'equilibrium: each pair of tensions is solved by itself; '
            'tracking: the estimator remembers where the unit was',
        ),
        tension_source=declare_tension_source(node),
        cable_names=declare_cable_names(node),
        wrench_component=declare_wrench_component(node),
        frame_id=declare_fixed(
            *(node, 'frame_id', JointNames().frame_id),
            'frame of the joint, in every stamped message: origin in the centre of the ball, '
            'Z along the unit at zero bend, X towards cable s',
        ),
        joint_name=declare_fixed(
            *(node, 'joint_name', JointNames().joint_name),
            'name of the joint in ~/joint_state',
        ),
        markers=declare_fixed(node, 'markers', False, 'whether there is ~/markers, for RViz'),
        executor=declare_choice(
            *(node, 'executor', ('single', 'events')),
            "single: rclpy's default executor; events: its experimental EventsExecutor, which "
            'takes less of the processor',
        ),
    )
