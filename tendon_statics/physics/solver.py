"""From two cable tensions to bend angle and joint pressure."""

from __future__ import annotations

import math
import numbers

from .contact import contact_at
from .design import JointDesign
from .equations import normal_force_ratios, weight_excess
from .equilibrium import Equilibrium, Regime, TensionGradient
from .errors import TensionError
from .roots import SlipEquation

MAX_TENSION = 1e9
"""Largest tension in N that is taken; far above any cable, far below overflow."""


def solve(design: JointDesign, tension_l: float, tension_s: float) -> Equilibrium:
    """Solve the quasi-static equilibrium of one unit for a pair of cable tensions.

    The corrected Eq. (4) is bisected on [0, θ_max] to 1e-10 rad, on the side of the stronger
    cable: tensions with T_l > T_s are the mirror image, equal ones count as pulling towards s.
    Of several roots the one nearest to 0 is returned, and all are counted.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions T_l and T_s in N.

    Raises
    ------
    TensionError
        If a tension is not a number, not finite, negative or above `MAX_TENSION`, or if the two
        do not add up to more than the unit's weight.
    """
    tension_l, tension_s = check_tensions(design, tension_l, tension_s)
    if tension_l == 0.0 or tension_s == 0.0:
        return Equilibrium(Regime.SLACK, tension_l, tension_s, root_count=0, iterations=0)

    weak, strong = sorted((tension_l, tension_s))
    equation = SlipEquation(design, weak, strong)
    brackets = equation.brackets(0.0, design.max_bend_angle)
    if brackets:
        bend_angle, iterations = equation.bisect(*brackets[0])
        slope = equation.slope(bend_angle)
        regime, stable = Regime.EQUILIBRIUM, slope < 0.0
    elif equation.residual(0.0) > 0.0:
        bend_angle, iterations = design.max_bend_angle, 0
        slope = math.inf  # The stop does not give way: ∂θ/∂T = 0.
        regime, stable = Regime.DRIVEN_TO_STOP, True
    else:
        return Equilibrium(Regime.HELD, tension_l, tension_s, root_count=0, iterations=0)

    return _equilibrium_at(
        design,
        tension_l,
        tension_s,
        regime=regime,
        stable=stable,
        root_count=len(brackets),
        iterations=iterations,
        bend_angle=bend_angle,
        residual=equation.residual(bend_angle),
        slope=slope,
    )


def check_tensions(design: JointDesign, tension_l: float, tension_s: float) -> tuple[float, float]:
    """Return the two tensions as floats if the model takes them; a slack cable (0 N) it does.

    Raises
    ------
    TensionError
        As `solve` does.
    """
    checked: list[float] = []
    for name, value in (('tension_l', tension_l), ('tension_s', tension_s)):
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise TensionError(f'{name} is {value!r}, which is not a number; it is taken in N')
        try:
            tension = float(value)
        except OverflowError:
            tension = math.inf
        if not 0.0 <= tension <= MAX_TENSION:
            raise TensionError(f'{name} is {tension!r} N, allowed is 0 to {MAX_TENSION:g} N')
        checked.append(tension)
    total = sum(checked)
    if min(checked) > 0.0 and not weight_excess(design, *checked) > 0.0:
        raise TensionError(
            f'tension_l + tension_s is {checked[0]!r} + {checked[1]!r} = {total:.6g} N, '
            f"which must exceed the unit's weight of {design.weight:.6g} N"
        )
    return checked[0], checked[1]


def _equilibrium_at(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    *,
    regime: Regime,
    stable: bool,
    root_count: int,
    iterations: int,
    bend_angle: float,
    residual: float,
    slope: float,
) -> Equilibrium:
    """All fields of the result at a non-negative angle towards the stronger cable.

    `slope` is ∂g/∂θ in N/rad; infinite where the angle does not follow the tensions.
    """
    side = -1.0 if tension_l > tension_s else 1.0
    total = tension_l + tension_s
    _, force_ratio, _ = normal_force_ratios(design, tension_l, tension_s)(bend_angle)
    normal_force = total * force_ratio
    friction_force = side * design.friction_coefficient * normal_force

    contact = contact_at(design, total, side * bend_angle, normal_force, friction_force)
    angle_gradient, pressure_gradient = gradients_at_limit(
        design, tension_l, tension_s, side * bend_angle, side, slope
    )

    return Equilibrium(
        regime=regime,
        tension_l=tension_l,
        tension_s=tension_s,
        root_count=root_count,
        iterations=iterations,
        bend_angle=side * bend_angle,
        pressure=normal_force / design.contact_area,
        normal_force=normal_force,
        stable=stable,
        residual=residual,
        forces=contact.forces,
        force_remainder=contact.remainder,
        branch_consistent=contact.branch_consistent,
        bend_angle_gradient=angle_gradient,
        pressure_gradient=pressure_gradient,
    )


def gradients_at_limit(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    bend_angle: float,
    side: float,
    slope: float,
) -> tuple[TensionGradient | None, TensionGradient | None]:
    """Derivatives of angle and pressure of a unit about to slip; None where they are infinite.

    θ from g(θ, T_l, T_s) = 0, then p from N_f(θ, T_l + T_s).

    Parameters
    ----------
    bend_angle : float
        Angle θ in rad.
    side : float
        1 for slipping towards cable s, −1 for cable l.
    slope : float
        ∂g/∂θ on that side in N/rad; infinite for an angle that does not follow the tensions.
    """
    friction = design.friction_coefficient
    total = tension_l + tension_s
    angle = side * bend_angle
    _, force_ratio, root_ratio = normal_force_ratios(design, tension_l, tension_s)(angle)
    if slope == 0.0 or root_ratio == 0.0:
        return None, None
    normal_force, root = total * force_ratio, total * root_ratio
    lever = (design.ball_radius + design.cable_offset) / (friction * design.ball_radius)
    by_total = (total - normal_force) / root
    cos_phi = math.cos(design.contact_centre_angle + angle)
    by_angle = friction * design.weight * normal_force * cos_phi / root
    # By the tension of the cable towards which it slips, and by that of the other.
    angle_by_near, angle_by_far = (by_total - lever) / slope, (by_total + lever) / slope
    near = (side * angle_by_near, (by_total + by_angle * angle_by_near) / design.contact_area)
    far = (side * angle_by_far, (by_total + by_angle * angle_by_far) / design.contact_area)
    by_l, by_s = (far, near) if side > 0.0 else (near, far)
    angle_gradient = TensionGradient(by_l[0], by_s[0])
    pressure_gradient = TensionGradient(by_l[1], by_s[1])
    if not all(map(math.isfinite, (*angle_gradient, *pressure_gradient))):
        return None, None
    return angle_gradient, pressure_gradient
