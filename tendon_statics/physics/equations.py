"""The static equilibrium of one unit on the verge of slipping.

The paper's Eqs. (1) to (3) with friction at its limit, F = μ N, ask for two normal forces N at a
bend angle θ (φ = β + θ is the direction of the contact force, T = T_l + T_s, ΔT = T_s − T_l):

- Eq. (3), the moment:          N_m = [ΔT (r + δ) + W l sin θ] / (μ r)
- Eqs. (1) and (2), the forces: (T − N)² = (μ N)² + W² − 2 W μ N sin φ,
  smaller positive root:        N_f = (T² − W²) / (B + R),      B = T − μ W sin φ

The unit is about to slip where the two agree: g(θ) = N_m − N_f = 0. R is the root of the
discriminant. Written as B² − (1 − μ²)(T² − W²) it can cancel; the same number as a sum of squares,
R² = (W − μ T sin φ)² + μ² (T² − W²) cos² φ, cannot, and shows that it is real for T > W.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

from .design import JointDesign


def normal_force_ratios(
    design: JointDesign, tension_l: float, tension_s: float
) -> Callable[[float], tuple[float, float, float]]:
    """Return the function θ → (N_m / T, N_f / T, R / T) of one pair of tensions.

    What depends on design and tensions alone is computed here, once; the function returned is
    what a root finder calls. As shares of the total tension T the three keep their digits at any
    size of T.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, their sum above the weight.
    """
    friction = design.friction_coefficient
    total = tension_l + tension_s
    weight = design.weight / total
    resisting_arm = friction * design.ball_radius
    cable_arm = design.ball_radius + design.cable_offset
    moment_offset = (tension_s - tension_l) / total * cable_arm / resisting_arm
    moment_gain = weight * design.com_distance / resisting_arm
    excess = weight_excess(design, tension_l, tension_s) / total
    product = excess * (1.0 + weight)
    friction_squared_product = friction * friction * product
    friction_excess = (friction - 1.0) * (friction + 1.0)
    sin_beta = math.sin(design.contact_centre_angle)
    cos_beta = math.cos(design.contact_centre_angle)
    sin, cos, sqrt = math.sin, math.cos, math.sqrt

    def ratios(bend_angle: float) -> tuple[float, float, float]:
        sin_theta = sin(bend_angle)
        cos_theta = cos(bend_angle)
        sin_phi = sin_beta * cos_theta + cos_beta * sin_theta
        cos_phi = cos_beta * cos_theta - sin_beta * sin_theta
        # 1 − μ sin φ, in terms that do not cancel; B and W − μ T sin φ both follow from it.
        below_one = cos_phi * cos_phi / (1.0 + sin_phi) if sin_phi > 0.0 else 1.0 - sin_phi
        spare = 1.0 - friction + friction * below_one
        b = excess + weight * spare
        lift = spare - excess
        root = sqrt(lift * lift + friction_squared_product * cos_phi * cos_phi)
        # B < 0 needs μ > 1; there the other form of the same root is the one that does not cancel.
        force = product / (b + root) if b > 0.0 else (root - b) / friction_excess
        return moment_offset + moment_gain * sin_theta, force, root

    return ratios


def weight_excess(design: JointDesign, tension_l: float, tension_s: float) -> float:
    """T_l + T_s − W in N, without loss of digits where the tensions hardly exceed the weight."""
    excess = tension_l + tension_s - design.weight
    if excess > 0.01 * design.weight:
        return excess
    weight = Fraction(design.mass) * Fraction(design.gravity)
    return float(Fraction(tension_l) + Fraction(tension_s) - weight)


def residual(design: JointDesign, tension_l: float, tension_s: float, bend_angle: float) -> float:
    """g(θ) = N_m − N_f in N: the corrected Eq. (4), multiplied by the contact area C w.

    For a unit that slips towards cable s; for the other side swap the tensions and negate the
    angle. Tensions in N with a sum above the weight, angle in rad.
    """
    moment, force, _ = normal_force_ratios(design, tension_l, tension_s)(bend_angle)
    return (tension_l + tension_s) * (moment - force)
