"""The installed xacro of a unit: valid URDF with the numbers of the design, as the estimator's."""

import dataclasses
import random
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import xacro
import yaml
from ament_index_python.packages import get_package_share_directory
from designs import PRELIMINARY, random_design
from geometry_msgs.msg import PoseWithCovarianceStamped
from scipy.spatial.transform import Rotation
from std_msgs.msg import Header

from tendon_statics import Load
from tendon_statics.estimation.orientation import roll_and_pitch
from tendon_statics.node.outputs.messages import fill_unit_pose

URDF = Path(get_package_share_directory('tendon_statics'), 'urdf')

_draw = random.Random(3)
DESIGNS = [
    PRELIMINARY,
    dataclasses.replace(PRELIMINARY, com_distance=-0.02),
    dataclasses.replace(PRELIMINARY, com_distance=0.0),
    *(random_design(_draw) for _ in range(3)),
]


def design_file(folder, design, node='/**'):
    path = folder / 'unit.yaml'
    path.write_text(yaml.dump({node: {'ros__parameters': {'design': dataclasses.asdict(design)}}}))
    return path


def description(path=URDF / 'unit.urdf.xacro', **arguments):
    """Expand a xacro and read what comes."""
    return ElementTree.fromstring(xacro.process(str(path), mappings=arguments))


def vector(element, attribute='xyz'):
    return np.array([float(part) for part in element.get(attribute).split()])


def centre_of_gravity(robot, bend_angle):
    """Position and orientation of the inertial frame in the parent, by the rules of URDF."""
    joint, inertial = robot.find('joint'), robot.find('link/inertial')
    at_zero = Rotation.from_euler('xyz', vector(joint.find('origin'), 'rpy'))
    turned = at_zero * Rotation.from_rotvec(bend_angle * vector(joint.find('axis')))
    arm = turned.apply(vector(inertial.find('origin')))
    return vector(joint.find('origin')) + arm, turned


@pytest.mark.parametrize('design', DESIGNS)
def test_the_centre_of_gravity_is_where_the_estimator_says(design, tmp_path):
    robot = description(design_file=str(design_file(tmp_path, design)))
    for bend_angle in np.linspace(-design.max_bend_angle, design.max_bend_angle, 7):
        position, turned = centre_of_gravity(robot, bend_angle)
        pose = fill_unit_pose(
            PoseWithCovarianceStamped(), design, bend_angle, 0.0, Header()
        ).pose.pose
        expected = (pose.position.x, pose.position.y, pose.position.z)
        assert position == pytest.approx(expected, abs=1e-15)
        o = pose.orientation
        difference = Rotation.from_quat([o.x, o.y, o.z, o.w]).inv() * turned
        assert difference.magnitude() == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize('design', DESIGNS)
def test_it_has_the_numbers_of_the_design_and_a_possible_inertia(design, tmp_path):
    robot = description(design_file=str(design_file(tmp_path, design)))
    limit = robot.find('joint/limit')
    assert float(limit.get('lower')) == -design.max_bend_angle
    assert float(limit.get('upper')) == design.max_bend_angle
    # With 0 a planner or simulator would not move it.
    lever = design.ball_radius + design.cable_offset
    assert float(limit.get('effort')) == pytest.approx(1000.0 * lever)
    assert float(limit.get('velocity')) > 0.0
    inertial = robot.find('link/inertial')
    assert float(inertial.find('mass').get('value')) == design.mass
    assert vector(inertial.find('origin')).tolist() == [0.0, 0.0, design.com_distance]
    entries = {name: float(value) for name, value in inertial.find('inertia').items()}
    assert {name for name in entries if entries[name] != 0.0} == {'ixx', 'iyy', 'izz'}
    smallest, middle, largest = sorted((entries['ixx'], entries['iyy'], entries['izz']))
    assert smallest > 0.0
    assert largest <= smallest + middle
    ball, body = robot.findall('link/visual')
    assert float(ball.find('geometry/sphere').get('radius')) == design.ball_radius
    radius = float(body.find('geometry/cylinder').get('radius'))
    assert radius == pytest.approx(design.ball_radius + design.cable_offset)
    assert float(body.find('geometry/cylinder').get('length')) >= 2.0 * abs(design.com_distance)


def test_the_names_are_those_of_the_estimator_unless_others_are_given():
    def names(robot):
        joint = robot.find('joint')
        links = [link.get('name') for link in robot.iter('link')]
        return links, joint.get('name'), joint.find('parent').get('link')

    assert names(description()) == (['joint', 'unit'], 'bend', 'joint')
    other = description(name='left/unit', parent='left/joint', joint_name='left_bend')
    assert names(other) == (['left/joint', 'left/unit'], 'left_bend', 'left/joint')


def test_without_a_file_it_is_the_preliminary_design():
    assert float(description().find('link/inertial/mass').get('value')) == PRELIMINARY.mass


def test_the_design_may_stand_under_a_node_and_its_numbers_be_those_of_ros(tmp_path):
    """YAML 1.1 takes 8e-3 for text, ROS for a number."""
    path = design_file(tmp_path, PRELIMINARY, node='estimator')
    path.write_text(path.read_text().replace('com_distance: 0.008', 'com_distance: 8e-3'))
    robot = description(design_file=str(path))
    assert vector(robot.find('link/inertial/origin'))[2] == 0.008


def test_a_unit_without_mass_has_no_inertia(tmp_path):
    design = dataclasses.replace(PRELIMINARY, mass=0.0)
    robot = description(design_file=str(design_file(tmp_path, design)))
    assert robot.find('link/inertial') is None


def test_the_joint_is_tilted_in_a_base_whose_z_is_up():
    """Gravity points in the joint's frame as it does in that of the estimator."""
    load = Load((0.3, -0.2, -0.9))
    roll, pitch = roll_and_pitch(load.gravity_direction)
    robot = description(base='base', base_roll=repr(roll), base_tilt=repr(pitch))
    joint = robot.find("joint[@name='joint_tilt']")
    assert (joint.find('parent').get('link'), joint.find('child').get('link')) == ('base', 'joint')
    turn = Rotation.from_euler('xyz', vector(joint.find('origin'), 'rpy'))
    assert turn.inv().apply([0.0, 0.0, -1.0]) == pytest.approx(load.gravity_direction)
    tilted = roll_and_pitch(Load.tilted(0.4).gravity_direction)
    assert tilted == pytest.approx((0.0, 0.4))


def test_a_robot_can_have_two_of_them(tmp_path):
    path = tmp_path / 'robot.urdf.xacro'
    hanging = design_file(tmp_path, dataclasses.replace(PRELIMINARY, com_distance=-0.02))
    path.write_text(f"""
        <robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">
          <xacro:include filename="$(find tendon_statics)/urdf/tendon_unit.xacro"/>
          <link name="base"/>
          <xacro:tendon_unit name="a" parent="base" joint_name="bend_a"
            design_file="$(find tendon_statics)/config/preliminary_design.yaml"/>
          <xacro:tendon_unit name="b" parent="a" joint_name="bend_b" design_file="{hanging}"
            max_tension="20" max_velocity="2.5"/>
        </robot>""")
    robot = description(path)
    assert [link.get('name') for link in robot.iter('link')] == ['base', 'a', 'b']
    assert [joint.find('parent').get('link') for joint in robot.iter('joint')] == ['base', 'a']
    limit = robot.findall('joint/limit')[1]
    assert float(limit.get('effort')) == pytest.approx(
        20.0 * (PRELIMINARY.ball_radius + PRELIMINARY.cable_offset)
    )
    assert float(limit.get('velocity')) == 2.5
    heights = [vector(origin)[2] for origin in robot.findall('link/inertial/origin')]
    assert heights == [PRELIMINARY.com_distance, -0.02]
