"""How far measured samples lie from the boundary of slip, and how far noise alone puts them.

A unit about to slip to the side σ = ±1 meets |M| / (μ r) = N_f, with the moment
M = ΔT (r + δ) + W l sin θ of the sign σ and N_f at the angle σ θ; see `equations`. What a sample
lacks of that is its excess e = |M| / (μ r) − N_f in N: 0 on the boundary, negative where friction
holds. Angle and tensions both are measured, so both carry noise into e. To first order its
variance is

    σ_e² = σ_T² [(∂e/∂T_l)² + (∂e/∂T_s)²] + σ_θ² (∂e/∂θ)²,

and e / σ_e is the distance of the sample from the boundary in units of its noise (Sampson's
distance). A measured pressure p adds the equation q = p C w − N_f = 0, whose noise is correlated
with that of e; what q says beyond e is q − (S_eq / S_ee) e with the variance S_qq − S_eq² / S_ee.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .array_roots import ArraySlipEquation, Floats
from .design import JointDesign


class Noise(NamedTuple):
    """Standard deviations of what is measured, all independent."""

    tension: float
    """σ_T of each tension in N"""
    bend_angle: float
    """σ_θ in rad"""
    pressure: float
    """σ_p in Pa"""


class BoundaryDistance(NamedTuple):
    """Distances of samples from the boundary of slip; arrays of shape ``(n,)``."""

    excess: Floats
    """e in N"""
    standardised: Floats
    """e / σ_e"""
    pressure_standardised: Floats
    """What the pressure says beyond that, in units of its noise; NaN where it is not measured"""
    side: Floats
    """σ: 1 for slipping towards cable s, −1 for cable l"""


def boundary_distance(
    design: JointDesign,
    tension_l: Floats,
    tension_s: Floats,
    bend_angle: Floats,
    pressure: Floats,
    noise: Noise,
) -> BoundaryDistance:
    """Measure the distance of samples from the boundary of slip.

    Parameters
    ----------
    tension_l, tension_s, bend_angle : ndarray
        Samples in N and rad. Where the tensions do not exceed the weight the result is NaN.
    pressure : ndarray
        In Pa; NaN where it is not measured.
    """
    with np.errstate(all='ignore'):
        moment = (tension_s - tension_l) * (design.ball_radius + design.cable_offset)
        moment = moment + design.weight * design.com_distance * np.sin(bend_angle)
        side = np.where(moment < 0.0, -1.0, 1.0)
        total = np.where(tension_l + tension_s > design.weight, tension_l + tension_s, np.nan)
        behind: Any = np.where(side > 0.0, tension_l, tension_s)
        ahead: Any = np.where(side > 0.0, tension_s, tension_l)
        equation = ArraySlipEquation(design, behind, ahead)
        _, asked, force, root, direction = equation.points(side * bend_angle)
        cos_phi = direction * np.cos(bend_angle)

        excess = total * (asked - force)
        force_by_total = (1.0 - force) / root
        weight, cable_gain = design.weight, side * design.slip_geometry.cable_gain
        force_by_angle = side * design.friction_coefficient * weight * force * cos_phi / root
        by_l, by_s = -cable_gain - force_by_total, cable_gain - force_by_total
        by_angle = side * design.slip_geometry.weight_gain * np.cos(bend_angle) - force_by_angle

        of_tension, of_angle = noise.tension**2, noise.bend_angle**2
        variance = of_tension * (by_l**2 + by_s**2) + of_angle * by_angle**2
        standardised = excess / np.sqrt(variance)

        area = design.contact_area
        covariance = -of_tension * force_by_total * (by_l + by_s)
        covariance -= of_angle * force_by_angle * by_angle
        pressure_variance = 2.0 * of_tension * force_by_total**2 + of_angle * force_by_angle**2
        pressure_variance += (noise.pressure * area) ** 2
        beyond = pressure * area - total * force - covariance / variance * excess
        pressure_variance -= covariance**2 / variance
        pressure_standardised = beyond / np.sqrt(pressure_variance)
    return BoundaryDistance(excess, standardised, pressure_standardised, side)
