"""The friction circle: one contact that is free to migrate, as of a ball with play."""

from __future__ import annotations

import math
from typing import Any

from .law import (
    Bounds,
    CapacitySlopes,
    ContactLaw,
    ContactShares,
    LoadShare,
    NormalSlopes,
    Turn,
    square_root,
)


class FrictionCircleLaw(ContactLaw):
    """K = r sin(atan μ) √((T + P_a)² + P_t²).

    The contact moves over the ball until its reaction balances cables and dead load, so that
    Eqs. (1), (2) and (3) are met one by one. The reaction R = √(N² + F²) then passes the centre at
    the distance M / R, and friction holds while that is within the circle of radius r sin(atan μ).
    """

    fits = 'a ball with play: one contact that is free to migrate'

    def __init__(self, friction_coefficient: float, start_angle: float, end_angle: float) -> None:
        super().__init__(friction_coefficient, start_angle, end_angle)
        self._ratio = friction_coefficient / math.sqrt(1.0 + friction_coefficient**2)

    @staticmethod
    def _reaction(load: LoadShare, cosine: Any, sine: Any) -> tuple[Any, Any, Any]:
        """Return the reaction's parts along the axis and across it, and its size."""
        along, across = 1.0 + load.share * cosine, load.share * sine
        return along, across, square_root(along * along + across * across)

    def capacity(self, load: LoadShare, cosine: Any, sine: Any) -> Any:
        return self._ratio * self._reaction(load, cosine, sine)[2]

    def slopes(self, load: LoadShare, cosine: Any, sine: Any) -> CapacitySlopes:
        _, across, size = self._reaction(load, cosine, sine)
        scale = self._ratio / size
        return CapacitySlopes(self._ratio * size, scale * (cosine + load.share), -scale * across)

    def slope_bounds(self, load: LoadShare, cosine: Any, sine: Any, turn: Turn) -> Bounds:
        cosines, share = turn.bounds(cosine, sine), load.share
        ends = []
        for end in (cosines.centre - cosines.radius, cosines.centre + cosines.radius):
            # No smaller than at ψ = ±π, where the load pulls hardest.
            square = load.excess * load.excess + 2.0 * share * abs(1.0 + end)
            ends.append(self._ratio * share / square_root(square))
        slopes = Bounds.between(*ends).times(turn.bounds(sine, cosine))
        return Bounds(-slopes.centre, slopes.radius)

    def normal_slopes(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> NormalSlopes:
        _, _, size = self._reaction(load, cosine, sine)
        normal = square_root(abs((size - moment) * (size + moment)))
        share = load.share
        return NormalSlopes(
            normal, (cosine + share) / normal, -share * sine / normal, -moment / normal
        )

    def contact(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> ContactShares:
        """The contact lies ahead of the reaction by the angle of friction that is used."""
        along, across, size = self._reaction(load, cosine, sine)
        normal = square_root(abs((size - moment) * (size + moment)))
        # Direction of the contact, along the axis and across it: that of the reaction, turned.
        to_axis = (normal * along + moment * across) / (size * size)
        to_side = (moment * along - normal * across) / (size * size)
        pressure = (normal * to_axis, normal * to_side)
        return ContactShares(
            normal, pressure, (moment * to_side, -moment * to_axis), pressure, size > moment
        )

    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        square = normal * normal * (1.0 + self.friction**2) - ahead * ahead
        if square < 0.0:
            return 0.0
        return math.sqrt(square) - axial
