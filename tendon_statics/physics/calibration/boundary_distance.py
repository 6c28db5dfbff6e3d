"""How far measured samples lie from the boundary of slip, and how far noise alone puts them.

A unit about to slip to the side σ = ±1 meets |M| = K, with the moment M of Eq. (3), of the sign σ,
and the capacity K of the contact law at the angle σ θ; see `slip`. What a sample lacks of that is
its excess e = (|M| − K) / (μ r) in N: 0 on the boundary, negative where friction holds. Angle and
tensions both are measured, so both carry noise into e. To first order its variance is

    σ_e² = σ_T² [(∂e/∂T_l)² + (∂e/∂T_s)²] + σ_θ² (∂e/∂θ)²,

and e / σ_e is the distance of the sample from the boundary in units of its noise (Sampson's
distance). A measured pressure p adds the equation q = p A − N = 0 with the law's own contact force
N at slip and area A = N / p, whose noise is correlated with that of e; what q says beyond e is
q − (S_eq / S_ee) e with the variance S_qq − S_eq² / S_ee.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..array_numbers import ARRAYS
from ..array_roots import Floats
from ..design import JointDesign
from ..gradients import normal_by_tensions, slip_by_tensions
from ..load import UPRIGHT, Load
from ..loaded_joint import LoadedJoint
from ..sample_loads import SampleLoads, seating_tension
from ..slip import Slip
from ..stacked_design import StackedDesign
from .load_cells import AS_MEASURED, LoadCells


class Noise(NamedTuple):
    """Standard deviations of what is measured, all independent."""

    tension: float
    """σ_T of each tension in N"""
    bend_angle: float
    """σ_θ in rad"""
    pressure: float
    """σ_p in Pa"""


class BoundaryDistance(NamedTuple):
    """Distances of samples from the boundary of slip; arrays of the shape of the samples."""

    excess: Floats
    """e in N"""
    standardised: Floats
    """e / σ_e"""
    pressure_standardised: Floats
    """What the pressure says beyond that, in units of its noise; NaN where it is not measured"""
    side: Floats
    """σ: 1 for slipping towards cable s, −1 for cable l"""


def boundary_distance(
    design: JointDesign | StackedDesign,
    tension_l: Floats,
    tension_s: Floats,
    bend_angle: Floats,
    pressure: Floats,
    noise: Noise,
    load: Load | SampleLoads = UPRIGHT,
    cells: LoadCells = AS_MEASURED,
) -> BoundaryDistance:
    """Measure the distance of samples from the boundary of slip.

    Parameters
    ----------
    design : JointDesign or StackedDesign
        Of several designs, to whose boundaries it is then measured, samples are in columns of
        shape ``(n, 1)``.
    tension_l, tension_s, bend_angle : ndarray
        Samples in N and rad, as measured. Where the tensions do not seat the joint the result is
        NaN.
    pressure : ndarray
        In Pa; NaN where it is not measured.
    noise : Noise
        Of what is measured.
    load : Load or SampleLoads
        Of all samples, or of each.
    cells : LoadCells
        What makes tensions of the measured ones.
    """
    with np.errstate(all='ignore'):
        tension_l, tension_s = cells.tensions(tension_l, tension_s)
        total = tension_l + tension_s
        dead = load.on(design)
        total = np.where(total > seating_tension(design, dead), total, np.nan)
        joint = LoadedJoint.of(design, dead)
        slip = Slip(joint, total - dead.size, tension_l, tension_s, numbers=ARRAYS)
        moment = slip.moment_at(bend_angle)
        slip = slip.facing(np.where(moment < 0.0, -1.0, 1.0))
        point = slip.at(slip.side * bend_angle)

        scale = 1.0 / design.friction_coefficient
        excess = scale * total * point.excess
        lever = design.relative_lever
        by_behind, by_ahead = (scale * total * by for by in slip_by_tensions(slip, point, lever))
        # Of r T g, which adds g itself to the derivatives of g.
        by_behind, by_ahead = by_behind + scale * point.excess, by_ahead + scale * point.excess
        by_angle = scale * total * point.slope

        towards_s = slip.side > 0.0
        of_behind = (noise.tension * np.where(towards_s, cells.gain_l, cells.gain_s)) ** 2
        of_ahead = (noise.tension * np.where(towards_s, cells.gain_s, cells.gain_l)) ** 2
        of_angle = noise.bend_angle**2
        variance = of_behind * by_behind**2 + of_ahead * by_ahead**2 + of_angle * by_angle**2
        standardised = excess / np.sqrt(variance)
        side: Any = slip.side
        if np.isnan(pressure).all():
            return BoundaryDistance(excess, standardised, np.full_like(excess, np.nan), side)

        slopes = slip.law.normal_slopes(point.state, point.capacity)
        normal, _, normal_by_tilt, normal_by_moment = slopes
        force_by_behind, force_by_ahead = normal_by_tensions(
            slip, point, slopes, lever, angle=(0.0, 0.0), at_limit=True
        )
        force_by_angle = total * (normal_by_tilt + normal_by_moment * point.by_tilt)

        # q = p A − N: all its noise but that of p comes with the minus of N.
        area = design.contact_area
        covariance = -of_behind * force_by_behind * by_behind
        covariance -= of_ahead * force_by_ahead * by_ahead + of_angle * force_by_angle * by_angle
        pressure_variance = of_behind * force_by_behind**2 + of_ahead * force_by_ahead**2
        pressure_variance += of_angle * force_by_angle**2 + (noise.pressure * area) ** 2
        beyond = pressure * area - total * normal - covariance / variance * excess
        pressure_variance -= covariance**2 / variance
        pressure_standardised = beyond / np.sqrt(pressure_variance)
    return BoundaryDistance(excess, standardised, pressure_standardised, side)
