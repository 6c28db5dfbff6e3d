"""Stick and slip with memory: where the unit is, from where it was."""

from __future__ import annotations

import math
from enum import Enum
from typing import Any, NamedTuple

from .admissible import admissible_angles, check_bend_angle, margin_at
from .contact import ContactForces, ForceRemainder, contact_at
from .design import JointDesign
from .equations import normal_force_ratios
from .equilibrium import Regime
from .sensitivity import TensionGradient, gradients_at_limit, stddev_of
from .solver import check_tensions

NO_GRADIENT = TensionGradient(0.0, 0.0)

STEPS = 32
"""Into which the way between two pairs of tensions is cut where its end alone may mislead"""


class TrackedState(NamedTuple):
    """Where a tracked unit is, and what holds it there. What is not determined is None."""

    regime: Regime
    """``held``, ``slipping``, ``driven_to_stop`` or ``slack``"""
    tension_l: float
    """T_l in N, as given"""
    tension_s: float
    """T_s in N, as given"""
    bend_angle: float | None = None
    """θ in rad, positive towards cable s; None while a cable is slack"""
    angle_assured: bool = True
    """False once a cable has been slack, until a stop or a reset: the angle is then where the unit
    was before, which is where it is only if it has not moved meanwhile"""
    slip_margin: float | None = None
    """`slip_margin` at the angle: ±1 right after a slip, beyond that only against the stop"""
    pressure: float | None = None
    """p in Pa; None where not `branch_consistent`"""
    normal_force: float | None = None
    """N = p C w in N; None where not `branch_consistent`"""
    forces: ContactForces | None = None
    force_remainder: ForceRemainder | None = None
    branch_consistent: bool | None = None
    """Whether F sin φ > W, so that Eq. (2) asks for the root taken (N < T)"""
    bend_angle_gradient: TensionGradient | None = None
    """∂θ/∂T in rad/N of the slip that brought the unit here; None where that is infinite, or the
    angle not assured"""
    pressure_gradient: TensionGradient | None = None
    """∂p/∂T in Pa/N"""

    def bend_angle_stddev(self, tension_stddev: float) -> float | None:
        """Return the standard deviation of the angle in rad, to first order, None if not known.

        Parameters
        ----------
        tension_stddev : float
            Standard deviation of each tension in N, the two independent.
        """
        return stddev_of(self.bend_angle_gradient, tension_stddev)

    def pressure_stddev(self, tension_stddev: float) -> float | None:
        """Return the standard deviation of the pressure in Pa in the same way."""
        return stddev_of(self.pressure_gradient, tension_stddev)

    def as_dict(self) -> dict[str, Any]:
        """Return the fields by name, ready for JSON: nested as dicts, undetermined as None."""
        return {name: _plain(value) for name, value in self._asdict().items()}


def _plain(value: Any) -> Any:
    if isinstance(value, Enum):
        return value.value
    return value._asdict() if hasattr(value, '_asdict') else value


class StickSlipTracker:
    """Follows a unit through a sequence of tensions, with exact set-valued Coulomb friction.

    The unit stays where it is, to the last bit, for as long as friction can hold it there.
    Otherwise it slips in the direction it is driven to the next angle at which friction can, or
    to its stop. There is no smoothing and no time step, so that a constant load never makes it
    creep. A change of tensions that would slip it, and take it back, between two updates is not
    seen.

    Parameters
    ----------
    design : JointDesign
    bend_angle : float
        Where the unit is at first, in rad.

    Raises
    ------
    BendAngleError
        If the angle is not a number or lies beyond the stop.
    """

    def __init__(self, design: JointDesign, bend_angle: float = 0.0) -> None:
        self._design = design
        self.reset(bend_angle)

    @property
    def bend_angle(self) -> float:
        """Where the unit was last, in rad."""
        return self._bend_angle

    @property
    def design(self) -> JointDesign:
        """The unit's design."""
        return self._design

    def reset(self, bend_angle: float) -> None:
        """Put the unit to an angle in rad that an encoder or a homing move has told.

        Raises
        ------
        BendAngleError
            If the angle is not a number or lies beyond the stop; the old one then stays.
        """
        self._bend_angle = check_bend_angle(self._design, bend_angle)
        self._gradient: TensionGradient | None = NO_GRADIENT
        self._assured = True
        self._tensions: tuple[float, float] | None = None
        self._margin = 0.0  # at those tensions

    def doubt(self) -> None:
        """Take it that the unit may have moved unseen, say while no tensions came.

        The angle stays, but is not assured until a stop or a reset tells it.
        """
        self._assured = False
        self._gradient = None
        self._tensions = None

    def change_design(self, design: JointDesign) -> None:
        """Go on with another design, from the same angle.

        A unit beyond the new stop is put there, and its angle is then not assured.
        """
        stop = design.max_bend_angle
        if abs(self._bend_angle) > stop:
            self._bend_angle = math.copysign(stop, self._bend_angle)
            self._assured = False
            self._gradient = None
        self._design = design
        self._tensions = None

    def update(self, tension_l: float, tension_s: float) -> TrackedState:
        """Take a new pair of tensions in N; return where the unit is then.

        Raises
        ------
        TensionError
            As `solve` does; the unit then stays as it was.
        """
        tension_l, tension_s = check_tensions(self._design, tension_l, tension_s)
        if tension_l == 0.0 or tension_s == 0.0:
            self.doubt()
            return TrackedState(Regime.SLACK, tension_l, tension_s, angle_assured=False)
        regime = Regime.HELD
        margin = margin_at(self._design, tension_l, tension_s, self._bend_angle)
        if abs(margin) > 1.0 and self._stays_at_stop(margin):
            regime = self._come_to_stop(math.copysign(1.0, margin))
        elif abs(margin) > 1.0:
            for pair in self._way(tension_l, tension_s, math.copysign(1.0, margin)):
                margin = margin_at(self._design, *pair, self._bend_angle)
                if abs(margin) > 1.0:
                    regime = self._slip(*pair, math.copysign(1.0, margin))
            margin = margin_at(self._design, tension_l, tension_s, self._bend_angle)
            if regime is Regime.DRIVEN_TO_STOP and abs(margin) <= 1.0:
                regime = Regime.SLIPPING  # driven there on the way, and held now
        self._tensions, self._margin = (tension_l, tension_s), margin
        return self._state(regime, tension_l, tension_s, margin)

    def _stays_at_stop(self, margin: float) -> bool:
        """Whether the unit is pressed against the stop at which it is, all the way to here.

        The moment changes in proportion on the way, so that it does not turn where its ends agree.
        """
        stop = math.copysign(self._design.max_bend_angle, margin)
        return self._bend_angle == stop and (
            self._tensions is None or self._margin * margin >= 0.0
        )

    def _come_to_stop(self, side: float) -> Regime:
        self._bend_angle = side * self._design.max_bend_angle
        self._gradient = NO_GRADIENT
        self._assured = True
        return Regime.DRIVEN_TO_STOP

    def _slip(self, tension_l: float, tension_s: float, side: float) -> Regime:
        """Move the unit in the direction it is driven; return ``slipping`` or the stop's regime.

        The direction `side` is 1 towards cable s, −1 towards cable l.
        """
        behind, ahead = (tension_l, tension_s) if side > 0.0 else (tension_s, tension_l)
        landing = self._landing(behind, ahead, side * self._bend_angle)
        if landing is None:
            return self._come_to_stop(side)
        self._bend_angle = side * landing
        self._gradient, _ = gradients_at_limit(
            self._design, tension_l, tension_s, self._bend_angle, side
        )
        return Regime.SLIPPING

    def _landing(self, behind: float, ahead: float, start: float) -> float | None:
        """First angle from `start` upwards at which friction holds; None if there is none."""
        for low, high in admissible_angles(self._design, behind, ahead):
            if high > start:
                return max(low, start)
        return None

    def _way(self, tension_l: float, tension_s: float, side: float) -> list[tuple[float, float]]:
        """Tensions at which to look where the unit slips to, from the last pair to this one.

        If the admissible angles only get fewer on the way, looking at its end is enough: what
        holds the unit there would not have been passed by before. That is so where the slip
        function grows, ∂g = (r + δ) / (μ r) dΔT − (T − N_f) / R dT ≥ 0. Otherwise an interval may
        open ahead of a unit that has gone past, so tensions in between are looked at too, taken to
        change in proportion.
        """
        new = (tension_l, tension_s)
        if self._tensions is None:
            return [new]
        old, design = self._tensions, self._design
        change = [after - before for before, after in zip(old, new, strict=True)]
        lever = (design.ball_radius + design.cable_offset) / (
            design.friction_coefficient * design.ball_radius
        )
        pull = lever * side * (change[1] - change[0])
        for pair in (old, new):
            ratios = normal_force_ratios(design, *pair)
            for index in range(-4, 5):
                _, force, root = ratios(0.25 * index * design.max_bend_angle)
                if root * pull < (1.0 - force) * sum(change):
                    return [
                        (old[0] + share * change[0], old[1] + share * change[1])
                        for share in (step / STEPS for step in range(1, STEPS))
                    ] + [new]
        return [new]

    def _state(
        self, regime: Regime, tension_l: float, tension_s: float, margin: float
    ) -> TrackedState:
        """Work out what holds the unit at its new angle.

        Held, friction is what Eq. (3) asks for, F = M / r, and Eqs. (1) and (2) give N; driven
        against the stop it is at its limit.
        """
        design, angle = self._design, self._bend_angle
        r, arm = design.ball_radius, design.ball_radius + design.cable_offset
        total, weight = tension_l + tension_s, design.weight
        pressure_gradient = None
        if regime is Regime.DRIVEN_TO_STOP:
            side = math.copysign(1.0, angle)
            ratios = normal_force_ratios(design, tension_l, tension_s)(side * angle)
            normal_force = total * ratios[1]
            friction_force = side * design.friction_coefficient * normal_force
            _, pressure_gradient = gradients_at_limit(
                design, tension_l, tension_s, angle, side, at_stop=True
            )
        else:
            moment = (tension_s - tension_l) * arm + weight * design.com_distance * math.sin(angle)
            friction_force = moment / r
            side = math.copysign(1.0, friction_force)
            phi = design.contact_centre_angle + side * angle
            along = friction_force * math.cos(phi)
            across = abs(friction_force) * math.sin(phi) - weight
            lift = math.hypot(along, across)
            normal_force = total - lift
            if lift > 0.0:
                by_friction = side * (abs(friction_force) - weight * math.sin(phi)) / lift
                by_difference = by_friction * arm / r
                pressure_gradient = TensionGradient(
                    (1.0 + by_difference) / design.contact_area,
                    (1.0 - by_difference) / design.contact_area,
                )
        contact = contact_at(design, total, angle, normal_force, friction_force)
        known = contact.branch_consistent
        return TrackedState(
            regime=regime,
            tension_l=tension_l,
            tension_s=tension_s,
            bend_angle=angle,
            angle_assured=self._assured,
            slip_margin=margin,
            pressure=normal_force / design.contact_area if known else None,
            normal_force=normal_force if known else None,
            forces=contact.forces if known else None,
            force_remainder=contact.remainder if known else None,
            branch_consistent=known,
            bend_angle_gradient=self._gradient if self._assured else None,
            pressure_gradient=pressure_gradient if known else None,
        )
