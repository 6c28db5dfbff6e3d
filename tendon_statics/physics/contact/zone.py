"""Means over a contact zone all around the ball, for the law of the elastic seat."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, lru_cache
from typing import NamedTuple


class SeatConstants(NamedTuple):
    """What a conforming seat takes from its zone alone; means are over the zone's area.

    At the polar angle t from the unit's axis and the azimuth f from the plane of bending, a
    surface point lies ρ = √(1 − sin² t sin² f) radii from the axis about which the unit turns.
    """

    lever: float
    """k_c = ⟨cos t ρ⟩ / ⟨cos² t⟩: mean lever of friction, in radii"""
    axial_friction: float
    """q = ⟨sin² t cos² f / ρ⟩ / ⟨sin² t cos² f⟩: axial friction for the transverse pressure"""
    transverse_friction: float
    """⟨cos² t / ρ⟩ / ⟨cos² t⟩: transverse friction for the axial pressure"""
    mean_pressure: float
    """⟨cos t⟩ / ⟨cos² t⟩: mean pressure for that of a flat seat under the same force"""

    @property
    def coupling(self) -> float:
        """Coupling c: by how much friction relieves the seat along the axis."""
        return self.axial_friction * self.transverse_friction


@lru_cache(maxsize=256)
def seat_constants(start_angle: float, end_angle: float) -> SeatConstants:
    """Work out the constants of a zone from θ1 to θ2 in rad, θ2 at most 90°.

    The means over the azimuth are complete elliptic integrals of the modulus sin t.
    """
    middle, half = 0.5 * (start_angle + end_angle), 0.5 * (end_angle - start_angle)
    circles = [(weight, _circle(middle + half * place)) for place, weight in _rule()]

    def mean(of: Callable[[_Circle], float]) -> float:
        total = 0.0
        for weight, circle in circles:
            total += weight * (circle.sine * of(circle))
        return total * STEP * half / area

    area = math.cos(start_angle) - math.cos(end_angle)
    axial = mean(lambda at: at.cosine**2)
    transverse = mean(lambda at: 0.5 * at.sine**2)
    # Over the azimuth, ⟨cos² f / ρ⟩ = (⟨ρ⟩ − cos² t ⟨1/ρ⟩) / sin² t.
    return SeatConstants(
        lever=mean(lambda at: at.cosine * at.lever) / axial,
        axial_friction=mean(lambda at: at.lever - at.cosine**2 * at.inverse_lever) / transverse,
        transverse_friction=mean(lambda at: at.cosine**2 * at.inverse_lever) / axial,
        mean_pressure=mean(lambda at: at.cosine) / axial,
    )


class _Circle(NamedTuple):
    """A circle of the seat: cos t, sin t, and ⟨1/ρ⟩ and ⟨ρ⟩ over the azimuth."""

    cosine: float
    sine: float
    inverse_lever: float
    lever: float


def _circle(polar_angle: float) -> _Circle:
    cosine = math.cos(polar_angle)
    return _Circle(cosine, math.sin(polar_angle), *_elliptic_means(cosine))


def _elliptic_means(cosine: float) -> tuple[float, float]:
    """⟨1/ρ⟩ and ⟨ρ⟩ over the azimuth: 2/π times K and E of the modulus sin t.

    By the arithmetic-geometric mean, which doubles its digits with each step.
    """
    mean, geometric = 1.0, cosine
    rest, weight = 0.5 * (1.0 - cosine * cosine), 0.5
    while abs(mean - geometric) > 1e-9 * mean:
        half_gap = 0.5 * (mean - geometric)
        mean, geometric = 0.5 * (mean + geometric), math.sqrt(mean * geometric)
        weight *= 2.0
        rest += weight * half_gap * half_gap
    mean = 0.5 * (mean + geometric)
    return 1.0 / mean, (1.0 - rest) / mean


STEP = 1.0 / 32.0
REACH = 110
"""Steps to either side, beyond which the weights of the quadrature are below rounding"""


@cache
def _rule() -> tuple[tuple[float, float], ...]:
    """Places from −1 to 1 and weights, to be multiplied by `STEP`, for an integral between these.

    It is the double-exponential rule, which is not troubled by singular ends.
    """
    rule = []
    for index in range(-REACH, REACH + 1):
        way = 0.5 * math.pi * math.sinh(index * STEP)
        place = math.tanh(way)
        weight = 0.5 * math.pi * math.cosh(index * STEP) / math.cosh(way) ** 2
        if abs(place) < 1.0:
            rule.append((place, weight))
    return tuple(rule)
