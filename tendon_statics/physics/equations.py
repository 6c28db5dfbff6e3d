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
from .geometry import Attitude

Point = tuple[float, float, float, float, float]
"""An angle θ, and there N_m / T, N_f / T, R / T and cos φ / cos θ"""


def weight_excess(design: JointDesign, tension_l: float, tension_s: float) -> float:
    """T_l + T_s − W in N, without loss of digits where the tensions hardly exceed the weight."""
    weight = design.weight
    excess = tension_l + tension_s - weight
    if excess > 0.01 * weight:
        return excess
    exact_weight = Fraction(design.mass) * Fraction(design.gravity)
    return float(Fraction(tension_l) + Fraction(tension_s) - exact_weight)


class NormalForces:
    """N_m, N_f and R of one design and one pair of tensions, as shares of the total tension T.

    As shares the three keep their digits at any size of T. What depends on the tensions alone is
    worked out once, here.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, their sum above the weight.

    Attributes
    ----------
    total : float
        T in N.
    offset, gain : float
        Of the moment: N_m / T = offset + gain sin θ.
    weight, friction_weight, excess, product : float
        W / T, μ W / T, 1 − W / T and 1 − (W / T)².
    """

    __slots__ = (
        'excess',
        'friction_weight',
        'gain',
        'geometry',
        'offset',
        'product',
        'total',
        'weight',
    )

    _weight_excess = staticmethod(weight_excess)

    def __init__(self, design: JointDesign, tension_l: float, tension_s: float) -> None:
        geometry = design.slip_geometry
        total = tension_l + tension_s
        self.geometry = geometry
        self.total = total
        self.offset = (tension_s - tension_l) / total * geometry.cable_gain
        self.gain = geometry.weight_gain / total
        self.weight = weight = geometry.weight / total
        self.friction_weight = geometry.friction * weight
        self.excess = excess = self._weight_excess(design, tension_l, tension_s) / total
        self.product = excess * (1.0 + weight)

    def point(self, bend_angle: float) -> Point:
        """Return the three at an angle in rad."""
        return self.point_at(self.geometry.attitude(bend_angle))

    def point_at(self, attitude: Attitude) -> Point:
        """Return the three at an attitude of the unit."""
        bend_angle, sin_theta, spare, slide, direction = attitude
        excess, product = self.excess, self.product
        b = excess + self.weight * spare
        lift = spare - excess
        root = math.sqrt(lift * lift + product * slide * slide)
        # B < 0 needs μ > 1; there the other form of the same root is the one that does not cancel.
        force = product / (b + root) if b > 0.0 else (root - b) / self.geometry.friction_excess
        return bend_angle, self.offset + self.gain * sin_theta, force, root, direction

    def quartic(self) -> tuple[float, float, float, float, float]:
        """Coefficients c0 to c4 of a quartic in t = tan(θ/2) whose roots include those of g.

        It is the quadratic of N_f with N_m put in, [(1 − μ²) N_m² − 2 B N_m + T² − W²] / T² times
        (1 + t²)². Next to a root of g it is positive where g is negative.
        """
        geometry = self.geometry
        offset, product = self.offset, self.product
        double_gain = 2.0 * self.gain
        standing = 2.0 * self.friction_weight * geometry.sine
        # 2 B − (1 − μ²) N_m, which N_m is multiplied with, as h0 + h1 t + h2 t².
        middle = 2.0 + geometry.friction_excess * offset
        h0, h2 = middle - standing, middle + standing
        h1 = geometry.friction_excess * double_gain - 4.0 * self.friction_weight * geometry.cosine
        return (
            product - offset * h0,
            -offset * h1 - double_gain * h0,
            2.0 * (product - offset * middle) - double_gain * h1,
            -offset * h1 - double_gain * h2,
            product - offset * h2,
        )


def normal_force_ratios(
    design: JointDesign, tension_l: float, tension_s: float
) -> Callable[[float], tuple[float, float, float]]:
    """Return the function θ → (N_m / T, N_f / T, R / T) of one pair of tensions.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, their sum above the weight.
    """
    forces = NormalForces(design, tension_l, tension_s)
    return lambda bend_angle: forces.point(bend_angle)[1:4]


def residual(design: JointDesign, tension_l: float, tension_s: float, bend_angle: float) -> float:
    """g(θ) = N_m − N_f in N: the corrected Eq. (4), multiplied by the contact area C w.

    For a unit that slips towards cable s; for the other side swap the tensions and negate the
    angle. Tensions in N with a sum above the weight, angle in rad.
    """
    moment, force, _ = normal_force_ratios(design, tension_l, tension_s)(bend_angle)
    return (tension_l + tension_s) * (moment - force)
