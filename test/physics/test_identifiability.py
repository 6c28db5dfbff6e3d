"""`identify`: standard errors, correlations and what equations say nothing of."""

import math

import numpy as np
import pytest

from tendon_statics.physics.calibration.identifiability import (
    LOSS_VARIANCE,
    identify,
    scatter_scale,
    scatter_significance,
)


def test_errors_and_correlations_are_those_of_least_squares():
    rng = np.random.default_rng(1)
    jacobian = rng.normal(size=(40, 3)) * [1.0, 1e-6, 1e6]  # whatever the units
    found = identify(jacobian, np.zeros(40))
    covariance = LOSS_VARIANCE * np.linalg.inv(jacobian.T @ jacobian)
    errors = np.sqrt(np.diag(covariance))
    assert found.standard_errors == pytest.approx(errors)
    assert found.correlation == pytest.approx(covariance / np.outer(errors, errors))
    assert len(found.null_directions) == 0


@pytest.mark.parametrize(('count', 'width'), [(9, 3), (24, 3), (400, 2)])
@pytest.mark.parametrize('noise', [0.2, 1.0, 5.0])
def test_the_scatter_tells_the_noise(count, width, noise):
    rng = np.random.default_rng(2)
    scales = []
    for _ in range(200):
        jacobian, data = rng.normal(size=(count, width)), noise * rng.normal(size=count)
        residuals = data - jacobian @ np.linalg.lstsq(jacobian, data, rcond=None)[0]
        scales.append(scatter_scale(residuals, count - width))
    assert np.median(scales) == pytest.approx(noise, rel=0.12)


def test_one_outlier_does_not_make_a_scatter():
    rng = np.random.default_rng(3)
    residuals = rng.normal(size=50)
    before = scatter_scale(residuals, 47), scatter_significance(residuals, 47)
    residuals[7] = 1e6
    after = scatter_scale(residuals, 47), scatter_significance(residuals, 47)
    assert after[0] < 1.15 * before[0]
    assert after[1] - before[1] < 1.0
    assert scatter_significance(3.0 * rng.normal(size=50), 47) > 5.0


@pytest.mark.parametrize('residuals', [np.zeros(5), np.array([1.0, 0.0, 0.0, 0.0, 0.0])])
def test_where_most_is_met_exactly_there_is_no_scatter(residuals):
    assert scatter_scale(residuals, 5) == 0.0
    assert scatter_scale(np.ones(3), 0) == 0.0
    assert scatter_significance(np.ones(3), 0) == 0.0


def test_few_equations_with_outliers_tell_less():
    rng = np.random.default_rng(4)
    jacobian, residuals = rng.normal(size=(12, 3)), rng.normal(size=12)
    residuals[:4] *= 10.0
    calm = identify(jacobian, np.zeros(12)).standard_errors
    assert (identify(jacobian, residuals).standard_errors > 1.2 * calm).all()


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
