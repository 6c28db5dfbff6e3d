"""The paper's equation as one would port it from MATLAB: NumPy, and SciPy's bisection.

Eqs. (1) to (4), with the slips of the printed Eq. (4) corrected: as they stand on the page, once
more with scalars instead of vectors and norms, and with all that does not depend on θ taken out of
the bisection.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import bisect

from tendon_statics import JointDesign

TOLERANCE = 1e-10
"""Width in rad of the bracket at which the bisection ends; the paper's"""


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
    """Return angle, pressure and the forces F_F and F_f of a case that has a root."""
    given = (design, tension_l, tension_s)
    theta = bisect(residual, 0.0, design.max_bend_angle, args=given, xtol=TOLERANCE)
    _, pressure = both_sides(theta, *given)
    c_pressure, c_friction = contact_coefficients(design, theta)
    return (
        theta,
        pressure,
        pressure * c_pressure,
        design.friction_coefficient * pressure * c_friction,
    )


def lean_sides(theta: float, design: JointDesign, tension_l: float, tension_s: float):
    """`both_sides`, and C_F and C_f, from scalar coefficients, worked out once a call."""
    radius, mu, weight = design.ball_radius, design.friction_coefficient, design.weight
    start, end = design.contact_start_angle + theta, design.contact_end_angle + theta
    across = radius * (np.cos(start) - np.cos(end))
    along = radius * (np.sin(end) - np.sin(start))
    length, total = np.sqrt(across * across + along * along), tension_l + tension_s
    moment = (tension_s - tension_l) * (radius + design.cable_offset)
    moment = moment + weight * design.com_distance * np.sin(theta)
    linear = total * length - weight * mu * across
    square = (mu * mu - 1.0) * length * length
    root = np.sqrt(linear * linear - square * (weight * weight - total * total))
    return moment / (mu * radius * length), (root - linear) / square, across, along


def lean_residual(theta: float, design: JointDesign, tension_l: float, tension_s: float):
    """Left minus right-hand side of Eq. (4), in Pa."""
    left, right, _, _ = lean_sides(theta, design, tension_l, tension_s)
    return left - right


def solve_lean(design: JointDesign, tension_l: float, tension_s: float):
    """Return what `solve` does."""
    given = (design, tension_l, tension_s)
    theta = bisect(lean_residual, 0.0, design.max_bend_angle, args=given, xtol=TOLERANCE)
    _, pressure, across, along = lean_sides(theta, *given)
    friction = design.friction_coefficient * pressure
    return (
        theta,
        pressure,
        np.array([pressure * across, pressure * along]),
        np.array([friction * along, friction * across]),
    )


def solve_leanest(design: JointDesign, tension_l: float, tension_s: float):
    """Return what `solve` does, with what does not depend on θ worked out before the bisection.

    |C_F| = |C_f| = C is the length of the contact zone, and C_fZ = C sin(β + θ), so that Eq. (4),
    multiplied by C, is a sine and a root in θ.
    """
    mu, radius, weight = design.friction_coefficient, design.ball_radius, design.weight
    beta = 0.5 * (design.contact_start_angle + design.contact_end_angle)
    half_span = 0.5 * (design.contact_end_angle - design.contact_start_angle)
    length = 2.0 * radius * np.sin(half_span)
    total = tension_l + tension_s
    offset = (tension_s - tension_l) * (radius + design.cable_offset) / (mu * radius)
    gain = weight * design.com_distance / (mu * radius)
    drag = mu * weight
    square = mu**2 - 1.0
    product = square * (total**2 - weight**2)

    def normal_force(theta: float) -> float:
        linear = total - drag * np.sin(beta + theta)
        return (np.sqrt(linear * linear + product) - linear) / square

    def difference(theta: float) -> float:
        return offset + gain * np.sin(theta) - normal_force(theta)

    theta = bisect(difference, 0.0, design.max_bend_angle, xtol=TOLERANCE)
    force = normal_force(theta)
    sine, cosine = np.sin(beta + theta), np.cos(beta + theta)
    return (
        theta,
        force / length,
        np.array([force * sine, force * cosine]),
        np.array([mu * force * cosine, mu * force * sine]),
    )
