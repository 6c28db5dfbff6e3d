"""Quantities that follow a force in proportion, and the quadratics that they make."""

from __future__ import annotations

import math

Line = tuple[float, float]
"""A quantity that follows a force φ in proportion: its value without φ, and its slope by φ"""

Quadratic = tuple[float, float, float]
"""c_0, c_1 and c_2 of c_0 + c_1 φ + c_2 φ²"""


def product(one: Line, other: Line) -> Quadratic:
    """Multiply two lines."""
    (start, slope), (other_start, other_slope) = one, other
    return start * other_start, start * other_slope + slope * other_start, slope * other_slope


def combined(*parts: tuple[float, Quadratic]) -> Quadratic:
    """Add up quadratics, each times a factor."""
    c_0, c_1, c_2 = (
        math.fsum(factor * quadratic[power] for factor, quadratic in parts) for power in range(3)
    )
    return c_0, c_1, c_2


def real_roots(quadratic: Quadratic) -> list[float]:
    """Return its real roots, a double one once or not at all; none where it is constant."""
    c_0, c_1, c_2 = quadratic
    discriminant = c_1 * c_1 - 4.0 * c_2 * c_0
    if discriminant < 0.0 or c_1 == c_2 == 0.0:
        return []
    # The larger of the two without cancellation; their product is c_0 / c_2.
    larger = -0.5 * (c_1 + math.copysign(math.sqrt(discriminant), c_1))
    roots = {
        numerator / divisor + 0.0
        for numerator, divisor in ((larger, c_2), (c_0, larger))
        if divisor
    }
    return sorted(root for root in roots if math.isfinite(root))
