"""Probabilities of a standard normal number, and of two that are correlated; no physics."""

from __future__ import annotations

import math
from statistics import NormalDist

SQRT_HALF = math.sqrt(0.5)
SQRT_TWO_PI = math.sqrt(2.0 * math.pi)

CLOSE = 0.92
"""Correlation from which on two numbers are taken for one and what parts them"""

APART = 40.0
"""Square of the distance of two bounds, in deviations of what parts the numbers, from which on
they are never between them, but for once in 1e9 times"""

_NODES = (
    (0.0694318442029737, 0.1739274225687268),
    (0.3300094782075719, 0.3260725774312732),
    (0.6699905217924281, 0.3260725774312732),
    (0.9305681557970262, 0.1739274225687268),
)
"""Gauss-Legendre nodes from 0 to 1, and their weights"""

_inverse = NormalDist().inv_cdf

LOWEST, HIGHEST = _inverse(5e-324), _inverse(1.0 - 2.0**-53)
"""Scores of the least probability that there is, but for rounding, and of the largest below 1"""


def below(bound: float) -> float:
    """Φ: the probability that a standard normal number is below a bound.

    In a third of the time of `statistics.NormalDist`.
    """
    return 0.5 * math.erfc(-SQRT_HALF * bound)


def score_of(probability: float) -> float:
    """Φ⁻¹: the bound below which it is with a probability; never infinite."""
    if 0.0 < probability < 1.0:
        return _inverse(probability)
    return LOWEST if probability < 0.5 else HIGHEST


def both_below(one: float, other: float, correlation: float) -> float:
    """Return the probability that two numbers are below their bounds x and y, to 1e-4.

    Its derivative by the correlation ρ = sin a is the density of the pair at the bounds (Drezner
    and Wesolowsky, J. Statist. Comput. Simul. 35, 1990), so that it is

        Φ(x) Φ(y) + ∫ exp(−(x² − 2 x y sin a + y²) / (2 cos² a)) da / 2π

    from 0. Near ρ = 1 it is Φ(min(x, y)) less that integral from there, which in terms of
    u = cos a is

        ∫ exp(−(x − y)² / (2 u²)) h(u) du,   h(u) = exp(−x y / (1 + sin a)) / sin a;

    the first factor is steep and the second is not (Genz, Stat. Comput. 14, 2004), so that with a
    parabola for h it is in closed form. Near −1 the same is said of one number and the other's
    negative.
    """
    if correlation >= 0.0:
        sign, bound = 1.0, other
        known = below(min(one, other))
    else:
        sign, bound = -1.0, -other
        known = max(below(one) - below(bound), 0.0)
    gap = one - bound
    square, spread = gap * gap, 1.0 - correlation * correlation
    if square > APART * spread:
        return known
    if abs(correlation) < CLOSE:
        found = below(one) * below(other) + _from_independent(one, other, correlation)
        # What is known is the most that it can be, or the least.
        return min(found, known) if correlation >= 0.0 else max(found, known)
    return known - sign * _from_equal(square, one * bound, sign * correlation)


def _from_independent(one: float, other: float, correlation: float) -> float:
    """Return the integral from a correlation of 0."""
    largest = math.asin(correlation)
    squares, product = -0.5 * (one * one + other * other), one * other
    sine, exponential = math.sin, math.exp
    total = 0.0
    for node, weight in _NODES:
        along = sine(largest * node)
        total += weight * exponential((squares + product * along) / (1.0 - along * along))
    return largest / (2.0 * math.pi) * total


def _from_equal(square: float, product: float, correlation: float) -> float:
    """Return the integral from a correlation to 1.

    Parameters
    ----------
    square, product : float
        (x − y)² and x y.
    """
    reach = math.sqrt(1.0 - correlation * correlation)
    if not reach > 0.0:
        return 0.0
    steep = math.exp(-0.5 * square / (reach * reach))
    gap = math.sqrt(square)
    # ∫ exp(−(x − y)² / (2 u²)) du, and with u² in it
    plain = reach * steep - gap * SQRT_TWO_PI * below(-gap / reach)
    curved = (reach * reach * reach * steep - square * plain) / 3.0
    start = math.exp(-0.5 * product)
    end = math.exp(-product / (1.0 + correlation)) / correlation
    return (start * plain + (end - start) / (reach * reach) * curved) / (2.0 * math.pi)
