"""`warn_of_unknown_parameters`: of what neither node has, and of nothing else."""

import pytest
from list_driver_parameters import own_parameters
from list_entities import alone

from tendon_statics.node import unknown_parameters
from tendon_statics.node.estimator import Estimator
from tendon_statics.node.pulley_driver import PulleyDriver
from tendon_statics.node.unknown_parameters import (
    DRIVER_PARAMETERS,
    ESTIMATOR_PARAMETERS,
    warn_of_unknown_parameters,
)


def test_the_names_are_those_that_the_nodes_have():
    with alone(Estimator) as node:
        of_estimator = set(own_parameters(node))
    with alone(PulleyDriver) as node:
        of_driver = set(own_parameters(node))
    assert set(ESTIMATOR_PARAMETERS) == of_estimator
    assert set(DRIVER_PARAMETERS) == of_driver - of_estimator


@pytest.mark.parametrize('node_class', [Estimator, PulleyDriver])
def test_of_a_file_for_both_only_what_is_misspelt_is_named(node_class, tmp_path, monkeypatch):
    said = []
    path = tmp_path / 'unit.yaml'
    path.write_text(
        '/**:\n  ros__parameters:\n    rate: 20.0\n    dropout_probability: 0.1\n'
        '    joint_name: elbow\n    tension_stddev: 0.1\n    design: {mass: 0.01}\n'
        '    use_sim_time: true\n    qos_overrides: {/tensions: {subscription: {depth: 5}}}\n'
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
    assert unknown_parameters.QOS in text
