"""What the model says of one pair of tensions."""

from __future__ import annotations

import math
from enum import Enum
from typing import Any, NamedTuple

from .contact import Contact, ContactForces, ForceRemainder, contact_at
from .design import JointDesign
from .sensitivity import Gradients, TensionGradient, gradients_at_limit, stddev_of


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


class Equilibrium(NamedTuple):
    """The answer of `solve`. What the model does not determine is None, never a number.

    The angle is positive towards cable s. All but `design`, regime, tensions, `root_count` and
    `iterations` are None where there is no contact force, that is in the regimes ``held`` and
    ``slack``. The forces and the gradients are worked out when they are asked for.
    """

    design: JointDesign
    regime: Regime
    tension_l: float
    """T_l in N, as given"""
    tension_s: float
    """T_s in N, as given"""
    root_count: int
    """Angles between 0 and the stop, on the side of the stronger cable, that solve Eq. (4)"""
    iterations: int
    """Halvings of the bisection; 0 where there was nothing to bisect"""
    bend_angle: float | None = None
    """θ in rad: the root nearest to 0, or the stop"""
    pressure: float | None = None
    """p in Pa (per metre of contact depth if `contact_width` is left at 1 m)"""
    normal_force: float | None = None
    """N = p C w in N"""
    stable: bool | None = None
    """Whether the unit comes back when pushed past the angle; False: it slides on to the stop"""
    residual: float | None = None
    """g(θ) = N_m − N_f in N; at the stop, by how much the moment exceeds friction"""

    @property
    def forces(self) -> ContactForces | None:
        """The forces on the joint surface."""
        contact = self._contact
        return None if contact is None else contact.forces

    @property
    def force_remainder(self) -> ForceRemainder | None:
        """What Eqs. (1) and (2) leave over, one by one."""
        contact = self._contact
        return None if contact is None else contact.remainder

    @property
    def branch_consistent(self) -> bool | None:
        """Whether μ N sin(β + θ) > W, so that Eq. (2) asks for the root taken (N < T)."""
        if self.bend_angle is None or self.normal_force is None:
            return None
        design = self.design
        phi = design.contact_centre_angle + self._side * self.bend_angle
        return design.friction_coefficient * self.normal_force * math.sin(phi) > design.weight

    @property
    def bend_angle_gradient(self) -> TensionGradient | None:
        """∂θ/∂T in rad/N; None also where it is infinite (two roots merging)."""
        return self._gradients[0]

    @property
    def pressure_gradient(self) -> TensionGradient | None:
        """∂p/∂T in Pa/N; None also where it is infinite."""
        return self._gradients[1]

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
        """Return all but the design by name, ready for JSON: nested as dicts."""
        # Spelt out, since that takes a third of the time of `_asdict`, nested four times.
        fields: dict[str, Any] = {
            'regime': self.regime.value,
            'tension_l': self.tension_l,
            'tension_s': self.tension_s,
            'root_count': self.root_count,
            'iterations': self.iterations,
            'bend_angle': self.bend_angle,
            'pressure': self.pressure,
            'normal_force': self.normal_force,
            'stable': self.stable,
            'residual': self.residual,
            'forces': None,
            'force_remainder': None,
            'branch_consistent': None,
            'bend_angle_gradient': None,
            'pressure_gradient': None,
        }
        if (contact := self._contact) is not None:
            forces, remainder, fields['branch_consistent'] = contact
            fields['forces'] = {
                'pressure_x': forces.pressure_x,
                'pressure_z': forces.pressure_z,
                'friction_x': forces.friction_x,
                'friction_z': forces.friction_z,
            }
            fields['force_remainder'] = {'x': remainder.x, 'z': remainder.z}
        of_angle, of_pressure = self._gradients
        if of_angle is not None:
            fields['bend_angle_gradient'] = _by_tension(of_angle)
        if of_pressure is not None:
            fields['pressure_gradient'] = _by_tension(of_pressure)
        return fields

    @property
    def _side(self) -> float:
        """The side of the stronger cable, to which the unit is driven."""
        return -1.0 if self.tension_l > self.tension_s else 1.0

    @property
    def _contact(self) -> Contact | None:
        if self.bend_angle is None or self.normal_force is None:
            return None
        friction_force = self._side * self.design.friction_coefficient * self.normal_force
        total = self.tension_l + self.tension_s
        return contact_at(self.design, total, self.bend_angle, self.normal_force, friction_force)

    @property
    def _gradients(self) -> Gradients:
        if self.bend_angle is None:
            return None, None
        return gradients_at_limit(
            self.design,
            self.tension_l,
            self.tension_s,
            self.bend_angle,
            self._side,
            at_stop=self.regime is Regime.DRIVEN_TO_STOP,
        )


def _by_tension(gradient: TensionGradient) -> dict[str, float]:
    return {'tension_l': gradient.tension_l, 'tension_s': gradient.tension_s}
