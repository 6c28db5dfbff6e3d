"""`unit_description` and `arm_description`: URDF with the names of the nodes."""

import math
import sys
from xml.etree import ElementTree

import pytest

from tendon_statics import default_design_path
from tendon_statics.launching.base_turn import BaseTurnError, load_base_turn
from tendon_statics.launching.description import DescriptionError, unit_description
from tendon_statics.launching.joint_names import JointNames


def test_it_has_the_names_that_it_is_given(tmp_path):
    """Also from a file whose name has spaces and quotes."""
    path = tmp_path / 'my "left" unit.yaml'
    path.write_text(default_design_path().read_text())
    names = JointNames(frame_id='left/joint', joint_name='elbow')
    robot = ElementTree.fromstring(unit_description(path, names, unit='left/unit'))
    joint = robot.find('joint')
    assert joint.get('name') == 'elbow'
    assert joint.find('parent').get('link') == 'left/joint'
    assert joint.find('child').get('link') == 'left/unit'
    assert [link.get('name') for link in robot.iter('link')] == ['left/joint', 'left/unit']


def test_the_base_is_tilted_as_the_parameters_say(tmp_path):
    path = tmp_path / 'unit.yaml'
    text = default_design_path().read_text()
    path.write_text(text + '    gravity_direction: [0.1736481776669303, 0, -0.984807753012208]\n')
    turn = load_base_turn(path, '/estimator')
    assert turn == pytest.approx((0.0, math.radians(10.0)))
    robot = ElementTree.fromstring(unit_description(path, JointNames(), base_turn=turn))
    links = [link.get('name') for link in robot.iter('link')]
    assert links == ['joint', 'joint_base', 'unit']
    # Where a sensor tells it, its transform does.
    assert load_base_turn(path, '/estimator', {'gravity_source': 'imu'}) is None
    assert load_base_turn(default_design_path(), '/estimator') is None
    with pytest.raises(
        BaseTurnError, match=r'unit\.yaml: gravity_direction is \[0, 0, 0\]|length'
    ):
        load_base_turn(path, '/estimator', {'gravity_direction': [0, 0, 0]})


def test_a_relative_path_starts_from_where_the_user_is(tmp_path, monkeypatch):
    (tmp_path / 'unit.yaml').write_text(default_design_path().read_text())
    monkeypatch.chdir(tmp_path)
    assert '<robot' in unit_description('unit.yaml', JointNames())


def test_a_missing_xacro_is_one_line_that_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, 'xacro', None)
    monkeypatch.delenv('ROS_DISTRO', raising=False)
    with pytest.raises(DescriptionError) as raised:
        unit_description(default_design_path(), JointNames())
    assert 'xacro, which makes the description' in str(raised.value)
    assert 'apt install ros-jazzy-xacro' in str(raised.value)
    assert '\n' not in str(raised.value)


def test_a_file_without_a_design_is_named_in_one_line(tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text('/**:\n  ros__parameters:\n    joint_name: elbow\n')
    with pytest.raises(
        DescriptionError, match=r'unit\.yaml: xacro makes no description'
    ) as raised:
        unit_description(path, JointNames())
    assert '\n' not in str(raised.value)
