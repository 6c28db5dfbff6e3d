"""What the model says of a unit under one pair of tensions: the one result type."""

from __future__ import annotations

from enum import Enum
from functools import cached_property
from typing import Any, NamedTuple

from .design import JointDesign
from .design_gradients import Derivatives, answer_derivatives
from .forces import Contact, ContactForces, ForceRemainder, contact_at
from .gradients import (
    ByCable,
    TensionGradient,
    angle_by_tensions,
    finite,
    normal_by_tensions,
    of_sides,
    root_gradient,
    stddev_of,
)
from .load import Load
from .slip import Slip, SlipPoint
from .tensions import Tensions, taut_slip


class Regime(str, Enum):
    """What a pair of tensions means for the unit; the values are used on every interface."""

    EQUILIBRIUM = 'equilibrium'
    """The unit is on the verge of slipping at one angle, which is given."""
    HELD = 'held'
    """Friction keeps the unit from slipping towards the stronger cable at every angle from 0 to
    the stop: tensions alone do not determine the angle. For a tracker: where it was."""
    SLIPPING = 'slipping'
    """The unit has slipped and friction holds it again, at its limit; only a tracker says so."""
    DRIVEN_TO_STOP = 'driven_to_stop'
    """At no angle from 0 to the stop can friction keep the unit from slipping towards the stronger
    cable: it slides to the stop. Bent the other way it may be held; `admissible_angles` tells."""
    SLACK = 'slack'
    """A cable carries no tension, which is outside the model."""

    def __str__(self) -> str:
        return self.value


class _Fields(NamedTuple):
    design: JointDesign
    load: Load
    regime: Regime
    tension_l: float
    """T_l in N, as given"""
    tension_s: float
    """T_s in N, as given"""
    bend_angle: float | None = None
    """θ in rad, positive towards cable s. Of `solve` the root nearest to 0, or the stop; of a
    tracker where the unit is"""
    root_count: int | None = None
    """Of `solve`: angles between 0 and the stop, on the side of the stronger cable, at which the
    unit is about to slip"""
    iterations: int | None = None
    """Of `solve`: steps of the search for the root; 0 where there was nothing to search"""
    angle_assured: bool = True
    """Of a tracker: False once a cable has been slack, until a stop or a reset. The angle is then
    where the unit was before, which is where it is only if it has not moved meanwhile"""
    slip_gradient: TensionGradient | None = None
    """Of a tracker: ∂θ/∂T in rad/N of the slip that brought the unit here"""


class Equilibrium(_Fields):
    """The answer of `solve`, and of a tracker. What is not determined is None, never a number.

    All that follows from the angle is worked out when it is asked for, once: forces, pressure and
    gradients are None where there is no angle, that is while a cable is slack, and in the regime
    ``held`` of `solve`.
    """

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f'an Equilibrium cannot be changed; its {name} is what it is')

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), tuple(self)

    @property
    def is_tracked(self) -> bool:
        """Whether a tracker gave it, which remembers where the unit was."""
        return self.root_count is None

    @property
    def slip_margin(self) -> float | None:
        """M / K at the angle: ±1 at the limit of friction, beyond that only against the stop."""
        if self.bend_angle is None:
            return None
        slip = self._slip
        return slip.side * slip.margin(slip.side * self.bend_angle)

    @property
    def residual(self) -> float | None:
        """(|M| − K) / (μ r) in N: 0 at a root, at the stop by how much M exceeds friction.

        With the paper's law N_m − N_f, Eq. (4).
        """
        point = self._point
        if point is None:
            return None
        return point.excess * self._slip.total / self.design.friction_coefficient  # type: ignore[no-any-return]

    @property
    def stable(self) -> bool | None:
        """Whether the unit comes back when pushed past the angle; False: it slides on to the stop.

        None where friction is not at its limit.
        """
        if self.regime is Regime.DRIVEN_TO_STOP:
            return True
        if self.regime is not Regime.EQUILIBRIUM or self._point is None:
            return None
        return self._point.slope < 0.0  # type: ignore[no-any-return]

    @property
    def normal_force(self) -> float | None:
        """N in N; None for a tracked unit where not `branch_consistent`."""
        contact = self._contact
        return contact.normal_force if contact and self._is_vouched_for else None

    @property
    def pressure(self) -> float | None:
        """P in Pa (per metre of contact depth if `contact_width` is left at 1 m)."""
        normal_force = self.normal_force
        return None if normal_force is None else normal_force / self.design.contact_area

    @property
    def forces(self) -> ContactForces | None:
        """The forces on the joint surface."""
        contact = self._contact
        return contact.forces if contact and self._is_vouched_for else None

    @property
    def force_remainder(self) -> ForceRemainder | None:
        """What Eqs. (1) and (2) leave over, one by one."""
        contact = self._contact
        return contact.remainder if contact and self._is_vouched_for else None

    @property
    def branch_consistent(self) -> bool | None:
        """Whether Eqs. (1) and (2) ask for the contact force taken.

        With the paper's law they do while F sin φ > |P|, so that N < T.
        """
        contact = self._contact
        return None if contact is None else contact.consistent

    @property
    def bend_angle_gradient(self) -> TensionGradient | None:
        """∂θ/∂T in rad/N; None also where it is infinite (two roots merging).

        Of a tracker, that of the slip that brought the unit here, while the angle is assured.
        """
        if self.is_tracked:
            return self.slip_gradient if self.angle_assured else None
        if self._point is None:
            return None
        if self.regime is Regime.DRIVEN_TO_STOP:
            return TensionGradient(0.0, 0.0)
        return root_gradient(self._slip, self._point, self.design.relative_lever)

    @property
    def pressure_gradient(self) -> TensionGradient | None:
        """∂p/∂T in Pa/N; None also where it is infinite."""
        point, by_cable = self._point, self._angle_by_cable
        if point is None or by_cable is None or not self._is_vouched_for:
            return None
        slip = self._slip
        behind, ahead = normal_by_tensions(
            slip,
            point,
            slip.law.normal_slopes(slip.load, point.cosine, point.sine, self._friction),
            self.design.relative_lever,
            angle=by_cable,
            at_limit=self._is_at_limit,
        )
        area = self.design.contact_area
        return finite(of_sides(slip.side, ByCable(behind / area, ahead / area)))

    @property
    def bend_angle_derivatives(self) -> Derivatives | None:
        """∂θ/∂x in rad per SI unit, for the tilt of the base and each number of the design.

        Of `solve`; None also where they are infinite. At the stop only the stop moves the angle.
        """
        return None if self._derivatives is None else self._derivatives[0]

    @property
    def pressure_derivatives(self) -> Derivatives | None:
        """∂p/∂x in Pa per SI unit, likewise."""
        return None if self._derivatives is None else self._derivatives[1]

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
        """Return all but design and load by name, ready for JSON: nested as dicts."""
        return {name: _plain(getattr(self, name)) for name in _REPORTED}

    # What it is worked out from

    @classmethod
    def of(cls, slip: Slip, *fields: Any, **more: Any) -> Equilibrium:
        """Make one whose slip function, towards the side of its moment, is already there."""
        made = cls(*fields, **more)
        made.__dict__['_slip'] = slip
        return made

    @cached_property
    def _slip(self) -> Slip:
        """The slip function towards the side to which the moment drives the unit."""
        tensions = Tensions(self.tension_l, self.tension_s)
        slip = taut_slip(self.design, tensions, self.load)
        return slip if self.bend_angle is None else slip.driving(self.bend_angle)

    @cached_property
    def _point(self) -> SlipPoint | None:
        if self.bend_angle is None:
            return None
        slip = self._slip
        return slip.at(slip.side * self.bend_angle)

    @cached_property
    def _contact(self) -> Contact | None:
        if self._point is None:
            return None
        return contact_at(self._slip, self._point, self._friction)

    @property
    def _is_at_limit(self) -> bool:
        return self.regime in (Regime.EQUILIBRIUM, Regime.DRIVEN_TO_STOP)

    @property
    def _friction(self) -> float:
        """The moment that friction takes up, in units of r T."""
        point = self._point
        assert point is not None
        return point.capacity if self._is_at_limit else point.moment  # type: ignore[no-any-return]

    @property
    def _is_vouched_for(self) -> bool:
        """Whether the contact force is one that the model stands behind."""
        return not self.is_tracked or bool(self.branch_consistent)

    @cached_property
    def _angle_by_cable(self) -> ByCable | None:
        """∂θ/∂T by cable, ahead, of a root; zeros where the angle does not follow."""
        point = self._point
        if self.regime is not Regime.EQUILIBRIUM or point is None:
            return ByCable(0.0, 0.0)
        if point.slope == 0.0:
            return None
        return angle_by_tensions(self._slip, point, self.design.relative_lever)

    @cached_property
    def _derivatives(self) -> tuple[Derivatives, Derivatives] | None:
        """By tilt and design. A tracked unit has been brought here by tensions of the past."""
        if self.is_tracked or self._point is None:
            return None
        return answer_derivatives(
            self.design,
            self.load,
            Tensions(self.tension_l, self.tension_s),
            *(self._slip, self._point),
            at_stop=self.regime is Regime.DRIVEN_TO_STOP,
        )


_REPORTED = (
    *('regime', 'tension_l', 'tension_s', 'bend_angle', 'angle_assured', 'slip_margin'),
    *('pressure', 'normal_force', 'root_count', 'iterations', 'stable', 'residual', 'forces'),
    *('force_remainder', 'branch_consistent', 'bend_angle_gradient', 'pressure_gradient'),
)


def _plain(value: Any) -> Any:
    if isinstance(value, Enum):
        return value.value
    return value._asdict() if hasattr(value, '_asdict') else value
