"""The joint distribution of two normal numbers against a plain integral of it."""

import itertools
import math
from statistics import NormalDist

import numpy as np
import pytest

from tendon_statics.physics.normal_pair import both_below

NORMAL = NormalDist()


def integrated(one, other, correlation):
    """Over the first number, of the density times what is then left of the second."""
    places = np.linspace(-9.0, one, 4001)
    rest = math.sqrt(1.0 - correlation**2)
    left = [NORMAL.cdf((other - correlation * place) / rest) for place in places]
    return np.trapezoid(np.exp(-0.5 * places**2) / math.sqrt(2.0 * math.pi) * left, places)


@pytest.mark.parametrize('correlation', [-0.999, -0.9, -0.4, 0.0, 0.3, 0.8, 0.97, 0.999])
def test_it_is_the_integral_of_the_density(correlation):
    for one, other in itertools.product((-2.5, -0.3, 0.4, 3.0), (-3.0, -0.2, 1.0)):
        expected = integrated(one, other, correlation)
        assert both_below(one, other, correlation) == pytest.approx(expected, abs=1e-3)


def test_two_that_are_one_and_the_same_are_below_the_lower_bound():
    assert both_below(0.3, 1.2, 1.0) == pytest.approx(NORMAL.cdf(0.3), abs=1e-3)
    assert both_below(0.3, 1.2, -1.0) == pytest.approx(
        NORMAL.cdf(0.3) + NORMAL.cdf(1.2) - 1.0, abs=1e-3
    )
