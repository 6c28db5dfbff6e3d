"""`warn_of_unknown_parameters`: of what no node has, and of nothing else."""

import pytest
from list_entities import alone, own_parameters

from tendon_statics.driver.pulley_driver import PulleyDriver
from tendon_statics.files.driver_parameters import DRIVER_PARAMETERS
from tendon_statics.files.estimator_parameters import WIRING, known_names
from tendon_statics.files.known_parameters import QOS
from tendon_statics.files.view_parameters import VIEW_PARAMETERS
from tendon_statics.node.estimator import Estimator
from tendon_statics.node.parameters.estimator import Wiring
from tendon_statics.node.parameters.unknown import warn_of_unknown_parameters
from tendon_statics.view.view import View


def test_the_tables_are_all_that_the_nodes_have():
    with alone(Estimator) as node:
        assert set(own_parameters(node)) == known_names()
    with alone(PulleyDriver) as node:
        assert own_parameters(node) == [parameter.name for parameter in DRIVER_PARAMETERS]
    with alone(View, '-p', 'port:=0') as node:
        assert own_parameters(node) == [parameter.name for parameter in VIEW_PARAMETERS]
    assert Wiring._fields == tuple(parameter.name for parameter in WIRING)


@pytest.mark.parametrize('node_class', [Estimator, PulleyDriver, View])
def test_of_a_file_for_all_only_what_is_misspelt_is_named(node_class, tmp_path, monkeypatch):
    said = []
    path = tmp_path / 'unit.yaml'
    path.write_text(
        '/**:\n  ros__parameters:\n    rate: 20.0\n    dropout_probability: 0.1\n'
        '    joint_name: elbow\n    tension_stddev: 0.1\n    design: {mass: 0.01}\n'
        '    use_sim_time: true\n    port: 0\n    address: 127.0.0.1\n'
        '    qos_overrides: {/tensions: {subscription: {depth: 5}}}\n'
        '    noise_stdev: 0.1\n    jointname: elbow\n    desing: {mass: 0.01}\n'
    )
    with alone(node_class, '--params-file', str(path)) as node:
        monkeypatch.setattr(node.get_logger(), 'warning', said.append)
        warn_of_unknown_parameters(node)
    (text,) = said
    named = text.rpartition(': ')[2].split(', ')
    assert sorted(named) == ['desing.mass', 'jointname', 'noise_stdev']


def test_an_estimator_has_qos_overrides_of_its_own_and_names_a_misspelt_one(monkeypatch):
    said = []
    with alone(Estimator, '-p', 'qos_overrides./tension.subscription.depth:=5') as node:
        monkeypatch.setattr(node.get_logger(), 'warning', said.append)
        warn_of_unknown_parameters(node)
    (text,) = said
    assert QOS in text
