"""The joint distribution of two normal numbers against a plain integral of it."""

import itertools
import math
from statistics import NormalDist

import numpy as np
import pytest

from tendon_statics.physics.normal_pair import below, both_below, score_of

NORMAL = NormalDist()


def integrated(one, other, correlation):
    """Over the first number, of the density times what is then left of the second."""
    places = np.linspace(-9.0, one, 4001)
    rest = math.sqrt(1.0 - correlation**2)
    left = [NORMAL.cdf((other - correlation * place) / rest) for place in places]
    return np.trapezoid(np.exp(-0.5 * places**2) / math.sqrt(2.0 * math.pi) * left, places)


@pytest.mark.parametrize('correlation', [-0.999, -0.91, -0.4, 0.0, 0.3, 0.8, 0.93, 0.999])
def test_it_is_the_integral_of_the_density(correlation):
    for one, other in itertools.product((-2.5, -0.3, 0.4, 3.0), (-3.0, -0.2, 1.0)):
        expected = integrated(one, other, correlation)
        assert both_below(one, other, correlation) == pytest.approx(expected, abs=1e-4)


def test_two_that_are_one_and_the_same_are_below_the_lower_bound():
    for correlation in (1.0, 1.0 + 1e-15):
        assert both_below(0.3, 1.2, correlation) == pytest.approx(NORMAL.cdf(0.3), abs=1e-12)
        assert both_below(0.3, 0.3, correlation) == pytest.approx(NORMAL.cdf(0.3), abs=1e-12)
        assert both_below(0.3, 1.2, -correlation) == pytest.approx(
            NORMAL.cdf(0.3) + NORMAL.cdf(1.2) - 1.0, abs=1e-12
        )


@pytest.mark.parametrize('correlation', [-0.9, 0.6, 0.96, 0.999])
def test_next_to_a_bound_that_is_hardly_met_it_is_a_share_of_that(correlation):
    for one in (-4.5, -3.0, 2.0):
        expected = integrated(one, -3.0, correlation)
        assert both_below(one, -3.0, correlation) == pytest.approx(
            expected, abs=2e-3 * NORMAL.cdf(-3.0)
        )


def test_it_is_no_less_than_nothing_and_no_more_than_the_rarer_of_the_two():
    bounds = np.linspace(-6.0, 6.0, 25)
    for one, other, correlation in itertools.product(bounds, bounds, np.linspace(-1.0, 1.0, 41)):
        assert 0.0 <= both_below(one, other, correlation) <= min(below(one), below(other))


def test_a_score_is_never_infinite():
    assert score_of(0.5) == 0.0
    assert score_of(below(1.3)) == pytest.approx(1.3)
    assert below(score_of(-1e-17)) == pytest.approx(0.0)
    assert below(score_of(1.0 + 1e-16)) == pytest.approx(1.0)
    assert math.isfinite(score_of(0.0))
    assert math.isfinite(score_of(1.0))
