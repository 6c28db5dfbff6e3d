"""Where friction can hold the unit: friction as a set, not a number.

Friction takes any value up to its limit in either direction, so it can hold every angle θ with

    −μ r N_f(−θ) ≤ ΔT (r + δ) + W l sin θ ≤ μ r N_f(θ),

that is g(θ) ≤ 0 for slipping towards cable s, and the mirrored g(−θ) ≤ 0 for cable l.
"""

from __future__ import annotations

import math
import numbers
from itertools import pairwise

from .design import JointDesign
from .equations import normal_force_ratios
from .errors import BendAngleError, TensionError
from .roots import SlipEquation
from .solver import check_tensions

Interval = tuple[float, float]

ROUNDING = 1e-12
"""Excess of a margin over 1 that may be rounding"""


def admissible_angles(design: JointDesign, tension_l: float, tension_s: float) -> list[Interval]:
    """Return the angles at which friction can hold the unit, as closed intervals in rad.

    They are ascending and disjoint, within [−θ_max, θ_max]; there may be none, one or several.
    Every angle of `solve`'s regime ``equilibrium`` is an end of one.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, both above 0.

    Raises
    ------
    TensionError
        As `solve` does, and for a slack cable.
    """
    tension_l, tension_s = check_taut(design, tension_l, tension_s)
    towards_s = _angles_below_limit(design, tension_l, tension_s)
    towards_l = _angles_below_limit(design, tension_s, tension_l)
    mirrored = [(-high, -low) for low, high in reversed(towards_l)]
    common = [(max(a[0], b[0]), min(a[1], b[1])) for a in towards_s for b in mirrored]
    return [(low, high) for low, high in common if low <= high]


def slip_margin(
    design: JointDesign, tension_l: float, tension_s: float, bend_angle: float
) -> float:
    """Return the signed share of the friction limit that holding an angle asks for.

    It is M / (μ r N) with the moment M = ΔT (r + δ) + W l sin θ and the contact force N = N_f at
    the limit on the side of M. Within [−1, 1] friction can hold the angle; above 1 the unit slips
    towards cable s, below −1 towards cable l; at 0 it asks nothing of friction.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, both above 0.
    bend_angle : float
        Angle θ in rad, within ±θ_max.

    Raises
    ------
    TensionError
        As `solve` does, and for a slack cable.
    BendAngleError
        If the angle is not a number or lies beyond the stop.
    """
    tension_l, tension_s = check_taut(design, tension_l, tension_s)
    bend_angle = check_bend_angle(design, bend_angle)
    return margin_at(design, tension_l, tension_s, bend_angle)


def margin_at(design: JointDesign, tension_l: float, tension_s: float, bend_angle: float) -> float:
    """`slip_margin` of values that have been checked.

    A root is exact to the rounding of the margin, so what exceeds 1 by that alone is taken for 1:
    the ends of the admissible intervals are held.
    """
    ratios = normal_force_ratios(design, tension_l, tension_s)
    moment, force, _ = ratios(bend_angle)
    if moment < 0.0:
        _, force, _ = ratios(-bend_angle)
    margin = moment / force
    return math.copysign(1.0, margin) if 1.0 < abs(margin) <= 1.0 + ROUNDING else margin


def check_taut(design: JointDesign, tension_l: float, tension_s: float) -> Interval:
    """Return two tensions as floats that the model takes, none of them slack.

    Raises
    ------
    TensionError
        If it does not.
    """
    tension_l, tension_s = check_tensions(design, tension_l, tension_s)
    if tension_l == 0.0 or tension_s == 0.0:
        slack = 'tension_l' if tension_l == 0.0 else 'tension_s'
        raise TensionError(f'{slack} is 0.0 N: the cable is slack, which is outside the model')
    return tension_l, tension_s


def check_bend_angle(design: JointDesign, bend_angle: float) -> float:
    """Return a bend angle as a float within the stops.

    Raises
    ------
    BendAngleError
        If it is not a number or lies beyond a stop.
    """
    stop = design.max_bend_angle
    is_number = isinstance(bend_angle, numbers.Real) and not isinstance(bend_angle, bool)
    if not (is_number and -stop <= bend_angle <= stop):
        raise BendAngleError(
            f'bend_angle is {bend_angle!r} rad, allowed is {-stop:.6g} to {stop:.6g} rad'
        )
    return float(bend_angle)


def _angles_below_limit(design: JointDesign, tension_l: float, tension_s: float) -> list[Interval]:
    """Angles with g ≤ 0, where the unit does not slip towards cable s."""
    equation = SlipEquation(design, tension_l, tension_s)
    stop = design.max_bend_angle
    roots = [equation.bisect(low, high)[0] for low, high in equation.brackets(-stop, stop)]
    found: list[Interval] = []
    for low, high in pairwise([-stop, *roots, stop]):
        if low < high and equation.residual(0.5 * (low + high)) <= 0.0:
            if found and found[-1][1] == low:
                # g changes sign at a root, so one side is below zero by rounding: the narrow one.
                if high - low <= low - found[-1][0]:
                    continue
                found.pop()
            found.append((low, high))
    # A root at the very end of the range, with g above zero beside it, is a point of its own.
    for root in roots:
        if not any(low <= root <= high for low, high in found):
            found.append((root, root))
    # So is a stop that is at the limit but for rounding.
    for end in (-stop, stop):
        at_limit = margin_at(design, tension_l, tension_s, end) == 1.0
        if at_limit and not any(low <= end <= high for low, high in found):
            found.append((end, end))
    return sorted(found)
