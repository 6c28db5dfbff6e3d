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
    slope = math.inf if at_stop else equation.slope_at(point)
    _, _, force, root, _ = point
    if slope == 0.0 or root == 0.0:
        return None, None
    far, near = derivatives(
        design, by_total=(1.0 - force) / root, by_angle=equation.force_slope_at(point), slope=slope
    )
    by_l, by_s = (far, near) if side > 0.0 else (near, far)
    angle_gradient = TensionGradient(side * by_l[0], side * by_s[0])
    pressure_gradient = TensionGradient(by_l[1], by_s[1])
    if not all(map(math.isfinite, (*angle_gradient, *pressure_gradient))):
        return None, None
    return angle_gradient, pressure_gradient


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
