"""`check_form`: a parameter file that ROS would refuse, with the line and what to do."""

import pytest
import rclpy
from rclpy.context import Context

from tendon_statics.files.parameter_file import node_parameters, read_parameters
from tendon_statics.files.parameter_form import ParameterFileError

REFUSED = {
    'broken': ('/**:\n  ros__parameters: [', 'it is not valid YAML in line 2'),
    'a tab': ('/**:\n\tros__parameters:\n', 'it is not valid YAML in line 2'),
    'a list': ('- a\n- b\n', 'it is no parameter file: parameters stand under the name of a node'),
    'no node': ('ros__parameters:\n  a: 1\n', 'ros__parameters in line 1 has no node'),
    'no block': ('design:\n  mass: 1.0\n', 'mass in line 2 is not below ros__parameters'),
    'no indent': ('/**:\nros__parameters:\n  a: 1\n', '/** in line 1 is not below'),
    'nothing below': ('/**:\n  ros__parameters: 3\n', 'ros__parameters in line 2 has no param'),
    'a blank in a name': (
        'my node:\n  ros__parameters:\n    a: 1\n',
        'my node in line 1 is no name of a node',
    ),
    'no value': ('/**:\n  ros__parameters:\n    a: 1\n    b:\n', 'b in line 4 has no value'),
    'two kinds of numbers': (
        '/**:\n  ros__parameters:\n    a: [0, 0.5]\n',
        'a in line 3 has whole and other numbers, which ROS does not mix: write [0.0, 0.5]',
    ),
    'two kinds': (
        "/**:\n  ros__parameters:\n    a: [0, 'b']\n",
        "a in line 3 is [0, 'b'], but",
    ),
}
TAKEN = {
    'nothing': '',
    'no parameters': '/**:\n  ros__parameters: {}\n',
    'wildcards': '/*/estimator:\n  ros__parameters: {a: 1}\n/**/driver:\n  ros__parameters: {}\n',
    'nested': 'left:\n  wrist:\n    estimator:\n      ros__parameters: {a: {b: [1, 2]}}\n',
    'a list as launch_ros writes it': (
        '/**:\n  ros__parameters:\n    a: !!python/tuple\n    - b\n    - c\n'
    ),
    'kinds': '/**:\n  ros__parameters: {a: [u, v], b: [true], c: 1.5, d: "", e: []}\n',
}


def starts_ros(path) -> bool:
    context = Context()
    try:
        rclpy.init(args=['--ros-args', '--params-file', str(path)], context=context)
    except RuntimeError:
        return False
    context.shutdown()
    return True


@pytest.mark.parametrize('case', REFUSED)
def test_what_ros_refuses_is_refused_with_the_line(case, tmp_path):
    text, named = REFUSED[case]
    path = tmp_path / 'unit.yaml'
    path.write_text(text)
    with pytest.raises(ParameterFileError) as raised:
        read_parameters(path)
    assert str(raised.value).startswith(named)
    assert not starts_ros(path)


@pytest.mark.parametrize('case', TAKEN)
def test_what_ros_takes_is_taken(case, tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text(TAKEN[case])
    read_parameters(path)
    assert starts_ros(path)


def test_a_list_of_launch_ros_is_a_list(tmp_path):
    path = tmp_path / 'launch_params'
    path.write_text(TAKEN['a list as launch_ros writes it'])
    assert node_parameters(read_parameters(path), '/estimator') == {'a': ['b', 'c']}


def test_a_file_for_others_is_refused_with_their_lines(tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text('/winch:\n  ros__parameters: {a: 1}\nleft:\n  b:\n    ros__parameters: {}\n')
    named = 'it is addressed to /winch in line 1, /left/b in line 4, so /estimator takes nothing'
    with pytest.raises(ParameterFileError, match=named):
        node_parameters(read_parameters(path), '/estimator')
