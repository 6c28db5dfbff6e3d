"""Draws that fill their space evenly."""

import numpy as np
import pytest

from tendon_statics.physics.draws import even_normals


@pytest.mark.parametrize('variables', [1, 2, 5])
def test_they_have_the_moments_of_independent_standard_normals(variables):
    normals = even_normals(6765, variables)
    assert normals.shape == (variables, 6765)
    assert normals.mean(axis=1) == pytest.approx(np.zeros(variables), abs=0.01)
    assert np.cov(normals).reshape(variables, variables) == pytest.approx(
        np.eye(variables), abs=0.03
    )


def test_shares_of_the_plane_are_more_exact_than_by_chance():
    """By chance their deviation would be 0.0125 at a half."""
    normals = even_normals(1597, 2)
    random = np.random.default_rng(3)
    misses = []
    for _ in range(200):
        one = random.normal(size=2)
        # Independent halves of the plane, turned; both together are a quarter.
        across = np.array([-one[1], one[0]])
        quarter = np.mean((one @ normals > 0.0) & (across @ normals > 0.0))
        misses.append(quarter - 0.25)
    assert np.sqrt(np.mean(np.square(misses))) < 0.002


def test_they_are_kept_and_not_to_be_changed():
    normals = even_normals(100, 2)
    assert even_normals(100, 2) is normals
    with pytest.raises(ValueError, match='read-only'):
        normals[0, 0] = 1.0
