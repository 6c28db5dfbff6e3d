"""Start one estimator, on request with robot_state_publisher and RViz."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch_ros.actions import Node
from launch_ros.utilities import make_namespace_absolute, prefix_namespace

from tendon_statics.launching.actions import (
    as_they_are,
    declared_rviz,
    robot_state_publisher,
    rviz,
)
from tendon_statics.launching.base_turn import load_base_turn
from tendon_statics.launching.joint_names import JointNames, load_joint_names
from tendon_statics.launching.rviz import Shown
from tendon_statics.launching.unit_description import unit_description


def generate_launch_description():
    share = Path(get_package_share_directory('tendon_statics'))
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'namespace', default_value='', description='namespace of the node and its topics'
            ),
            DeclareLaunchArgument(
                'params_file',
                default_value=str(share / 'config' / 'preliminary_design.yaml'),
                description='parameter file with the joint design, as the preliminary design',
            ),
            DeclareLaunchArgument(
                'tensions',
                default_value='tensions',
                description='topic of std_msgs/Float64MultiArray [tension_l, tension_s] in N',
            ),
            DeclareLaunchArgument(
                'robot_state_publisher',
                default_value='false',
                choices=['true', 'false'],
                description='whether a robot_state_publisher shows the unit in RViz',
            ),
            declared_rviz(),
            OpaqueFunction(function=start_estimator),
        ]
    )


def start_estimator(context):
    arguments = context.launch_configurations
    namespace, params_file = arguments['namespace'], arguments['params_file']
    # A launch file that includes this one may have pushed a namespace.
    outer = arguments.get('ros_namespace')
    full_namespace = make_namespace_absolute(prefix_namespace(outer, namespace))
    node = f'{full_namespace.rstrip("/")}/estimator'
    names = load_joint_names(params_file, node, default=JointNames())
    actions = []
    shows_rviz = arguments['rviz'] == 'true'
    # First, since it may be missing, and launch leaves running what it has started by then.
    if shows_rviz or arguments['robot_state_publisher'] == 'true':
        turn = load_base_turn(params_file, node)
        description = unit_description(params_file, names, base_turn=turn)
        if shows_rviz:
            shown = Shown(full_namespace.strip('/'), names.frame_id, turn is not None)
            actions.append(rviz([shown]))
        actions.append(robot_state_publisher(description, namespace))
    actions.append(
        Node(
            package='tendon_statics',
            executable='estimator',
            name='estimator',
            namespace=namespace,
            parameters=[
                params_file,
                as_they_are(names._asdict()),
                *([{'markers': True}] if shows_rviz else []),
            ],
            remappings=[('tensions', arguments['tensions'])],
            output='screen',
        )
    )
    return actions
