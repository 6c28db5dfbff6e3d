"""Start one estimator per joint; `ros2 launch tendon_statics rig.launch.py -s` has arguments."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction

from tendon_statics.launching.actions import (
    as_they_are,
    declared_node_arguments,
    declared_rviz,
    own_node,
    robot_state_publisher,
    rviz,
)
from tendon_statics.launching.description import unit_description
from tendon_statics.launching.rig_file import load_rig
from tendon_statics.launching.rviz import Shown


def generate_launch_description():
    share = Path(get_package_share_directory('tendon_statics'))
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'rig_file',
                default_value=str(share / 'config' / 'rig.yaml'),
                description='YAML list of the joints, as the installed rig.yaml',
            ),
            DeclareLaunchArgument(
                'simulate',
                default_value='false',
                choices=['true', 'false'],
                description='whether stand-in pulley drivers take the place of the drivers',
            ),
            DeclareLaunchArgument(
                'robot_state_publisher',
                default_value='false',
                choices=['true', 'false'],
                description='whether a robot_state_publisher per joint shows the unit in RViz',
            ),
            *declared_node_arguments(),
            declared_rviz(),
            OpaqueFunction(function=start_rig),
        ]
    )


def start_rig(context):
    arguments = context.launch_configurations
    joints = load_rig(arguments['rig_file'])
    actions = []
    shows_rviz = arguments['rviz'] == 'true'
    # First, since it may be missing, and launch leaves running what it has started by then.
    if shows_rviz:
        shown = [
            Shown(joint.namespace, joint.names.frame_id, joint.base_turn is not None)
            for joint in joints
        ]
        actions.append(rviz(arguments, shown))
    if shows_rviz or arguments['robot_state_publisher'] == 'true':
        actions += [
            robot_state_publisher(
                arguments,
                unit_description(
                    joint.design_file, joint.names, f'{joint.namespace}/unit', joint.base_turn
                ),
                joint.namespace,
                joint.joint_state_topic,
            )
            for joint in joints
        ]
    markers = {'markers': True} if shows_rviz else {}
    actions += [
        node(arguments, joint, 'estimator', joint.estimator_parameters() | markers)
        for joint in joints
    ]
    if arguments['simulate'] == 'true':
        actions += [
            node(arguments, joint, 'pulley_driver', joint.driver_parameters()) for joint in joints
        ]
    return actions


def node(arguments, joint, name, parameters):
    return own_node(
        arguments,
        name,
        joint.namespace,
        # What else the design file holds for /** goes to both nodes too.
        parameters=[str(joint.design_file), as_they_are(parameters)],
        remappings=list(joint.remappings.items()),
        # Where security is enabled; elsewhere it is a mere name.
        ros_arguments=['--enclave', f'/tendon_statics/{joint.namespace}/{name}'],
    )
