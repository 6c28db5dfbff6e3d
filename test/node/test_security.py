"""The policy allows what the nodes have and what each role needs, and nothing more."""

import itertools
import os
import re
import shutil
import subprocess
from xml.etree import ElementTree

import pytest
from list_entities import alone, entities
from list_permissions import POLICY, full_name, permissions
from make_docs import ROOT
from rclpy.node import Node

from tendon_statics.driver.pulley_driver import PulleyDriver
from tendon_statics.files.cable_parameters import TENSION_SOURCES
from tendon_statics.files.installed_files import installed_config
from tendon_statics.node.arm_estimator import ArmEstimator
from tendon_statics.node.estimator import Estimator
from tendon_statics.view.estimators_in_sight import Sighting
from tendon_statics.view.kinds import ARM, UNIT
from tendon_statics.view.view import View

ROLES = {path.rpartition('/')[2]: rights for path, rights in permissions(POLICY).items()}
OTHERS = sorted(set(ROLES) - {'estimator', 'arm_estimator'})


def watching_view():
    """A view at whose pages somebody looks; without anybody it hears nothing."""
    view = View()
    namespace = view.get_namespace().rstrip('/')
    estimator, arm_estimator = f'{namespace}/estimator', f'{namespace}/arm_estimator'
    view.watches.look(Sighting(estimator, f'{estimator}/estimate', UNIT))
    view.watches.look(Sighting(arm_estimator, f'{arm_estimator}/arm_estimate', ARM))
    return view


TENSIONS = {'/tensions', '/tension_l', '/tension_s'}
SOURCES = [f'tension_source:={source}' for source in TENSION_SOURCES]
TIMES = ['use_sim_time:=false', 'use_sim_time:=true']
CONFIGURATIONS = {
    Estimator: [
        SOURCES,
        ['estimation:=equilibrium', 'estimation:=tracking', 'estimation:=filtering'],
        ['gravity_source:=fixed', 'gravity_source:=imu', 'gravity_source:=pose'],
        ['tip_wrench:=false', 'tip_wrench:=true'],
        ['tip_force:=false', 'tip_force:=true'],
        ['markers:=false', 'markers:=true'],
        TIMES,
    ],
    ArmEstimator: [
        ['tension_source:=joint_state', 'tension_source:=array'],
        ['estimation:=tracking', 'estimation:=filtering'],
        ['gravity_source:=fixed', 'gravity_source:=imu', 'gravity_source:=pose'],
        ['tip_wrench:=false', 'tip_wrench:=true'],
        ['tip_force:=false', 'tip_force:=true'],
        ['markers:=false', 'markers:=true'],
        TIMES,
    ],
    PulleyDriver: [SOURCES, TIMES],
    watching_view: [TIMES],
}


NAMES = {
    Estimator: 'estimator',
    ArmEstimator: 'arm_estimator',
    PulleyDriver: 'pulley_driver',
    watching_view: 'view',
}

_numbers = itertools.count()


def rights_needed(name, make_node, *ros_arguments):
    """What the graph says that a node of that name does: right → full names."""
    # A name of its own, since one of the same name that has ended may still be in the graph.
    alias = f'{name}_{os.getpid()}_{next(_numbers)}'
    any_port = ('-p', 'port:=0')  # of a view; others have none
    with alone(make_node, '-r', f'__node:={alias}', *any_port, *ros_arguments) as node:
        namespace = node.get_namespace()
        found = entities(node)
        clients = node.get_client_names_and_types_by_node(alias, namespace)
    rights = {
        'publish': found['publisher'],
        'subscribe': found['subscription'],
        'reply': found['service'],
        'request': dict(clients),
    }
    return {
        right: {full_name(own, namespace, name) for own in names}
        for right, names in rights.items()
    }


def one_by_one(configurations):
    """Each value of each parameter, all others at their defaults."""
    return [[option] for option in itertools.chain(*configurations)]


def together(configurations):
    """A value of every parameter at once, until each had all of its own."""
    longest = max(map(len, configurations))
    return [
        [options[min(at, len(options) - 1)] for options in configurations] for at in range(longest)
    ]


def rights_needed_in_every_configuration(node_class, *ros_arguments, chosen=one_by_one):
    """The union over all values of each parameter that chooses topics and services.

    No topic and no service hangs on two of them.
    """
    union = {'publish': set(), 'subscribe': set(), 'reply': set(), 'request': set()}
    for options in chosen(CONFIGURATIONS[node_class]):
        parameters = [part for option in options for part in ('-p', option)]
        for right, names in rights_needed(
            NAMES[node_class], node_class, *parameters, *ros_arguments
        ).items():
            union[right] |= names
    return union


@pytest.mark.parametrize(
    ('role', 'node_class'), [(role, node_class) for node_class, role in NAMES.items()]
)
def test_a_node_of_the_package_may_do_all_that_it_does_and_nothing_more(role, node_class):
    assert ROLES[role] == rights_needed_in_every_configuration(node_class)


@pytest.mark.parametrize('node_class', [Estimator, ArmEstimator])
def test_every_parameter_that_is_a_choice_is_among_the_configurations(node_class):
    """A new one may choose topics too; all that are known not to are named here."""
    without_topics = {
        'autostart',
        'design.contact_law',
        'executor',
        'start_type_description_service',
        'wrench_component',
    }
    with alone(node_class) as node:
        choices = {
            name
            for name in node._parameters
            if isinstance(node.get_parameter(name).value, bool)
            or ' or ' in node.describe_parameter(name).additional_constraints
        }
    varied = {options[0].partition(':=')[0] for options in CONFIGURATIONS[node_class]}
    assert choices == varied | (without_topics & node_names(node_class))


def node_names(node_class):
    with alone(node_class) as node:
        return set(node._parameters)


@pytest.mark.parametrize('role', OTHERS)
def test_any_role_may_do_what_every_node_does(role):
    plain = rights_needed(role, lambda: Node(role), '-p', 'use_sim_time:=true')
    for right, names in plain.items():
        assert names <= ROLES[role][right]


OF_THE_COMMAND_LINE = {
    f'/_ros2cli_*/{service}'
    for service in (
        *('describe_parameters', 'get_parameter_types', 'get_parameters', 'get_type_description'),
        *('list_parameters', 'set_parameters', 'set_parameters_atomically'),
    )
}
"""What the node of the command line offers, whose name ends with the number of its process"""

ALL_REPLIES = ROLES['estimator']['reply'] | ROLES['arm_estimator']['reply']

EXTRA = {
    'pulley_driver': {'publish': TENSIONS},
    'view': {
        'subscribe': {
            *('/diagnostics', '/estimator/estimate', '/estimator/regime'),
            *('/arm_estimator/arm_estimate', '/arm_estimator/regimes'),
            '/arm_estimator/admissible_angles',
        },
        'request': {'/estimator/get_parameters', '/arm_estimator/get_parameters'},
    },
    # Every C++ node subscribes to /parameter_events, and these may be in C++.
    'load_sensor': {
        'publish': {'/imu', '/base_pose', '/tip_wrench'},
        'subscribe': {'/parameter_events'},
    },
    'encoder': {
        'publish': {'/measured_bend_angle', '/measured_joint_states'},
        'subscribe': {'/parameter_events'},
    },
    'controller': {
        'subscribe': {'/parameter_events', '/diagnostics'}
        | {
            name
            for name in ROLES['estimator']['publish'] | ROLES['arm_estimator']['publish']
            if name.startswith(('/estimator/', '/arm_estimator/'))
            and not name.endswith(('/markers', '/transition_event'))
        },
        'request': {name for name in ALL_REPLIES if '/solve' in name},
    },
    'operator': {
        'subscribe': {name for rights in ROLES.values() for name in rights['publish']},
        'request': ALL_REPLIES,
        'reply': OF_THE_COMMAND_LINE,
    },
}
"""What each role is for, beside what every node does"""


@pytest.mark.parametrize('role', OTHERS)
def test_a_role_may_do_what_it_is_for_and_nothing_more(role):
    plain = rights_needed(role, lambda: Node(role), '-p', 'use_sim_time:=true')
    allowed = {right: ROLES[role][right] - names for right, names in plain.items()}
    extra = {right: EXTRA[role].get(right, set()) - names for right, names in plain.items()}
    assert allowed == extra


def who_may(right, name):
    return {role for role, rights in ROLES.items() if name in rights[right]}


def test_only_the_driver_may_publish_tensions():
    assert set.union(*(who_may('publish', name) for name in TENSIONS)) == {'pulley_driver'}


@pytest.mark.parametrize(
    'service',
    [
        *('set_parameters', 'set_parameters_atomically', 'load_design', 'change_state', 'reset'),
        'tare',
    ],
)
def test_only_the_operator_may_change_the_estimator(service):
    assert who_may('request', f'/estimator/{service}') == {'operator'}
    if service != 'load_design':
        assert who_may('request', f'/arm_estimator/{service}') == {'operator'}


@pytest.mark.parametrize('role', ROLES)
def test_no_role_may_answer_or_publish_for_another(role):
    for name in ROLES[role]['reply']:
        assert name.startswith((f'/{role}/', '/_ros2cli_'))
    assert who_may('publish', '/diagnostics') == {'estimator', 'arm_estimator'}
    shared = {'/parameter_events', '/rosout', '/diagnostics'}
    for name in ROLES[role]['publish'] - shared:
        assert who_may('publish', name) == {role}


def test_what_one_role_takes_another_gives():
    def all_that_may(right):
        return set.union(*(rights[right] for rights in ROLES.values()))

    # Time comes from a simulator or a recording, and a rig has neither.
    assert all_that_may('subscribe') - all_that_may('publish') == {'/clock'}
    assert all_that_may('publish') <= all_that_may('subscribe')
    assert all_that_may('request') == ALL_REPLIES


def test_names_hold_no_pattern_but_that_of_the_command_line():
    """A pattern in a name would allow more than the tests above compare."""
    names = {
        name for rights in ROLES.values() for of_right in rights.values() for name in of_right
    }
    patterns = {name for name in names if not re.fullmatch(r'(/[A-Za-z_][A-Za-z0-9_]*)+', name)}
    assert patterns == OF_THE_COMMAND_LINE


def test_the_node_of_the_command_line_may_offer_what_every_node_offers():
    """Without them ``ros2 service call`` ends at once where security is enforced."""
    plain = rights_needed('_ros2cli_7', lambda: Node('_ros2cli_7'))['reply']
    assert plain == {name.replace('*', '7') for name in OF_THE_COMMAND_LINE}


def test_the_policy_has_the_form_that_the_tool_of_ros_takes():
    root = ElementTree.parse(
        POLICY, ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    ).getroot()
    assert (root.tag, root.attrib) == ('policy', {'version': '0.2.0'})
    (enclaves,) = root
    # `ros2 security generate_artifacts` takes a comment here for an enclave, and ends.
    assert {child.tag for child in enclaves} == {'enclave'}


def test_the_installed_policy_is_this_one():
    installed = installed_config('rig.yaml').parents[1] / 'security' / 'policy.xml'
    assert installed.read_bytes() == POLICY.read_bytes()


def test_the_commands_of_the_page_follow_a_namespace_and_a_remapping(tmp_path):
    page = (ROOT / 'docs' / 'security.md').read_text(encoding='utf-8')
    move, rename = re.findall(r'^ +(sed .+)$', page, re.MULTILINE)
    shutil.copy(POLICY, tmp_path / 'policy.xml')
    arguments = ['-r', '__ns:=/distal']
    for command, more in (
        (move, []),
        (rename, ['-r', 'tensions:=actuators/measured_js']),
    ):
        subprocess.run(command, shell=True, check=True, cwd=tmp_path)
        arguments += more
        of_joint = permissions(tmp_path / 'distal.xml')
        assert set(of_joint) == {f'/tendon_statics/distal/{role}' for role in ROLES}
        for node_class, role in NAMES.items():
            needed = rights_needed_in_every_configuration(node_class, *arguments, chosen=together)
            assert of_joint[f'/tendon_statics/distal/{role}'] == needed
