"""`identify`: standard errors, correlations and what equations say nothing of."""

import math

import numpy as np
import pytest

from tendon_statics.physics.identification import LOSS_VARIANCE, identify


def test_errors_and_correlations_are_those_of_least_squares():
    rng = np.random.default_rng(1)
    jacobian = rng.normal(size=(40, 3)) * [1.0, 1e-6, 1e6]  # whatever the units
    found = identify(jacobian, np.zeros(40))
    covariance = LOSS_VARIANCE * np.linalg.inv(jacobian.T @ jacobian)
    errors = np.sqrt(np.diag(covariance))
    assert found.standard_errors == pytest.approx(errors)
    assert found.correlation == pytest.approx(covariance / np.outer(errors, errors))
    assert len(found.null_directions) == 0


def test_with_gaussian_residuals_the_errors_are_those_of_the_noise():
    rng = np.random.default_rng(2)
    jacobian = rng.normal(size=(5000, 2))
    calm, stated, wild = (
        identify(jacobian, factor * rng.normal(size=5000)).standard_errors
        for factor in (0.1, 1.0, 3.0)
    )
    assert stated == pytest.approx(calm, rel=0.05)
    assert wild / calm == pytest.approx([3.0, 3.0], rel=0.35)


def test_a_combination_without_an_equation_is_named_and_the_rest_is_told():
    rng = np.random.default_rng(3)
    jacobian = rng.normal(size=(20, 4))
    jacobian[:, 2] = -3.0 * jacobian[:, 0]
    found = identify(jacobian, np.zeros(20))
    (direction,) = found.null_directions
    assert direction / direction[0] == pytest.approx([1.0, 0.0, 1.0 / 3.0, 0.0], abs=1e-9)
    assert np.isnan(found.standard_errors).tolist() == [True, False, True, False]
    alone = identify(jacobian[:, [0, 1, 3]], np.zeros(20)).standard_errors
    assert found.standard_errors[[1, 3]] == pytest.approx(alone[1:])
    assert math.isnan(found.correlation[0, 1])


@pytest.mark.parametrize('count', [0, 1, 2])
def test_with_fewer_equations_than_parameters_not_all_are_told(count):
    rng = np.random.default_rng(4)
    found = identify(rng.normal(size=(count, 3)), np.zeros(count))
    assert len(found.null_directions) == 3 - count
    assert np.isnan(found.standard_errors).all()


def test_many_equations_take_little_memory():
    """A square matrix of so many rows would be 80 GB."""
    jacobian = np.random.default_rng(5).normal(size=(100_000, 3))
    found = identify(jacobian, np.zeros(100_000))
    expected = math.sqrt(LOSS_VARIANCE / 100_000)
    assert found.standard_errors == pytest.approx([expected] * 3, rel=0.02)
