"""The installed xacro of an arm: valid URDF whose tip and masses are where the arm has them."""

import dataclasses
import random
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml
from arm_brute import random_arm
from make_docs import ROOT
from scipy.spatial.transform import Rotation

from tendon_statics import ArmTracker, default_design_path, load_arm
from tendon_statics.launching.description import DescriptionError, arm_description
from tendon_statics.physics.arm.shape import joint_centres, tip_pose

FILE = ROOT / 'config/arm.yaml'


def arm_file(folder, arm):
    content = {
        'units': [
            {'design': dataclasses.asdict(unit.design), 'length': unit.length}
            for unit in arm.units
        ],
        'cables': [dataclasses.asdict(cable) for cable in arm.cables],
    }
    for cable in content['cables']:
        if cable['offset'] is None:
            del cable['offset']
    path = folder / 'arm.yaml'
    path.write_text(yaml.safe_dump(content))
    return path


def vector(element, attribute='xyz'):
    return np.array([float(part) for part in element.get(attribute).split()])


def link_poses(robot, angles, start='base'):
    """Position and turn of every link in the first, by the rules of URDF."""
    poses = {start: (np.zeros(3), Rotation.identity())}
    for joint in robot.iter('joint'):
        at, turn = poses[joint.find('parent').get('link')]
        origin = joint.find('origin')
        own = Rotation.from_euler('xyz', vector(origin, 'rpy'))
        if joint.get('type') == 'revolute':
            own = own * Rotation.from_rotvec(
                angles[joint.get('name')] * vector(joint.find('axis'))
            )
        poses[joint.find('child').get('link')] = (at + turn.apply(vector(origin)), turn * own)
    return poses


@pytest.mark.parametrize('seed', range(5))
def test_joints_and_tip_are_where_the_arm_has_them(seed, tmp_path):
    draw = random.Random(seed)
    arm = random_arm(draw)
    robot = ElementTree.fromstring(arm_description(arm_file(tmp_path, arm)))
    angles = tuple(draw.uniform(-stop, stop) for stop in arm.stops)
    poses = link_poses(robot, {f'arm_joint_{n}': angle for n, angle in enumerate(angles, start=1)})
    names = [f'arm_unit_{number}' for number in range(1, len(angles) + 1)] + ['arm_tip']
    for name, (x, z) in zip(names, joint_centres(arm, angles), strict=True):
        assert poses[name][0] == pytest.approx([x, 0.0, z], abs=1e-15)
    tilt = tip_pose(arm, angles).tilt
    assert poses['arm_tip'][1].apply([0.0, 0.0, 1.0]) == pytest.approx(
        [np.sin(tilt), 0, np.cos(tilt)]
    )


def test_the_tip_is_that_of_the_tracker():
    arm = load_arm(FILE)
    tracker = ArmTracker(arm)
    state = tracker.update({'l_mid': 1.0, 's_mid': 1.0, 'l_tip': 1.0, 's_tip': 2.2})
    robot = ElementTree.fromstring(arm_description(FILE))
    angles = {f'arm_joint_{n}': angle for n, angle in enumerate(state.bend_angles, start=1)}
    assert min(angles.values()) != max(angles.values())
    position, _ = link_poses(robot, angles)['arm_tip']
    assert position == pytest.approx([state.tip.x, 0.0, state.tip.z], abs=1e-15)


@pytest.mark.parametrize('seed', range(5))
def test_the_tip_of_any_arm_at_any_angles_is_that_of_the_tracker(seed, tmp_path):
    draw = random.Random(70 + seed)
    arm = random_arm(draw)
    tracker = ArmTracker(arm, [draw.uniform(-stop, stop) for stop in arm.stops])
    state = tracker.update(dict.fromkeys(arm.cable_names, 50.0))
    robot = ElementTree.fromstring(arm_description(arm_file(tmp_path, arm)))
    angles = {f'arm_joint_{n}': angle for n, angle in enumerate(state.bend_angles, start=1)}
    position, turn = link_poses(robot, angles)['arm_tip']
    assert position == pytest.approx([state.tip.x, 0.0, state.tip.z], abs=1e-15)
    along = np.sin(state.tip.tilt), 0.0, np.cos(state.tip.tilt)
    assert turn.apply([0.0, 0.0, 1.0]) == pytest.approx(along)


def test_every_unit_has_its_own_design_stop_and_effort():
    arm = load_arm(FILE)
    robot = ElementTree.fromstring(arm_description(FILE))
    links = [link for link in robot.iter('link') if link.find('inertial') is not None]
    joints = [joint for joint in robot.iter('joint') if joint.get('type') == 'revolute']
    assert len(links) == len(joints) == 5
    for link, joint, unit, pulling in zip(links, joints, arm.units, (2, 2, 2, 1, 1), strict=True):
        design = unit.design
        assert float(link.find('inertial/mass').get('value')) == design.mass
        assert vector(link.find('inertial/origin')).tolist() == [0.0, 0.0, design.com_distance]
        assert float(link.find('visual/geometry/cylinder').get('length')) == unit.length
        limit = joint.find('limit')
        assert float(limit.get('upper')) == design.max_bend_angle
        lever = design.ball_radius + design.cable_offset
        assert float(limit.get('effort')) == pytest.approx(pulling * 1000.0 * lever)
    for before, joint in pairwise(joints):
        assert joint.find('parent').get('link') == before.find('child').get('link')


def test_a_design_file_is_found_from_where_the_arm_file_is(tmp_path, monkeypatch):
    folder = tmp_path / 'my "own" arm'
    folder.mkdir()
    (folder / 'unit.yaml').write_text(default_design_path().read_text())
    (folder / 'arm.yaml').write_text(
        'units: [{design_file: unit.yaml, length: 2e-2}]\n'
        'cables: [{name: l, side: l, last_unit: 1}, {name: s, side: s, last_unit: 1}]\n'
    )
    monkeypatch.chdir(folder)
    robot = ElementTree.fromstring(arm_description('arm.yaml'))
    mass = load_arm('arm.yaml').designs[0].mass
    assert float(robot.find('link/inertial/mass').get('value')) == mass
    assert vector(robot.find("joint[@name='arm_tip_end']/origin"))[2] == 0.02


def test_names_are_those_that_are_given():
    names = [f'j{number}' for number in range(5)]
    robot = ElementTree.fromstring(arm_description(FILE, 'left/base', names, 'left/'))
    joints = [joint.get('name') for joint in robot.iter('joint')]
    assert joints == [*names, 'left/tip_end']
    links = [link.get('name') for link in robot.iter('link')]
    assert links == ['left/base', *(f'left/unit_{n}' for n in range(1, 6)), 'left/tip']
    with pytest.raises(DescriptionError, match='5 units and 2 joint_names'):
        arm_description(FILE, joint_names=names[:2])


def test_a_tilted_base_has_its_own_frame_with_z_up():
    robot = ElementTree.fromstring(arm_description(FILE, base_turn=(0.0, 0.4)))
    joint = robot.find("joint[@name='base_tilt']")
    assert joint.find('parent').get('link') == 'base_base'
    assert vector(joint.find('origin'), 'rpy').tolist() == [0.0, 0.4, 0.0]


def test_a_robot_can_carry_an_arm(tmp_path):
    import xacro

    path = tmp_path / 'robot.urdf.xacro'
    path.write_text("""
        <robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">
          <xacro:include filename="$(find tendon_statics)/urdf/tendon_arm.xacro"/>
          <link name="base"/>
          <xacro:tendon_arm arm_file="$(find tendon_statics)/config/arm.yaml" parent="base"
            prefix="a_" max_tension="20"/>
          <xacro:tendon_arm arm_file="$(find tendon_statics)/config/arm.yaml" parent="a_tip"
            prefix="b_"/>
        </robot>""")
    robot = ElementTree.fromstring(xacro.process(str(path)))
    poses = link_poses(
        robot, dict.fromkeys((joint.get('name') for joint in robot.iter('joint')), 0)
    )
    length = sum(unit.length for unit in load_arm(FILE).units)
    assert poses['b_tip'][0] == pytest.approx([0.0, 0.0, 2.0 * length])
