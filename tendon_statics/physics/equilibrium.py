"""What the model says of one pair of tensions."""

from __future__ import annotations

import math
from enum import Enum
from typing import Any, NamedTuple

from .contact import ContactForces, ForceRemainder


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


class TensionGradient(NamedTuple):
    """Derivatives of one quantity by the two cable tensions."""

    tension_l: float
    tension_s: float

    def stddev(self, tension_stddev: float) -> float:
        """Standard deviation of the quantity, to first order.

        Parameters
        ----------
        tension_stddev : float
            Standard deviation of each tension in N, the two independent.
        """
        return tension_stddev * math.hypot(self.tension_l, self.tension_s)


def stddev_of(gradient: TensionGradient | None, tension_stddev: float) -> float | None:
    """Return `TensionGradient.stddev` where there is a gradient, else None."""
    return None if gradient is None else gradient.stddev(tension_stddev)


def plain_fields(result: Any) -> dict[str, Any]:
    """Return the fields of a named tuple, ready for JSON: nested as dicts, enums as values."""
    return {name: _plain(value) for name, value in result._asdict().items()}


def _plain(value: Any) -> Any:
    if isinstance(value, Enum):
        return value.value
    return value._asdict() if hasattr(value, '_asdict') else value


class Equilibrium(NamedTuple):
    """The answer of `solve`. What the model does not determine is None, never a number.

    The angle is positive towards cable s. All but the first four fields and `iterations` are None
    where there is no contact force, that is in the regimes ``held`` and ``slack``.
    """

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
    forces: ContactForces | None = None
    force_remainder: ForceRemainder | None = None
    branch_consistent: bool | None = None
    """Whether μ N sin(β + θ) > W, so that Eq. (2) asks for the root taken (N < T)"""
    bend_angle_gradient: TensionGradient | None = None
    """∂θ/∂T in rad/N; None also where it is infinite (two roots merging)"""
    pressure_gradient: TensionGradient | None = None
    """∂p/∂T in Pa/N; None also where it is infinite"""

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
        return plain_fields(self)
