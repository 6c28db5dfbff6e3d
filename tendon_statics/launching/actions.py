"""What the launch files share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from launch.actions import DeclareLaunchArgument
from launch.logging import get_logger
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from ..files.parameter_file import ESTIMATORS
from .node_arguments import NODE_ARGUMENTS, given_parameters, respawn_options
from .rviz import Shown, rviz_arguments


def declared_node_arguments() -> list[DeclareLaunchArgument]:
    """The arguments that both launch files take for their nodes."""
    return [
        DeclareLaunchArgument(
            argument.name,
            default_value=argument.default,
            description=argument.description,
            choices=list(argument.choices) or None,
        )
        for argument in NODE_ARGUMENTS
    ]


def own_node(
    arguments: Mapping[str, str],
    name: str,
    namespace: str,
    parameters: Sequence[Any],
    remappings: Sequence[tuple[str, str]],
    ros_arguments: Sequence[str] = (),
) -> Node:
    """The action that starts a node of this package, and says so if it ends before all do.

    Parameters
    ----------
    arguments
        Those of the launch file.
    name
        Of program and node.
    """
    own = ('use_sim_time', 'autostart') if name in ESTIMATORS else ('use_sim_time',)
    return Node(
        package='tendon_statics',
        executable=name,
        name=name,
        namespace=namespace,
        parameters=[*parameters, given_parameters(arguments, *own)],
        remappings=remappings,
        ros_arguments=[*ros_arguments, '--log-level', arguments['log_level']],
        on_exit=_said(f'/{namespace.strip("/")}/{name}'.replace('//', '/'), arguments),
        **respawn_options(arguments),
        output='screen',
    )


def robot_state_publisher(
    arguments: Mapping[str, str],
    description: str,
    namespace: str,
    joint_states: str = 'estimator/joint_state',
) -> Node:
    """The action that starts robot_state_publisher for one unit.

    Parameters
    ----------
    arguments
        Those of the launch file.
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
        parameters=[
            as_they_are({'robot_description': description}),
            given_parameters(arguments, 'use_sim_time'),
        ],
        remappings=[('joint_states', joint_states)],
        ros_arguments=['--log-level', arguments['log_level']],
        **respawn_options(arguments),
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


def rviz(arguments: Mapping[str, str], joints: Sequence[Shown]) -> Node:
    """The action that starts RViz for these joints."""
    return Node(
        package='rviz2',
        executable='rviz2',
        name='rviz',
        arguments=rviz_arguments(joints),
        parameters=[given_parameters(arguments, 'use_sim_time')],
        ros_arguments=['--log-level', arguments['log_level']],
        output='screen',
    )


def as_they_are(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters whose text stays text; launch by itself makes true of the text ``on``."""
    return {
        name: ParameterValue(value, value_type=str) if isinstance(value, str) else value
        for name, value in parameters.items()
    }


def _said(node: str, arguments: Mapping[str, str]) -> Any:
    """What is to be done when a node ends: say what is missing from then on."""

    def say(event: Any, context: Any) -> None:
        if context.is_shutdown:
            return
        then = (
            f'it is started again after {arguments["respawn_delay"]} s'
            if arguments['respawn'] == 'true'
            else 'the rest goes on without it; respawn:=true would start it again'
        )
        get_logger('tendon_statics').error(f'{node} ended with {event.returncode}: {then}')

    return say
