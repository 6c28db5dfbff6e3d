"""Start one estimator; arguments: namespace, params_file, tensions, robot_state_publisher."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from tendon_statics.launch_actions import robot_state_publisher


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
            # First, since xacro may fail, and launch leaves running what it has started by then.
            robot_state_publisher(
                LaunchConfiguration('params_file'),
                LaunchConfiguration('namespace'),
                condition=IfCondition(LaunchConfiguration('robot_state_publisher')),
            ),
            Node(
                package='tendon_statics',
                executable='estimator',
                name='estimator',
                namespace=LaunchConfiguration('namespace'),
                parameters=[LaunchConfiguration('params_file')],
                remappings=[('tensions', LaunchConfiguration('tensions'))],
                output='screen',
            ),
        ]
    )
