"""`load_joint_names`: the names that ROS gives the estimator from a parameter file."""

import pytest
from list_entities import alone

from tendon_statics.launching.joint_names import JointNameError, JointNames, load_joint_names
from tendon_statics.node.estimator import Estimator

BLOCKS = {
    'any': '/**:\n  ros__parameters: {joint_name: any, frame_id: ball}\n',
    'own': '/arm/estimator:\n  ros__parameters: {joint_name: own}\n',
    'nested': 'arm:\n  estimator:\n    ros__parameters: {joint_name: nested}\n',
    'one part': '/*/estimator:\n  ros__parameters: {joint_name: one part}\n',
    'any part': '/**/estimator:\n  ros__parameters: {joint_name: any part}\n',
    'two parts': '/*/*/estimator:\n  ros__parameters: {joint_name: two parts}\n',
    'without namespace': 'estimator:\n  ros__parameters: {joint_name: without namespace}\n',
    'other': '/arm/driver:\n  ros__parameters: {joint_name: other}\n',
    'mass': '/arm/*:\n  ros__parameters: {tension_stddev: 0.1}\n',
}


@pytest.mark.parametrize('namespace', ['', '/arm'])
@pytest.mark.parametrize(
    'blocks',
    [
        *((name,) for name in BLOCKS),
        *(('any', 'own'), ('own', 'any'), ('one part', 'nested'), ('nested', 'any part', 'other')),
    ],
    ids=' then '.join,
)
def test_they_are_those_that_the_estimator_takes(blocks, namespace, tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text(''.join(BLOCKS[name] for name in blocks))
    names = load_joint_names(path, f'{namespace}/estimator', JointNames())
    remapping = ('-r', f'__ns:={namespace}') if namespace else ()
    with alone(Estimator, '--params-file', str(path), *remapping) as node:
        taken = [node.get_parameter(name).value for name in JointNames._fields]
    assert names == tuple(taken)


@pytest.mark.parametrize(
    ('text', 'named'),
    [
        ('joint_name: 7', 'joint_name is 7, but a text'),
        ('joint_name: on', 'joint_name is True, but a text'),
        ("frame_id: ''", "frame_id is '', but a text that is not empty"),
        ('frame_id: [a]', r"frame_id is \['a'\], but a text"),
    ],
)
def test_what_is_no_name_is_refused(text, named, tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text(f'/**:\n  ros__parameters:\n    {text}\n')
    with pytest.raises(JointNameError, match=rf'unit\.yaml: {named}'):
        load_joint_names(path, '/estimator', JointNames())


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(JointNameError, match=r'missing\.yaml: it cannot be read'):
        load_joint_names(tmp_path / 'missing.yaml', '/estimator', JointNames())
