"""The paper's equation as one would port it from MATLAB: NumPy, and SciPy's bisection.

Eqs. (1) to (4), with the slips of the printed Eq. (4) corrected, as they stand on the page.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import bisect

from tendon_statics import JointDesign


def contact_coefficients(design: JointDesign, theta: float):
    """Return C_F and C_f, each along X and Z."""
    start, end = design.contact_start_angle + theta, design.contact_end_angle + theta
    pressure = design.ball_radius * np.array(
        [np.cos(start) - np.cos(end), np.sin(end) - np.sin(start)]
    )
    friction = design.ball_radius * np.array(
        [np.sin(end) - np.sin(start), np.cos(start) - np.cos(end)]
    )
    return pressure, friction


def force_pressure(theta: float, design: JointDesign, tension_l: float, tension_s: float):
    """Right-hand side of Eq. (4), in Pa."""
    c_pressure, c_friction = contact_coefficients(design, theta)
    mu, total, weight = design.friction_coefficient, tension_l + tension_s, design.weight
    linear = total * np.linalg.norm(c_pressure) - weight * mu * c_friction[1]
    square = mu**2 * np.linalg.norm(c_friction) ** 2 - np.linalg.norm(c_pressure) ** 2
    root = np.sqrt(linear**2 - square * (weight**2 - total**2))
    return -(linear - root) / square


def residual(theta: float, design: JointDesign, tension_l: float, tension_s: float):
    """Left minus right-hand side of Eq. (4), in Pa."""
    _, c_friction = contact_coefficients(design, theta)
    moment = (tension_s - tension_l) * (design.ball_radius + design.cable_offset)
    moment = moment + design.weight * design.com_distance * np.sin(theta)
    arm = design.friction_coefficient * design.ball_radius * np.linalg.norm(c_friction)
    return moment / arm - force_pressure(theta, design, tension_l, tension_s)


def solve(design: JointDesign, tension_l: float, tension_s: float):
    """Return angle, pressure and the four forces of a case that has a root."""
    given = (design, tension_l, tension_s)
    theta = bisect(residual, 0.0, design.max_bend_angle, args=given, xtol=1e-10)
    pressure = force_pressure(theta, *given)
    c_pressure, c_friction = contact_coefficients(design, theta)
    return (
        theta,
        pressure,
        pressure * c_pressure,
        design.friction_coefficient * pressure * c_friction,
    )
