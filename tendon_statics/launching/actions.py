"""What the launch files share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from launch.actions import DeclareLaunchArgument
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from .rviz import Shown, rviz_arguments


def robot_state_publisher(
    description: str, namespace: str, joint_states: str = 'estimator/joint_state'
) -> Node:
    """The action that starts robot_state_publisher for one unit.

    Parameters
    ----------
    description
        The unit as URDF.
    namespace
        That of the node.
    joint_states
        The estimator's topic ``~/joint_state``, seen from there.
    """
    return Node(
        package='robot_state_publisher',
        executable='robot_state_publisher',
        namespace=namespace,
        parameters=[as_they_are({'robot_description': description})],
        remappings=[('joint_states', joint_states)],
        output='screen',
    )


def declared_rviz() -> DeclareLaunchArgument:
    """The argument with which a launch file shows its joints in RViz."""
    return DeclareLaunchArgument(
        'rviz',
        default_value='false',
        choices=['true', 'false'],
        description='whether RViz shows the units; includes robot_state_publisher and markers',
    )


def rviz(joints: Sequence[Shown]) -> Node:
    """The action that starts RViz for these joints."""
    return Node(
        package='rviz2',
        executable='rviz2',
        name='rviz',
        arguments=rviz_arguments(joints),
        output='screen',
    )


def as_they_are(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters whose text stays text; launch by itself makes true of the text ``on``."""
    return {
        name: ParameterValue(value, value_type=str) if isinstance(value, str) else value
        for name, value in parameters.items()
    }
