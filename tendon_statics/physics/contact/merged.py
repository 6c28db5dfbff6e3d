"""The paper's law: Eqs. (1) and (2) merged into one by squaring and adding."""

from __future__ import annotations

import math
from typing import Any

from .law import (
    LEAST,
    Bounds,
    CapacitySlopes,
    ContactLaw,
    ContactShares,
    LoadShare,
    NormalSlopes,
    Turn,
    square_root,
)


class MergedLaw(ContactLaw):
    """K = μ r N with the smaller root N of the squared and added Eqs. (1) and (2).

    Friction at its limit, F = μ N, acts on the unit at the angle φ = β + ψ from the dead load,
    β = (θ1 + θ2) / 2:

        (T − N)² = (μ N)² + |P|² − 2 |P| μ N sin φ,
        N = (T² − |P|²) / (B + R),   B = T − μ |P| sin φ.

    R is the root of the discriminant. Written as B² − (1 − μ²)(T² − |P|²) it can cancel; the same
    number as a sum of squares, R² = (|P| − μ T sin φ)² + μ² (T² − |P|²) cos² φ, cannot, and shows
    that it is real for T > |P|.
    """

    fits = "the paper's publication"
    carries_more_than_cables = False  # N is not real, or negative

    def __init__(self, friction_coefficient: float, start_angle: float, end_angle: float) -> None:
        super().__init__(friction_coefficient, start_angle, end_angle)
        centre = 0.5 * (start_angle + end_angle)
        self._sine, self._cosine = math.sin(centre), math.cos(centre)
        excess = (friction_coefficient - 1.0) * (friction_coefficient + 1.0)
        self._steep = 1.0 / excess if excess > 0.0 else 0.0

    def _direction(self, cosine: Any, sine: Any) -> tuple[Any, Any]:
        """Return sin φ and cos φ."""
        return (
            self._sine * cosine + self._cosine * sine,
            self._cosine * cosine - self._sine * sine,
        )

    def _root(self, load: LoadShare, sin_phi: Any, cos_phi: Any) -> tuple[Any, Any]:
        """Return n and R / T of a unit about to slip."""
        share, excess, product = load
        friction = self.friction
        # 1 − μ sin φ from 1 − sin φ = [cos² φ + (1 − sin φ)²] / 2, which does not cancel.
        below_one = 1.0 - sin_phi
        spare = 1.0 - friction + 0.5 * friction * (cos_phi * cos_phi + below_one * below_one)
        b = excess + share * spare
        lift = spare - excess
        slide = friction * cos_phi
        root = square_root(lift * lift + product * slide * slide)
        # B ≤ 0 needs μ > 1; there the other form of the same root is the one that does not cancel.
        larger = abs(b) + root
        rising = b > 0.0
        return rising * (product / larger) + (1 - rising) * (self._steep * larger), root

    def capacity(self, load: LoadShare, cosine: Any, sine: Any) -> Any:
        return self.friction * self._root(load, *self._direction(cosine, sine))[0]

    def slopes(self, load: LoadShare, cosine: Any, sine: Any) -> CapacitySlopes:
        sin_phi, cos_phi = self._direction(cosine, sine)
        normal, root = self._root(load, sin_phi, cos_phi)
        friction, share = self.friction, load.share
        capacity = friction * normal
        steepness = friction / (root + LEAST)
        return CapacitySlopes(
            capacity,
            (capacity * sin_phi - share) * steepness,
            share * capacity * cos_phi * steepness,
        )

    def slope_bounds(self, load: LoadShare, cosine: Any, sine: Any, turn: Turn) -> Bounds:
        # n / R grows with sin φ: its derivative by it is μ w n (R + B) / R³, never negative.
        sin_phi, cos_phi = self._direction(cosine, sine)
        sines = turn.bounds(sin_phi, cos_phi)
        ends = []
        for end in (sines.centre - sines.radius, sines.centre + sines.radius):
            within = _clipped(end)
            normal, root = self._root(load, within, square_root(abs(1.0 - within * within)))
            ends.append(normal / (root + LEAST))
        scale = self.friction * self.friction * load.share
        gain = Bounds.between(scale * ends[0], scale * ends[1])
        return gain.times(turn.bounds(cos_phi, sin_phi))

    @staticmethod
    def _lifted(load: LoadShare, sin_phi: Any, moment: Any) -> tuple[Any, Any]:
        """Return n and (T − N) / T that Eqs. (1) and (2) ask for with the friction F = M / r."""
        share = load.share
        square = moment * moment + share * share - 2.0 * share * moment * sin_phi
        lift = square_root(abs(square))
        # 1 − lift, without loss of digits where it is small.
        return (load.product + moment * (2.0 * share * sin_phi - moment)) / (1.0 + lift), lift

    def normal_slopes(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> NormalSlopes:
        sin_phi, cos_phi = self._direction(cosine, sine)
        share = load.share
        normal, lift = self._lifted(load, sin_phi, moment)
        divisor = lift + LEAST
        return NormalSlopes(
            normal,
            (moment * sin_phi - share) / divisor,
            share * moment * cos_phi / divisor,
            (share * sin_phi - moment) / divisor,
        )

    def contact(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> ContactShares:
        """Both forces act at β from the unit's axis; Eqs. (1) and (2) have N along it.

        They ask for the root taken, N < T, while F sin φ > |P|.
        """
        sin_phi, _ = self._direction(cosine, sine)
        normal, _ = self._lifted(load, sin_phi, moment)
        return ContactShares(
            normal,
            (normal * self._cosine, normal * self._sine),
            (moment * self._sine, -moment * self._cosine),
            (normal, 0.0 * normal),
            moment * sin_phi > load.share,
        )

    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        limit = self.friction * normal
        return normal + math.hypot(limit * self._cosine - ahead, limit * self._sine - axial)


def _clipped(sine: Any) -> Any:
    """A sine that rounding, or a bound, has put beyond ±1, back at it."""
    return 0.5 * (abs(sine + 1.0) - abs(sine - 1.0))
