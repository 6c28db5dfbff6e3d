"""What the launch files share."""

from __future__ import annotations

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import Condition
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitutions import Command
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def robot_state_publisher(
    design_file: SomeSubstitutionsType,
    namespace: SomeSubstitutionsType,
    joint_states: SomeSubstitutionsType = 'estimator/joint_state',
    condition: Condition | None = None,
    **xacro_arguments: str,
) -> Node:
    """The action that starts robot_state_publisher with the description of one unit.

    Parameters
    ----------
    design_file
        The YAML file with the unit's design.
    namespace
        That of the node.
    joint_states
        The estimator's topic ``~/joint_state``, seen from there.
    condition
        Whether to start it at all.
    **xacro_arguments
        Other arguments of ``urdf/unit.urdf.xacro``.
    """
    urdf = Path(get_package_share_directory('tendon_statics')) / 'urdf' / 'unit.urdf.xacro'
    command = [f'xacro "{urdf}" design_file:="', design_file, '"']
    command += [f' {name}:="{value}"' for name, value in xacro_arguments.items()]
    return Node(
        package='robot_state_publisher',
        executable='robot_state_publisher',
        namespace=namespace,
        parameters=[{'robot_description': ParameterValue(Command(command), value_type=str)}],
        remappings=[('joint_states', joint_states)],
        condition=condition,
        output='screen',
    )
