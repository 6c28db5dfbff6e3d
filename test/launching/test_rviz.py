"""RViz, PlotJuggler and Foxglove are told of topics and fields that the node publishes."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from ament_index_python.packages import PackageNotFoundError, get_package_prefix
from list_entities import arm_estimator, entities, estimator
from tendon_statics_interfaces.msg import ArmEstimate, Estimate, JointRegimes

from tendon_statics import load_arm
from tendon_statics.files.installed_files import installed_config
from tendon_statics.launching.rig_file import load_rig
from tendon_statics.launching.rviz import RvizError, Shown, rviz_arguments, rviz_config

SHARE = installed_config('rig.yaml').parents[1]
ALONE = Shown('', 'joint')


def published(node):
    """Topic → type."""
    return {
        name.replace('~', node.get_fully_qualified_name()): kind.replace('/msg/', '/')
        for name, kind in entities(node)['publisher'].items()
    }


@pytest.fixture(scope='module')
def topics():
    """Those of an estimator without a namespace."""
    with estimator('markers:=true') as node:
        return published(node)


@pytest.fixture(scope='module')
def arm_topics():
    """Those of an arm's."""
    with arm_estimator('markers:=true') as node:
        return published(node)


def displays(config, kind):
    return [
        display
        for display in config['Visualization Manager']['Displays']
        if display['Class'] == f'rviz_default_plugins/{kind}'
    ]


def test_rviz_shows_the_markers_and_the_description_of_the_unit(topics):
    config = rviz_config([ALONE])
    (markers,), (model,) = displays(config, 'MarkerArray'), displays(config, 'RobotModel')
    assert topics[markers['Topic']['Value']] == 'visualization_msgs/MarkerArray'
    assert model['Description Topic']['Value'] == '/robot_description'
    # What is said once has to be kept for who comes later.
    assert model['Description Topic']['Durability Policy'] == 'Transient Local'
    with estimator() as node:
        frame = node.get_parameter('frame_id').value
    assert config['Visualization Manager']['Global Options']['Fixed Frame'] == frame


def test_rviz_shows_every_joint_of_a_rig_in_the_frame_of_the_first():
    joints = load_rig(installed_config('rig.yaml'))
    config = rviz_config([Shown(joint.namespace, joint.names.frame_id) for joint in joints])
    for kind, key, topic in (
        ('MarkerArray', 'Topic', 'estimator/markers'),
        ('RobotModel', 'Description Topic', 'robot_description'),
    ):
        shown = displays(config, kind)
        values = [display[key]['Value'] for display in shown]
        assert values == [f'/{joint.namespace}/{topic}' for joint in joints]
        assert len({display['Name'] for display in shown}) == len(joints)
    options = config['Visualization Manager']['Global Options']
    assert options['Fixed Frame'] == joints[0].names.frame_id


def test_an_arm_is_shown_by_the_markers_of_its_own_node():
    config = rviz_config([Shown('snake', 'snake/base', estimator='arm_estimator')])
    (markers,) = displays(config, 'MarkerArray')
    with arm_estimator('markers:=true') as node:
        (topic,) = (name for name in entities(node)['publisher'] if name.endswith('markers'))
    assert markers['Topic']['Value'] == topic.replace('~', '/snake/arm_estimator')
    assert config['Visualization Manager']['Global Options']['Fixed Frame'] == 'snake/base'


def test_a_tilted_base_is_shown_tilted():
    config = rviz_config([Shown('', 'ball', has_base=True)])
    assert config['Visualization Manager']['Global Options']['Fixed Frame'] == 'ball_base'


@pytest.mark.parametrize(
    ('distro', 'package'),
    [('', 'ros-jazzy-rviz2'), ('jazzy', 'ros-jazzy-rviz2'), ('kilted', 'ros-kilted-rviz2')],
)
def test_missing_rviz_is_said_in_a_line_with_the_remedy(distro, package, monkeypatch):
    def missing(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr('tendon_statics.launching.rviz.get_package_prefix', missing)
    monkeypatch.setenv('ROS_DISTRO', distro)
    with pytest.raises(RvizError, match=f'apt install {package}$'):
        rviz_arguments([ALONE])


def test_rviz_is_given_a_file_of_its_own(monkeypatch, tmp_path):
    monkeypatch.setattr('tendon_statics.launching.rviz.get_package_prefix', get_own_prefix)
    monkeypatch.setattr('tempfile.tempdir', str(tmp_path))
    option, path = rviz_arguments([Shown('left', 'left/joint')])
    assert option == '-d'
    assert '/left/estimator/markers' in Path(path).read_text(encoding='utf-8')


def get_own_prefix(_name):
    return get_package_prefix('tendon_statics')


FIELDS = {
    f'tendon_statics_interfaces/{message.__name__}': message.get_fields_and_field_types()
    for message in (Estimate, ArmEstimate, JointRegimes)
}
FIELDS['std_msgs/String'] = {'data': 'string'}


def assert_is_published(path, topics):
    """Assert that a topic of the estimator has the field at the end of a path, if it has one."""
    match = re.fullmatch(r'(/[\w/]+?)(?:[/.](\w+)(\[\d+\])?)?', path)
    topic, field, index = match.groups()
    if path in topics:
        return
    assert topic in topics, path
    kind = FIELDS[topics[topic]][field]
    assert bool(index) == kind.startswith('sequence<'), path


PLOTJUGGLER_SETTINGS = {
    *('use_header_stamp', 'discard_large_arrays', 'max_array_size'),
    *('boolean_strings_to_number', 'remove_suffix_from_strings', 'selected_topics'),
}
"""Those of its subscriber to topics, `RosParserConfig` in plotjuggler-ros-plugins 2.1"""

OF = {'': ('estimator', 'topics'), '_arm': ('arm_estimator', 'arm_topics')}
"""End of a layout's name → the estimator, and the fixture with what that publishes"""


@pytest.mark.parametrize('end', OF)
def test_plotjuggler_plots_fields_that_are_published(end, request):
    topics = request.getfixturevalue(OF[end][1])
    root = ElementTree.parse(SHARE / 'layouts' / f'plotjuggler{end}.xml').getroot()
    curves = [curve.attrib['name'] for curve in root.iter('curve')]
    assert len(curves) > 5
    for curve in curves:
        topic, _, field = curve.rpartition('/')
        assert_is_published(f'{topic}.{field}', topics)
    (plugin,) = root.iter('plugin')
    assert plugin.attrib['ID'] == root.find('previouslyLoaded_Streamer').attrib['name']
    # As its loader reads them: one attribute each, and all topics in one.
    given = {setting.tag: setting.attrib for setting in plugin}
    assert all(set(values) == {'value'} for values in given.values())
    assert set(given) == PLOTJUGGLER_SETTINGS
    assert set(given['selected_topics']['value'].split(';')) <= set(topics)
    for splitter in root.iter('DockSplitter'):
        shares = [float(share) for share in splitter.attrib['sizes'].split(';')]
        assert len(shares) == len(splitter) == int(splitter.attrib['count'])
        assert sum(shares) == pytest.approx(1.0)


@pytest.mark.parametrize('end', OF)
def test_foxglove_plots_fields_that_are_published(end, request):
    name, of = OF[end]
    topics = request.getfixturevalue(of)
    layout = json.loads((SHARE / 'layouts' / f'foxglove{end}.json').read_text(encoding='utf-8'))
    panels = layout['configById']
    paths = [path['value'] for panel in panels.values() for path in panel.get('paths', ())]
    paths += [
        panel[key]
        for panel in panels.values()
        for key in ('topicPath', 'topicToRender')
        if key in panel
    ]
    assert len(paths) > 8
    for path in paths:
        assert_is_published(path, topics)
    (scene,) = (panel for panel in panels.values() if 'followTf' in panel)
    assert f'/{name}/markers' in scene['topics']
    assert all('title' not in panel for panel in panels.values())  # it reads foxglovePanelTitle

    def shown(part):
        return [part] if isinstance(part, str) else shown(part['first']) + shown(part['second'])

    assert sorted(shown(layout['layout'])) == sorted(panels)


def test_layouts_of_an_arm_name_all_joints_and_cables_of_the_example():
    arm = load_arm(installed_config('arm.yaml'))
    for path in (SHARE / 'layouts').glob('*_arm.*'):
        text = path.read_text(encoding='utf-8')
        for field, count in (('bend_angles', len(arm.units)), ('tensions', len(arm.cables))):
            indices = set(map(int, re.findall(rf'\b{field}\[(\d+)\]', text)))
            assert indices == set(range(count)), path
