"""The friction circle: one contact that is free to migrate, as of a ball with play."""

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


class FrictionCircleLaw(ContactLaw):
    """K = r sin(atan μ) √((T + P_a)² + P_t²).

    The contact moves over the ball until its reaction balances cables and dead load, so that
    Eqs. (1), (2) and (3) are met one by one. The reaction R = √(N² + F²) then passes the centre at
    the distance M / R, and friction holds while that is within the circle of radius r sin(atan μ).
    """

    fits = 'a ball with play: one contact that is free to migrate'

    def __init__(self, friction_coefficient: float, start_angle: float, end_angle: float) -> None:
        super().__init__(friction_coefficient, start_angle, end_angle)
        self.ratio = friction_coefficient / math.sqrt(1.0 + friction_coefficient**2)

    def under(self, load: LoadShare, tilt: tuple[Any, Any], numbers: Numbers) -> LoadedLaw:
        return LoadedFrictionCircleLaw(self, load, tilt, numbers)

    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        square = normal * normal * (1.0 + self.friction**2) - ahead * ahead
        if square < 0.0:
            return 0.0
        return math.sqrt(square) - axial

    def forces_at_slip(self, moment: Line, axial: Line, ahead: Line) -> list[float]:
        """Those with M² = K²."""
        along, square = (1.0 + axial[0], axial[1]), -self.ratio * self.ratio
        parts = (1.0, product(moment, moment)), (square, product(along, along))
        return real_roots(combined(*parts, (square, product(ahead, ahead))))


class LoadedFrictionCircleLaw(LoadedLaw):
    """`FrictionCircleLaw` under a dead load; its state is κ, ∂κ/∂ψ, cos ψ, sin ψ and R / T."""

    __slots__ = ('_cosine', '_numbers', '_ratio', '_share', '_sine', '_square_root')

    def __init__(
        self, law: FrictionCircleLaw, load: LoadShare, tilt: tuple[Any, Any], numbers: Numbers
    ) -> None:
        self._ratio, self._share, self._numbers = law.ratio, load[0], numbers
        self._square_root = numbers.square_root
        self._cosine, self._sine = tilt

    def at(self, cosine: Any, sine: Any) -> State:
        share, ratio = self._share, self._ratio
        cos_psi = self._cosine * cosine - self._sine * sine
        sin_psi = self._sine * cosine + self._cosine * sine
        along, across = 1.0 + share * cos_psi, share * sin_psi
        size = self._square_root(along * along + across * across)
        return ratio * size, -ratio * across / (size + LEAST), cos_psi, sin_psi, size

    def slope_bounds(self, one: State, other: State, width: Any) -> tuple[Any, Any]:  # noqa: ARG002
        numbers = self._numbers
        _, _, cos_psi, sin_psi, size = one
        _, _, other_cos_psi, other_sin_psi, other_size = other
        share = self._share
        # R / T grows with cos ψ.
        low, high = wave_bounds(
            numbers, size, -sin_psi, other_size, -other_sin_psi, abs(1.0 - share), 1.0 + share
        )
        least, most = wave_bounds(
            numbers, sin_psi, cos_psi, other_sin_psi, other_cos_psi, -1.0, 1.0
        )
        scale = self._ratio * share
        return scaled_bounds(numbers, -most, -least, scale / (high + LEAST), scale / (low + LEAST))

    def by_share(self, state: State) -> Any:
        _, _, cos_psi, _, size = state
        return self._ratio * (cos_psi + self._share) / size

    def normal(self, state: State, moment: Any) -> Any:
        size = state[4]
        return self._square_root(abs((size - moment) * (size + moment)))

    def normal_slopes(self, state: State, moment: Any) -> NormalSlopes:
        _, _, cos_psi, sin_psi, _ = state
        normal, share = self.normal(state, moment), self._share
        return (normal, (cos_psi + share) / normal, -share * sin_psi / normal, -moment / normal)

    def contact(self, state: State, moment: Any, normal: Any) -> ContactShares:
        """The contact lies ahead of the reaction by the angle of friction that is used."""
        _, _, cos_psi, sin_psi, size = state
        along, across = 1.0 + self._share * cos_psi, self._share * sin_psi
        # Direction of the contact, along the axis and across it: that of the reaction, turned.
        to_axis = (normal * along + moment * across) / (size * size)
        to_side = (moment * along - normal * across) / (size * size)
        pressure = (normal * to_axis, normal * to_side)
        return pressure, (moment * to_side, -moment * to_axis), pressure

    def consistent(self, state: State, moment: Any) -> Any:
        return state[4] > moment
