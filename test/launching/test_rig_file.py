"""`load_rig`: joints with all that the launch file needs, and errors that name key and value."""

import math
from pathlib import Path
from xml.etree import ElementTree

import pytest
from designs import PRELIMINARY

from tendon_statics import default_design_path
from tendon_statics.files.installed_files import installed_config
from tendon_statics.launching.rig_file import RigFileError, load_rig

MINIMAL = '- namespace: left\n  design_file: unit.yaml\n'


@pytest.fixture
def folder(tmp_path):
    """A folder with a design and a recording in it."""
    design = default_design_path().read_text(encoding='utf-8')
    (tmp_path / 'unit.yaml').write_text(design, encoding='utf-8')
    (tmp_path / 'run.csv').write_text('tension_l,tension_s\n1,2\n')
    return tmp_path


def write(folder: Path, text: str) -> Path:
    path = folder / 'rig.yaml'
    path.write_text(text, encoding='utf-8')
    return path


def load(folder: Path, text: str):
    return load_rig(write(folder, text))


def test_the_least_that_a_joint_needs(folder):
    (joint,) = load(folder, MINIMAL)
    assert joint.namespace == 'left'
    assert joint.design == PRELIMINARY
    assert joint.joint_state_topic == 'estimator/joint_state'
    assert joint.remappings == {}
    estimator = joint.estimator_parameters()
    assert estimator['design.mass'] == PRELIMINARY.mass
    assert estimator['tension_source'] == 'array'
    assert estimator['frame_id'] == 'left/joint'
    assert estimator['joint_name'] == 'left'
    assert joint.driver_parameters() == {'tension_source': 'array'}


def test_all_that_a_joint_can_have(folder):
    (joint,) = load(
        folder,
        MINIMAL
        + """
  tension_source: joint_state
  parameters:
    cable_names: [a, b]
    cable_l: {gain: 2, bias: 1e-2}
    cable_s.gain: -1.5
    frame_id: world
    joint_name: elbow
    markers: true
  remappings:
    tensions: actuators/measured_js
    ~/joint_state: statics/measured_js
  recording: run.csv
  simulation: {rate: 100, nan_burst_length: 3, noise_stddev: .nan}
""",
    )
    estimator, driver = joint.estimator_parameters(), joint.driver_parameters()
    for parameters in (estimator, driver):
        assert parameters['tension_source'] == 'joint_state'
        assert parameters['cable_names'] == ['a', 'b']
        assert parameters['cable_l.gain'] == 2
        assert parameters['cable_l.bias'] == 0.01
        assert parameters['cable_s.gain'] == -1.5
        assert parameters['markers'] is True
    assert joint.names == ('world', 'elbow')
    assert (estimator['frame_id'], estimator['joint_name']) == ('world', 'elbow')
    assert not {'rate', 'file', 'nan_burst_length'} & set(estimator)
    assert driver['file'] == str(folder / 'run.csv')
    assert driver['rate'] == 100
    assert type(driver['nan_burst_length']) is int
    assert joint.remappings['tensions'] == 'actuators/measured_js'
    assert joint.joint_state_topic == 'statics/measured_js'


def test_paths_start_from_the_folder_of_the_file_and_end_absolute(folder, monkeypatch):
    (folder / 'rigs').mkdir()
    text = f'{MINIMAL}  recording: ../run.csv\n'.replace('unit.yaml', str(folder / 'unit.yaml'))
    write(folder / 'rigs', text)
    monkeypatch.chdir(folder)
    (joint,) = load_rig('rigs/rig.yaml')
    assert joint.design_file == folder / 'unit.yaml'
    assert joint.recording.is_absolute()
    assert joint.recording.samefile(folder / 'run.csv')


@pytest.mark.parametrize('name', ['/**', '/arm/left/estimator', '/arm/*'])
def test_the_names_of_a_joint_may_stand_in_its_design_file(folder, name):
    with (folder / 'unit.yaml').open('a') as file:
        if name == '/**':
            file.write('    joint_name: elbow\n    frame_id: ball\n')
        else:
            file.write(f'{name}: {{ros__parameters: {{joint_name: elbow, frame_id: ball}}}}\n')
    text = MINIMAL.replace('left', 'arm/left')
    (joint,) = load(folder, text)
    names = ('arm/left/joint', 'arm_left') if name == '/arm/*' else ('ball', 'elbow')
    assert joint.names == names
    estimator = joint.estimator_parameters()
    assert (estimator['frame_id'], estimator['joint_name']) == names
    (joint,) = load(folder, text + '  parameters: {joint_name: mine}')
    assert joint.names == (names[0], 'mine')


def test_a_name_in_the_design_file_that_is_no_text_is_refused(folder):
    with (folder / 'unit.yaml').open('a') as file:
        file.write('    joint_name: 7\n')
    with pytest.raises(RigFileError, match=r'joint 1: design_file: .*unit\.yaml: joint_name is 7'):
        load(folder, MINIMAL)


@pytest.mark.parametrize(
    ('remapping', 'topic'),
    [
        ('~/joint_state: statics/measured_js', 'statics/measured_js'),
        ('estimator/joint_state: statics/measured_js', 'statics/measured_js'),
        ('/arm/left/estimator/joint_state: statics/measured_js', 'statics/measured_js'),
        ('~/joint_state: ~/angle', 'estimator/angle'),
        ('~/joint_state: /arm/left/angle', 'angle'),
        ('~/joint_state: /angle', '/angle'),
        ('~/joint_state: a, estimator/joint_state: b', 'a'),
        ('joint_state: a', 'estimator/joint_state'),
        ('/estimator/joint_state: a', 'estimator/joint_state'),
        ('tensions: a', 'estimator/joint_state'),
    ],
)
def test_the_joint_state_is_found_however_it_was_remapped(folder, remapping, topic):
    text = MINIMAL.replace('left', 'arm/left')
    (joint,) = load(folder, f'{text}  remappings: {{{remapping}}}')
    assert joint.joint_state_topic == topic


def test_joints_come_in_the_order_of_the_file(folder):
    namespaces = ['b', 'a', '/arm_1/c/']
    text = ''.join(MINIMAL.replace('left', namespace) for namespace in namespaces)
    assert [joint.namespace for joint in load(folder, text)] == ['b', 'a', 'arm_1/c']


def test_the_installed_example_has_one_joint_of_each_kind():
    joints = load_rig(installed_config('rig.yaml'))
    assert sorted(joint.tension_source for joint in joints) == [
        *('array', 'joint_state', 'wrench_pair')
    ]


ARM = MINIMAL.replace('unit.yaml', 'arm.yaml')


@pytest.fixture
def with_arm(folder):
    """The same folder with an arm of two such units in it, and a recording of its cables."""
    (folder / 'arm.yaml').write_text(
        'units: [{design_file: unit.yaml, length: 0.02}, {design_file: unit.yaml, length: 0.01}]\n'
        'cables: [{name: wl, side: l, last_unit: 2}, {name: ws, side: s, last_unit: 2}]\n'
    )
    (folder / 'arm_run.csv').write_text('wl;ws\n1,5;2\n')
    return folder


def test_an_arm_stands_in_a_rig_as_a_joint_does(with_arm):
    arm, unit = load(with_arm, ARM + MINIMAL.replace('left', 'right'))
    assert (arm.estimator, unit.estimator) == ('arm_estimator', 'estimator')
    assert arm.joint_state_topic == 'arm_estimator/joint_states'
    assert arm.parameter_files == []
    assert arm.estimator_parameters() == {
        'arm_file': str(with_arm / 'arm.yaml'),
        'tension_source': 'joint_state',
        'frame_id': 'left/base',
        'arm_name': 'left',
        'joint_names': ['left_joint_1', 'left_joint_2'],
    }
    assert arm.driver_parameters() == {
        'arm_file': str(with_arm / 'arm.yaml'),
        'tension_source': 'joint_state',
    }
    links = {link.get('name') for link in ElementTree.fromstring(arm.description()).iter('link')}
    assert links == {'left/base', 'left/unit_1', 'left/unit_2', 'left/tip'}


def test_what_an_arm_is_given_goes_to_its_nodes(with_arm):
    (arm,) = load(
        with_arm,
        ARM
        + """
  tension_source: array
  parameters:
    cables: {wl: {gain: 0.5}}
    frame_id: table
    joint_names: [shoulder, elbow]
    gravity_direction: [1.0, 0.0, -1.0]
  remappings: {~/joint_states: statics/measured_js}
  recording: arm_run.csv
""",
    )
    estimator = arm.estimator_parameters()
    assert estimator['cables.wl.gain'] == arm.driver_parameters()['cables.wl.gain'] == 0.5
    assert (estimator['frame_id'], estimator['tension_source']) == ('table', 'array')
    assert arm.joint_state_topic == 'statics/measured_js'
    assert arm.driver_parameters()['file'] == str(with_arm / 'arm_run.csv')
    robot = ElementTree.fromstring(arm.description())
    assert robot.find("joint[@name='elbow']") is not None
    assert robot.find("joint[@name='table_tilt']/origin").get('rpy').split()[1] == repr(
        math.atan2(1.0, 1.0)
    )


@pytest.mark.parametrize(
    ('text', 'key', 'named'),
    [
        ('  tension_source: wrench_pair', 'tension_source', ['of an arm is one of joint_state']),
        ('  recording: run.csv', 'recording', ['there is no column wl']),
        ('  parameters: {joint_names: [a]}', 'parameters', ['the arm has 2 joints']),
        ('  parameters: {arm_file: x}', 'parameters', ['its own: design_file']),
    ],
)
def test_what_does_not_fit_an_arm_is_said(with_arm, text, key, named):
    with pytest.raises(RigFileError) as raised:
        load(with_arm, ARM + text)
    assert raised.value.key == key
    for part in named:
        assert part in str(raised.value)


def test_an_arm_file_that_is_none_is_named(with_arm):
    path = with_arm / 'arm.yaml'
    path.write_text(path.read_text().replace('side: l', 'side: r'))
    with pytest.raises(RigFileError, match=r"design_file is 'arm.yaml': .*arm\.yaml: .*side"):
        load(with_arm, ARM)


@pytest.mark.parametrize(
    ('text', 'key', 'named'),
    [
        ('', '', ['not a list of joints']),
        ('[]', '', ['not a list of joints']),
        ('namespace: left', '', ['not a list of joints']),
        ('- [', '', ['not valid YAML']),
        ('- left', '', ["joint 1 is 'left'", 'namespace, design_file']),
        ('- design_file: unit.yaml', 'namespace', ['joint 1: namespace is missing']),
        ('- namespace: left', 'design_file', ['joint 1: design_file is missing']),
        (MINIMAL + '  colour: red', 'colour', ["colour is 'red'", 'no such key', 'remappings']),
        (MINIMAL + '  namespace: x', '', ['namespace is given a second time in line 3']),
        (MINIMAL * 2, 'namespace', ["joint 2: namespace is 'left'", 'another joint']),
        (
            MINIMAL + MINIMAL.replace('left', '/left/'),
            'namespace',
            ["joint 2: namespace is 'left'", 'another joint'],
        ),
        (
            MINIMAL.replace('left', '3rd'),
            'namespace',
            ["namespace is '3rd'", 'begin with a digit'],
        ),
        (MINIMAL.replace('left', '""'), 'namespace', ["namespace is ''"]),
        (MINIMAL.replace('left', 'a//b'), 'namespace', ["namespace is 'a//b'"]),
        (MINIMAL.replace('left', '7'), 'namespace', ['namespace is 7']),
        (MINIMAL.replace('unit', 'no'), 'design_file', ["is 'no.yaml'", 'cannot be read']),
        (MINIMAL.replace('unit.yaml', 'run.csv'), 'design_file', ['run.csv']),
        (MINIMAL.replace('unit.yaml', '[]'), 'design_file', ['is []', 'path of a file']),
        (
            MINIMAL + '  tension_source: can',
            'tension_source',
            ["tension_source is 'can'", 'array, joint_state, wrench_pair'],
        ),
        (MINIMAL + '  recording: no.csv', 'recording', ["is 'no.csv'", 'cannot be read']),
        (MINIMAL + '  recording: unit.yaml', 'recording', ['a recording ends in .csv']),
        (MINIMAL + '  parameters: [1]', 'parameters', ['is [1]', 'names of parameters']),
        (MINIMAL + '  parameters: {a: }', 'parameters', ['a is None', 'number, text']),
        (MINIMAL + '  parameters: {a: [1, b]}', 'parameters', ["a is [1, 'b']", 'one kind']),
        (MINIMAL + '  parameters: {a: []}', 'parameters', ['a is []']),
        (MINIMAL + '  parameters: {a: {b: 1}, a.b: 2}', 'parameters', ['a.b is given twice']),
        (MINIMAL + '  parameters: &a {b: *a}', 'parameters', ['is in itself']),
        *(
            (f'{MINIMAL}  {key}: {{{given}}}', key, [f'{name} does not', f'its own: {home}'])
            for key in ('parameters', 'simulation')
            for given, name, home in (
                ('design: {mass: 1}', 'design.mass', 'design_file'),
                ('design.mass: 1', 'design.mass', 'design_file'),
                ('tension_source: array', 'tension_source', 'tension_source'),
                ('recording: run.csv', 'recording', 'recording'),
                ('file: run.csv', 'file', 'recording'),
            )
        ),
        (MINIMAL + '  parameters: {joint_name: 7}', 'parameters', ['joint_name is 7', 'text']),
        (MINIMAL + "  parameters: {frame_id: ''}", 'parameters', ["frame_id is ''", 'not empty']),
        (MINIMAL + '  simulation: fast', 'simulation', ["is 'fast'"]),
        (MINIMAL + '  remappings: {tensions: 3}', 'remappings', ["{'tensions': 3}", 'mapping']),
        (MINIMAL + '  remappings: [a, b]', 'remappings', ['mapping of names']),
        *(
            (MINIMAL + f'  remappings: {{"{name}": x}}', 'remappings', [f"'{name}' is no name"])
            for name in (
                '__ns',
                'estimator:tensions',
                '{node}/joint_state',
                '~joint_state',
                'a//b',
            )
        ),
        (MINIMAL + '  remappings: {tensions: a b}', 'remappings', ["'a b' is no name"]),
    ],
)
def test_errors_name_file_joint_key_value_and_what_is_allowed(folder, text, key, named):
    path = write(folder, text)
    with pytest.raises(RigFileError) as raised:
        load_rig(path)
    message = str(raised.value)
    assert message.startswith(f'{path}: ')
    assert '\n' not in message
    assert raised.value.key == key
    for part in named:
        assert part in message


def test_a_design_that_is_not_valid_is_named_with_its_own_key(folder):
    text = (folder / 'unit.yaml').read_text().replace('mass: 0.0', 'mass: -0.0')
    (folder / 'unit.yaml').write_text(text)
    with pytest.raises(RigFileError, match=r'unit\.yaml: design\.mass is -0\.0.* 0 to 100 kg'):
        load(folder, MINIMAL)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(RigFileError, match=r'missing\.yaml: it cannot be read'):
        load_rig(tmp_path / 'missing.yaml')
