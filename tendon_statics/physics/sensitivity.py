"""How angle and pressure follow the two cable tensions, and their uncertainty from that."""

from __future__ import annotations

import math
from typing import NamedTuple

from .design import JointDesign
from .roots import SlipEquation


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


Gradients = tuple[TensionGradient | None, TensionGradient | None]
"""∂θ/∂T in rad/N and ∂p/∂T in Pa/N"""


def stddev_of(gradient: TensionGradient | None, tension_stddev: float) -> float | None:
    """Return `TensionGradient.stddev` where there is a gradient, else None."""
    return None if gradient is None else gradient.stddev(tension_stddev)


def gradients_at_limit(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    bend_angle: float,
    side: float,
    *,
    at_stop: bool = False,
) -> Gradients:
    """Derivatives of angle and pressure of a unit about to slip; None where they are infinite.

    Parameters
    ----------
    bend_angle : float
        Angle θ in rad.
    side : float
        1 for slipping towards cable s, −1 for cable l.
    at_stop : bool
        Whether the unit is driven against the stop, so that the angle does not follow.
    """
    behind, ahead = (tension_l, tension_s) if side > 0.0 else (tension_s, tension_l)
    equation = SlipEquation(design, behind, ahead)
    point = equation.point(side * bend_angle)
    of_moment, of_force = equation.slopes_at(point)
    slope = math.inf if at_stop else of_moment - of_force
    _, _, force, root, _ = point
    if slope == 0.0 or root == 0.0:
        return None, None
    behind_it, ahead_of_it = derivatives(design, (1.0 - force) / root, of_force, slope)
    (angle_by_l, pressure_by_l), (angle_by_s, pressure_by_s) = (
        (behind_it, ahead_of_it) if side > 0.0 else (ahead_of_it, behind_it)
    )
    finite = math.isfinite
    if not (
        finite(angle_by_l)
        and finite(angle_by_s)
        and finite(pressure_by_l)
        and finite(pressure_by_s)
    ):
        return None, None
    return (
        TensionGradient(side * angle_by_l, side * angle_by_s),
        TensionGradient(pressure_by_l, pressure_by_s),
    )


def derivatives(
    design: JointDesign, by_total: float, by_angle: float, slope: float
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Derivatives of angle and pressure by the tension behind the unit and by that ahead of it.

    θ from g(θ, T_l, T_s) = 0, then p from N_f(θ, T_l + T_s). Floats, or arrays of one shape.

    Parameters
    ----------
    by_total, by_angle : float
        ∂N_f/∂T, which is (T − N_f) / R, and ∂N_f/∂θ in N/rad.
    slope : float
        ∂g/∂θ in N/rad; infinite for an angle that does not follow the tensions.
    """
    cable_gain, area = design.slip_geometry.cable_gain, design.contact_area
    behind, ahead = (by_total + cable_gain) / slope, (by_total - cable_gain) / slope
    return (
        (behind, (by_total + by_angle * behind) / area),
        (ahead, (by_total + by_angle * ahead) / area),
    )
