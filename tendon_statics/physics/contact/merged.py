"""The paper's law: Eqs. (1) and (2) merged into one by squaring and adding."""

from __future__ import annotations

import math
from typing import Any

from ..roots import LEAST
from .law import (
    ContactLaw,
    ContactShares,
    LoadedLaw,
    LoadShare,
    NormalSlopes,
    State,
)
from .numbers import Numbers, scaled_bounds, wave_bounds
from .quadratic import Line, combined, product, real_roots


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
        self.sine, self.cosine = math.sin(centre), math.cos(centre)
        excess = (friction_coefficient - 1.0) * (friction_coefficient + 1.0)
        self.steep = 1.0 / excess if excess > 0.0 else 0.0

    def under(self, load: LoadShare, tilt: tuple[Any, Any], numbers: Numbers) -> LoadedLaw:
        return LoadedMergedLaw(self, load, tilt, numbers)

    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        limit = self.friction * normal
        return normal + math.hypot(limit * self.cosine - ahead, limit * self.sine - axial)

    def forces_at_slip(self, moment: Line, axial: Line, ahead: Line) -> list[float]:
        """Those at which N = M / (μ r) is a root of the squared and added equations."""
        normal = moment[0] / self.friction, moment[1] / self.friction
        # The part of the dead load against which friction at its limit acts.
        against = (
            self.sine * axial[0] + self.cosine * ahead[0],
            self.sine * axial[1] + self.cosine * ahead[1],
        )
        return real_roots(
            combined(
                (1.0, product((1.0, 0.0), (1.0 - 2.0 * normal[0], -2.0 * normal[1]))),
                (1.0, product(normal, normal)),
                (-1.0, product(moment, moment)),
                (2.0, product(moment, against)),
                *((-1.0, product(part, part)) for part in (axial, ahead)),
            )
        )

    def seating_tension(self, axial: float, ahead: float) -> float:
        """|P|: beyond it N is not real, or negative."""
        return math.hypot(axial, ahead)

    def forces_at_lift(self, axial: Line, ahead: Line) -> list[float]:
        size = combined((1.0, product(axial, axial)), (1.0, product(ahead, ahead)))
        return real_roots((size[0] - 1.0, size[1], size[2]))


class LoadedMergedLaw(LoadedLaw):
    """`MergedLaw` under a dead load; its state is κ, ∂κ/∂ψ, sin φ, cos φ and μ T / R."""

    __slots__ = (
        *('_across', '_along', '_excess', '_friction', '_half', '_law', '_less'),
        *('_may_cancel', '_numbers', '_product', '_share', '_square_root'),
    )

    def __init__(
        self, law: MergedLaw, load: LoadShare, tilt: tuple[Any, Any], numbers: Numbers
    ) -> None:
        self._law, self._numbers = law, numbers
        self._share, self._excess, self._product = load
        self._friction = law.friction
        self._may_cancel = numbers.any(law.friction * load[0] > 0.99)
        self._less, self._half = 1.0 - law.friction, 0.5 * law.friction
        self._square_root = numbers.square_root
        # sin φ and cos φ at zero bend
        cosine, sine = tilt
        self._along = law.sine * cosine + law.cosine * sine
        self._across = law.cosine * cosine - law.sine * sine

    def at(self, cosine: Any, sine: Any) -> State:
        sin_phi = self._along * cosine + self._across * sine
        cos_phi = self._across * cosine - self._along * sine
        share, excess, product = self._share, self._excess, self._product
        # 1 − μ sin φ from 1 − sin φ = [cos² φ + (1 − sin φ)²] / 2, which does not cancel.
        below_one = 1.0 - sin_phi
        one_less = self._less + self._half * (cos_phi * cos_phi + below_one * below_one)
        b = excess + share * one_less
        load_less = one_less - excess
        friction = self._friction
        across = friction * cos_phi
        root = self._square_root(load_less * load_less + product * across * across)
        larger = abs(b) + root
        normal = product / larger
        if self._may_cancel:  # where B < 0, and the other form of the same root does not
            normal = self._numbers.choose(b > 0.0, normal, self._law.steep * larger)
        capacity = friction * normal
        steepness = friction / (root + LEAST)
        return capacity, share * capacity * cos_phi * steepness, sin_phi, cos_phi, steepness

    def slope_bounds(self, one: State, other: State, width: Any) -> tuple[Any, Any]:  # noqa: ARG002
        # n / R grows with sin φ: its derivative by it is μ w n (R + B) / R³, never negative.
        numbers, share = self._numbers, self._share
        capacity, _, sin_phi, cos_phi, steepness = one
        other_capacity, _, other_sin_phi, other_cos_phi, other_steepness = other
        gain = share * capacity * steepness
        other_gain = share * other_capacity * other_steepness
        # Its ends: with sin φ = ∓1, T − N = ||P| ± μ N| and R = ||P| ± μ T|.
        friction, more, excess = self._friction, 1.0 + self._friction, self._excess
        at_least = excess / more
        beyond, choose = share > friction, numbers.choose
        at_most = choose(beyond, excess, 1.0 + share) / choose(beyond, self._less, more)
        scale = share * friction * friction
        lowest = scale * at_least / (share + friction)
        highest = scale * at_most / (abs(share - friction) + LEAST)
        low, high = wave_bounds(numbers, gain, cos_phi, other_gain, other_cos_phi, lowest, highest)
        least, most = wave_bounds(
            numbers, cos_phi, -sin_phi, other_cos_phi, -other_sin_phi, -1.0, 1.0
        )
        return scaled_bounds(numbers, least, most, low, high)

    def by_share(self, state: State) -> Any:
        capacity, _, sin_phi, _, steepness = state
        return (capacity * sin_phi - self._share) * steepness

    def _normal_and_gap(self, sin_phi: Any, moment: Any) -> tuple[Any, Any]:
        """Return n and (T − N) / T that Eqs. (1) and (2) ask for with the friction F = M / r."""
        share = self._share
        square = moment * moment + share * share - 2.0 * share * moment * sin_phi
        gap = self._square_root(abs(square))
        # 1 − gap, without loss of digits where it is small.
        return (self._product + moment * (2.0 * share * sin_phi - moment)) / (1.0 + gap), gap

    def normal(self, state: State, moment: Any) -> Any:
        return self._normal_and_gap(state[2], moment)[0]

    def normal_slopes(self, state: State, moment: Any) -> NormalSlopes:
        _, _, sin_phi, cos_phi, _ = state
        share = self._share
        normal, gap = self._normal_and_gap(sin_phi, moment)
        divisor = gap + LEAST
        return (
            normal,
            (moment * sin_phi - share) / divisor,
            share * moment * cos_phi / divisor,
            (share * sin_phi - moment) / divisor,
        )

    def contact(self, state: State, moment: Any, normal: Any) -> ContactShares:  # noqa: ARG002
        """Both forces act at β from the unit's axis; Eqs. (1) and (2) have N along it."""
        sine, cosine = self._law.sine, self._law.cosine
        return (
            (normal * cosine, normal * sine),
            (moment * sine, -moment * cosine),
            (normal, 0.0 * normal),
        )

    def consistent(self, state: State, moment: Any) -> Any:
        """They ask for the root taken, N < T, while F sin φ > |P|."""
        return moment * state[2] > self._share
