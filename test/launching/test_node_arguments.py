"""What the launch files make of their arguments; that they do, `test_rig_launch` shows."""

import pytest

from tendon_statics import default_design_path
from tendon_statics.launching.node_arguments import (
    NODE_ARGUMENTS,
    LaunchArgumentError,
    given_parameters,
    respawn_options,
    tension_remappings,
)

NONE = {'tensions': '', 'tension_l': '', 'tension_s': ''}


@pytest.fixture
def params_file(tmp_path):
    """A unit's file with a tension source, or none."""

    def written(source):
        path = tmp_path / 'unit.yaml'
        more = f'    tension_source: {source}\n' if source else ''
        path.write_text(default_design_path().read_text() + more)
        return path

    return written


def test_defaults_are_among_the_choices():
    for argument in NODE_ARGUMENTS:
        assert not argument.choices or argument.default in argument.choices


def test_what_is_not_given_is_left_to_the_parameters():
    arguments = {'use_sim_time': '', 'autostart': 'false'}
    assert given_parameters(arguments, 'use_sim_time', 'autostart') == {'autostart': False}
    assert given_parameters({'use_sim_time': 'true'}, 'use_sim_time') == {'use_sim_time': True}


def test_a_delay_is_a_number_of_seconds():
    given = {'respawn': 'true', 'respawn_delay': '0.5'}
    assert respawn_options(given) == {'respawn': True, 'respawn_delay': 0.5}
    for delay in ('soon', '-1', 'nan', 'inf', ''):
        with pytest.raises(LaunchArgumentError, match=f"respawn_delay is '{delay}', a number"):
            respawn_options({'respawn': 'true', 'respawn_delay': delay})


@pytest.mark.parametrize(
    ('source', 'given'),
    [
        ('', {'tensions': 'driver/tensions'}),
        ('joint_state', {'tensions': 'actuators/measured_js'}),
        ('wrench_pair', {'tension_l': 'l/measured_cf', 'tension_s': 's/measured_cf'}),
        ('wrench_pair', {'tension_s': 's/measured_cf'}),
        ('wrench_pair', {}),
        ('nonsense', {'tensions': 'a'}),  # which the node refuses better
    ],
)
def test_topics_of_tensions_are_those_that_the_estimator_hears(source, given, params_file):
    found = tension_remappings({**NONE, **given}, params_file(source), '/estimator')
    assert dict(found) == given


@pytest.mark.parametrize(
    ('source', 'topic', 'named'),
    [
        (
            'wrench_pair',
            'tensions',
            'wrench_pair tensions come on tension_l and tension_s',
        ),
        ('', 'tension_l', 'array tensions come on tensions: give tensions instead'),
        ('joint_state', 'tension_s', 'joint_state tensions come on tensions'),
    ],
)
def test_a_topic_that_would_not_be_heard_is_refused(source, topic, named, params_file):
    with pytest.raises(LaunchArgumentError, match=f"{topic} is 'a', but with .*{named}"):
        tension_remappings({**NONE, topic: 'a'}, params_file(source), '/estimator')


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(LaunchArgumentError, match=r'missing\.yaml: it cannot be read'):
        tension_remappings(NONE, tmp_path / 'missing.yaml', '/estimator')
