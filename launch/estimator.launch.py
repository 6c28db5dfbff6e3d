"""Start one estimator; `ros2 launch tendon_statics estimator.launch.py -s` has its arguments."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch_ros.utilities import make_namespace_absolute, prefix_namespace

from tendon_statics.launching.actions import (
    as_they_are,
    declared_node_arguments,
    declared_rviz,
    own_node,
    robot_state_publisher,
    rviz,
)
from tendon_statics.launching.base_turn import load_base_turn
from tendon_statics.launching.description import unit_description
from tendon_statics.launching.joint_names import JointNames, load_joint_names
from tendon_statics.launching.node_arguments import tension_remappings
from tendon_statics.launching.rviz import Shown


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
                default_value='',
                description='topic of tensions, of both cables; default: tensions',
            ),
            *(
                DeclareLaunchArgument(
                    f'tension_{cable}',
                    default_value='',
                    description=f'topic of the load cell of cable {cable}, with tension_source '
                    f'wrench_pair; default: tension_{cable}',
                )
                for cable in ('l', 's')
            ),
            DeclareLaunchArgument(
                'robot_state_publisher',
                default_value='false',
                choices=['true', 'false'],
                description='whether a robot_state_publisher shows the unit in RViz',
            ),
            *declared_node_arguments(),
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
    remappings = tension_remappings(arguments, params_file, node)
    actions = []
    shows_rviz = arguments['rviz'] == 'true'
    # First, since it may be missing, and launch leaves running what it has started by then.
    if shows_rviz or arguments['robot_state_publisher'] == 'true':
        turn = load_base_turn(params_file, node)
        description = unit_description(params_file, names, base_turn=turn)
        if shows_rviz:
            shown = Shown(full_namespace.strip('/'), names.frame_id, turn is not None)
            actions.append(rviz(arguments, [shown]))
        actions.append(robot_state_publisher(arguments, description, namespace))
    actions.append(
        own_node(
            arguments,
            'estimator',
            namespace,
            parameters=[
                params_file,
                as_they_are(names._asdict()),
                *([{'markers': True}] if shows_rviz else []),
            ],
            remappings=remappings,
        )
    )
    return actions
