"""The elastic seat: a lapped, conforming seat all around the ball, which yields like springs."""

from __future__ import annotations

import math
from typing import Any

from .friction_circle import FrictionCircleLaw
from .law import ContactLaw, ContactShares, LoadedLaw, LoadShare, NormalSlopes, State
from .numbers import Numbers, wave_bounds
from .quadratic import Line, real_roots
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
        self.zone = zone
        self.coupling = zone.coupling
        self.tilting = friction_coefficient * zone.axial_friction
        self.swing = math.hypot(1.0, self.tilting)
        self.divisor = 1.0 + self.coupling * friction_coefficient**2
        self.gain = friction_coefficient * zone.lever / self.divisor
        self.circle = FrictionCircleLaw(friction_coefficient, start_angle, end_angle)

    def under(self, load: LoadShare, tilt: tuple[Any, Any], numbers: Numbers) -> LoadedLaw:
        return LoadedElasticSeatLaw(self, load, tilt, numbers)

    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        return normal * self.divisor - axial - self.tilting * ahead

    def forces_at_slip(self, moment: Line, axial: Line, ahead: Line) -> list[float]:
        """Those of the seat, whose K is in proportion too, and those of the friction circle."""
        start, slope = (
            of_moment - self.gain * (alone + along + self.tilting * across)
            for of_moment, alone, along, across in zip(
                moment, (1.0, 0.0), axial, ahead, strict=True
            )
        )
        of_circle = self.circle.forces_at_slip(moment, axial, ahead)
        return [*real_roots((start, slope, 0.0)), *of_circle]

    def contact_area(self, ball_radius: float, contact_width: float) -> float:  # noqa: ARG002
        """The zone's, real: the pressure is in Pa whatever `contact_width` is."""
        area = math.cos(self.start_angle) - math.cos(self.end_angle)
        return 2.0 * math.pi * ball_radius**2 * area / self.zone.mean_pressure


class LoadedElasticSeatLaw(LoadedLaw):
    """`ElasticSeatLaw` under a dead load.

    Its state is κ, ∂κ/∂ψ, κ and ∂κ/∂ψ of the seat alone, and the state of the friction circle.
    """

    __slots__ = ('_circle', '_law', '_numbers', '_share')

    def __init__(
        self, law: ElasticSeatLaw, load: LoadShare, tilt: tuple[Any, Any], numbers: Numbers
    ) -> None:
        self._law, self._share, self._numbers = law, load[0], numbers
        self._circle = law.circle.under(load, tilt, numbers)

    def at(self, cosine: Any, sine: Any) -> State:
        law, choose = self._law, self._numbers.choose
        circle = self._circle.at(cosine, sine)
        held, held_by_tilt, cos_psi, sin_psi, _ = circle
        gain, tilting, share = law.gain, law.tilting, self._share
        seat = gain * (1.0 + share * (cos_psi + tilting * sin_psi))
        seat_by_tilt = gain * share * (tilting * cos_psi - sin_psi)
        leads = seat >= held
        return (
            choose(leads, seat, held),
            choose(leads, seat_by_tilt, held_by_tilt),
            *(seat, seat_by_tilt),
            *circle,
        )

    def slope_bounds(self, one: State, other: State, width: Any) -> tuple[Any, Any]:
        numbers, gain = self._numbers, self._law.gain
        _, _, seat, seat_by_tilt, *circle = one
        _, _, other_seat, other_seat_by_tilt, *other_circle = other
        amplitude = gain * self._share * self._law.swing
        least, greatest = wave_bounds(
            numbers,
            *(seat_by_tilt, gain - seat),
            *(other_seat_by_tilt, gain - other_seat),
            *(-amplitude, amplitude),
        )
        low, high = self._circle.slope_bounds(tuple(circle), tuple(other_circle), width)
        # By how much the seat holds more at the ends, and how far that can change in between.
        lead, other_lead = seat - circle[0], other_seat - other_circle[0]
        drift = width * numbers.ordered(abs(high - least), abs(greatest - low))[1]
        leads = lead + other_lead > drift
        follows = lead + other_lead < -drift
        choose = numbers.choose
        return (
            choose(leads, least, choose(follows, low, numbers.ordered(least, low)[0])),
            choose(leads, greatest, choose(follows, high, numbers.ordered(high, greatest)[1])),
        )

    def by_share(self, state: State) -> Any:
        _, _, seat, _, *circle = state
        held, _, cos_psi, sin_psi, _ = circle
        return self._numbers.choose(
            seat >= held,
            self._law.gain * (cos_psi + self._law.tilting * sin_psi),
            self._circle.by_share(tuple(circle)),
        )

    def _used(self, state: State, moment: Any) -> tuple[Any, Any, Any]:
        """Return μ', which is μ times the share of κ that f takes up, 1 + c μ'² and n."""
        capacity, _, _, _, _, _, cos_psi, sin_psi, _ = state
        used = self._law.friction * moment / capacity
        divisor = 1.0 + self._law.coupling * used * used
        pushed = 1.0 + self._share * (cos_psi + used * self._law.zone.axial_friction * sin_psi)
        return used, divisor, pushed / divisor

    def normal(self, state: State, moment: Any) -> Any:
        return self._used(state, moment)[2]

    def normal_slopes(self, state: State, moment: Any) -> NormalSlopes:
        capacity, capacity_by_tilt, _, _, _, _, cos_psi, sin_psi, _ = state
        law, share = self._law, self._share
        used, divisor, normal = self._used(state, moment)
        tilting = used * law.zone.axial_friction
        by_used = law.zone.axial_friction * share * sin_psi
        by_used = (by_used - 2.0 * law.coupling * used * normal) / divisor
        return (
            normal,
            (cos_psi + tilting * sin_psi) / divisor
            - by_used * used * self.by_share(state) / capacity,
            share * (tilting * cos_psi - sin_psi) / divisor
            - by_used * used * capacity_by_tilt / capacity,
            by_used * law.friction / capacity,
        )

    def contact(self, state: State, moment: Any, normal: Any) -> ContactShares:
        zone = self._law.zone
        used, _, _ = self._used(state, moment)
        dragged = used * zone.transverse_friction * normal
        transverse = dragged - self._share * state[7]
        pressure = (normal, transverse)
        friction = (used * zone.axial_friction * transverse, -dragged)
        return pressure, friction, pressure

    def consistent(self, state: State, moment: Any) -> Any:
        """The seat presses on the ball."""
        return self.normal(state, moment) > 0.0
