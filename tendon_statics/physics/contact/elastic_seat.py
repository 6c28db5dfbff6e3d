"""The elastic seat: a lapped, conforming seat all around the ball, which yields like springs."""

from __future__ import annotations

import math
from typing import Any

from .friction_circle import FrictionCircleLaw
from .law import Bounds, CapacitySlopes, ContactLaw, ContactShares, LoadShare, NormalSlopes, Turn
from .zone import seat_constants


class ElasticSeatLaw(ContactLaw):
    """K = μ r k_c N_a at slip, and never less than `FrictionCircleLaw`'s.

    The seat from θ1 to θ2, at all azimuths, presses on the ball in proportion to how far it is
    pushed in (a Winkler foundation). Pressure and friction are balanced along the unit's axis and
    across it, which gives the axial resultant of the pressure

        N_a = (T + P_a + μ' q P_t) / (1 + c μ'²),

    with μ' = μ at slip, and μ times the used share of friction while held. k_c, q and c are
    constants of the zone; see `zone`.

    Raises
    ------
    ValueError
        If the zone goes beyond 90°.
    """

    fits = 'a lapped, conforming seat all around'

    def __init__(self, friction_coefficient: float, start_angle: float, end_angle: float) -> None:
        super().__init__(friction_coefficient, start_angle, end_angle)
        if end_angle > 0.5 * math.pi:
            raise ValueError(
                f'contact_end_angle is {end_angle!r}: the contact law elastic_seat takes a '
                'contact zone up to 90 deg (1.5708 rad)'
            )
        zone = seat_constants(start_angle, end_angle)
        self._zone = zone
        self._coupling = zone.coupling
        self._tilting = friction_coefficient * zone.axial_friction
        self._gain = (
            friction_coefficient * zone.lever / (1.0 + self._coupling * friction_coefficient**2)
        )
        self._circle = FrictionCircleLaw(friction_coefficient, start_angle, end_angle)

    def _seat(self, load: LoadShare, cosine: Any, sine: Any) -> Any:
        """κ of the seat alone."""
        return self._gain * (1.0 + load.share * (cosine + self._tilting * sine))

    def _seat_turns(self, load: LoadShare, cosine: Any, sine: Any) -> tuple[Any, Any]:
        """First and second derivative of that by ψ."""
        scale = self._gain * load.share
        return (
            scale * (self._tilting * cosine - sine),
            -scale * (cosine + self._tilting * sine),
        )

    def capacity(self, load: LoadShare, cosine: Any, sine: Any) -> Any:
        seat, circle = (
            self._seat(load, cosine, sine),
            self._circle.capacity(load, cosine, sine),
        )
        return _chosen(seat >= circle, seat, circle)

    def slopes(self, load: LoadShare, cosine: Any, sine: Any) -> CapacitySlopes:
        seat, circle = self._seat(load, cosine, sine), self._circle.slopes(load, cosine, sine)
        holds = seat >= circle.capacity
        by_share = self._gain * (cosine + self._tilting * sine)
        by_tilt, _ = self._seat_turns(load, cosine, sine)
        return CapacitySlopes(
            _chosen(holds, seat, circle.capacity),
            _chosen(holds, by_share, circle.by_share),
            _chosen(holds, by_tilt, circle.by_tilt),
        )

    def slope_bounds(self, load: LoadShare, cosine: Any, sine: Any, turn: Turn) -> Bounds:
        seat = turn.bounds(*self._seat_turns(load, cosine, sine))
        circle = self._circle.slope_bounds(load, cosine, sine, turn)
        # By how much the seat holds more in the middle, and how far that can change to an end.
        lead = self._seat(load, cosine, sine) - self._circle.capacity(load, cosine, sine)
        apart = abs(seat.centre - circle.centre)
        drift = (apart + seat.radius + circle.radius) * turn.half_width
        one = _chosen(lead > 0.0, seat.centre, circle.centre)
        its = _chosen(lead > 0.0, seat.radius, circle.radius)
        both = 0.5 * (seat.centre + circle.centre)
        hull = 0.5 * (apart + seat.radius + circle.radius + abs(seat.radius - circle.radius))
        alone = abs(lead) > drift
        return Bounds(_chosen(alone, one, both), _chosen(alone, its, hull))

    def _normal(self, load: LoadShare, cosine: Any, sine: Any, used: Any) -> Any:
        """N_a / T, with `used` for μ': μ times the share of the capacity that f takes up."""
        pushed = 1.0 + load.share * (cosine + used * self._zone.axial_friction * sine)
        return pushed / (1.0 + self._coupling * used * used)

    def normal_slopes(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> NormalSlopes:
        capacity, capacity_by_share, capacity_by_tilt = self.slopes(load, cosine, sine)
        used = self.friction * moment / capacity
        normal = self._normal(load, cosine, sine, used)
        divisor = 1.0 + self._coupling * used * used
        tilting = used * self._zone.axial_friction
        by_used = self._zone.axial_friction * load.share * sine
        by_used = (by_used - 2.0 * self._coupling * used * normal) / divisor
        return NormalSlopes(
            normal,
            (cosine + tilting * sine) / divisor - by_used * used * capacity_by_share / capacity,
            load.share * (tilting * cosine - sine) / divisor
            - by_used * used * capacity_by_tilt / capacity,
            by_used * self.friction / capacity,
        )

    def contact(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> ContactShares:
        used = self.friction * moment / self.capacity(load, cosine, sine)
        axial = self._normal(load, cosine, sine, used)
        dragged = used * self._zone.transverse_friction * axial
        transverse = dragged - load.share * sine
        pressure = (axial, transverse)
        return ContactShares(
            axial,
            pressure,
            (used * self._zone.axial_friction * transverse, -dragged),
            pressure,
            axial > 0.0,
        )

    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        divisor = 1.0 + self._coupling * self.friction**2
        return normal * divisor - axial - self._tilting * ahead

    def contact_area(self, ball_radius: float, contact_width: float) -> float:  # noqa: ARG002
        """The zone's, real: the pressure is in Pa whatever `contact_width` is."""
        area = math.cos(self.start_angle) - math.cos(self.end_angle)
        return 2.0 * math.pi * ball_radius**2 * area / self._zone.mean_pressure


def _chosen(first: Any, one: Any, other: Any) -> Any:
    """One value where a condition holds, the other elsewhere."""
    return first * one + (1 - first) * other
