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


def both_sides(theta: float, design: JointDesign, tension_l: float, tension_s: float):
    """Left and right-hand side of Eq. (4), in Pa."""
    c_pressure, c_friction = contact_coefficients(design, theta)
    pressure_norm, friction_norm = np.linalg.norm(c_pressure), np.linalg.norm(c_friction)
    mu, total, weight = design.friction_coefficient, tension_l + tension_s, design.weight
    moment = (tension_s - tension_l) * (design.ball_radius + design.cable_offset)
    moment = moment + weight * design.com_distance * np.sin(theta)
    linear = total * pressure_norm - weight * mu * c_friction[1]
    square = mu**2 * friction_norm**2 - pressure_norm**2
    root = np.sqrt(linear**2 - square * (weight**2 - total**2))
    return moment / (mu * design.ball_radius * friction_norm), -(linear - root) / square


def residual(theta: float, design: JointDesign, tension_l: float, tension_s: float):
    """Left minus right-hand side of Eq. (4), in Pa."""
    left, right = both_sides(theta, design, tension_l, tension_s)
    return left - right


def solve(design: JointDesign, tension_l: float, tension_s: float):
    """Return angle, pressure and the four forces of a case that has a root."""
    given = (design, tension_l, tension_s)
    theta = bisect(residual, 0.0, design.max_bend_angle, args=given, xtol=1e-10)
    _, pressure = both_sides(theta, *given)
    c_pressure, c_friction = contact_coefficients(design, theta)
    return (
        theta,
        pressure,
        pressure * c_pressure,
        design.friction_coefficient * pressure * c_friction,
    )
