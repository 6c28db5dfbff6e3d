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

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


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
    values: Mapping[str, float],
    tension_l: Floats,
    tension_s: Floats,
    bend_angle: Floats,
    pressure: Floats,
    noise: Noise,
) -> BoundaryDistance:
    """Measure the distance of samples from the boundary of slip.

    Parameters
    ----------
    values : mapping
        Parameters of a design by name. They may lie outside the ranges of `JointDesign`, for a
        search; where there is no N_f the result is NaN.
    tension_l, tension_s, bend_angle : ndarray
        Samples in N and rad.
    pressure : ndarray
        In Pa; NaN where it is not measured.
    """
    r, friction = values['ball_radius'], values['friction_coefficient']
    arm = r + values['cable_offset']
    weight = values['mass'] * values['gravity']
    start, end = values['contact_start_angle'], values['contact_end_angle']
    area = 2.0 * r * np.sin(0.5 * (end - start)) * values['contact_width']
    com = values['com_distance']
    with np.errstate(invalid='ignore', divide='ignore'):
        moment = (tension_s - tension_l) * arm + weight * com * np.sin(bend_angle)
        side = np.where(moment < 0.0, -1.0, 1.0)
        phi = 0.5 * (start + end) + side * bend_angle
        total = tension_l + tension_s
        force, root = _force_at_limit(friction, weight, total, np.sin(phi), np.cos(phi))

        excess = abs(moment) / (friction * r) - force
        force_by_total = (total - force) / root
        force_by_angle = side * friction * weight * force * np.cos(phi) / root
        lever = side * arm / (friction * r)
        by_l, by_s = -lever - force_by_total, lever - force_by_total
        by_angle = side * weight * com * np.cos(bend_angle) / (friction * r) - force_by_angle

        of_tension, of_angle = noise.tension**2, noise.bend_angle**2
        variance = of_tension * (by_l**2 + by_s**2) + of_angle * by_angle**2
        standardised = excess / np.sqrt(variance)

        covariance = -of_tension * force_by_total * (by_l + by_s)
        covariance -= of_angle * force_by_angle * by_angle
        pressure_variance = 2.0 * of_tension * force_by_total**2 + of_angle * force_by_angle**2
        pressure_variance += (noise.pressure * area) ** 2
        beyond = pressure * area - force - covariance / variance * excess
        pressure_variance -= covariance**2 / variance
        pressure_standardised = beyond / np.sqrt(pressure_variance)
    return BoundaryDistance(excess, standardised, pressure_standardised, side)


def _force_at_limit(
    friction: float, weight: float, total: Floats, sin_phi: Floats, cos_phi: Floats
) -> tuple[Floats, Floats]:
    """N_f and R in N, in the forms of `equations` that do not cancel; NaN unless T > W."""
    product = np.where(total > weight, total**2 - weight**2, np.nan)
    b = total - friction * weight * sin_phi
    root = np.sqrt((weight - friction * total * sin_phi) ** 2 + friction**2 * product * cos_phi**2)
    other = (root - b) / ((friction - 1.0) * (friction + 1.0)) if friction != 1.0 else np.nan
    return np.where(b > 0.0, product / (b + root), other), root
