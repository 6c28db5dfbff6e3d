"""From two cable tensions to bend angle and joint pressure."""

from __future__ import annotations

import math
import numbers

from .design import JointDesign
from .equations import weight_excess
from .equilibrium import Equilibrium, Regime
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
        return Equilibrium(design, Regime.SLACK, tension_l, tension_s, root_count=0, iterations=0)

    mirrored = tension_l > tension_s
    weak, strong = (tension_s, tension_l) if mirrored else (tension_l, tension_s)
    equation = SlipEquation(design, weak, strong)
    brackets = equation.brackets(0.0, design.max_bend_angle)
    if brackets:
        bend_angle, iterations = equation.bisect(*brackets[0])
        point = equation.point(bend_angle)
        of_moment, of_force = equation.slopes_at(point)
        regime, stable = Regime.EQUILIBRIUM, of_moment < of_force
    elif equation.residual(0.0) > 0.0:
        bend_angle, iterations = design.max_bend_angle, 0
        point = equation.point(bend_angle)
        regime, stable = Regime.DRIVEN_TO_STOP, True
    else:
        return Equilibrium(design, Regime.HELD, tension_l, tension_s, root_count=0, iterations=0)

    normal_force = equation.total * point[2]
    return Equilibrium(
        design,
        regime,
        tension_l,
        tension_s,
        len(brackets),
        iterations,
        -bend_angle if mirrored else bend_angle,
        normal_force / design.contact_area,
        normal_force,
        stable,
        equation.residual_at(point),
    )


def check_tensions(design: JointDesign, tension_l: float, tension_s: float) -> tuple[float, float]:
    """Return the two tensions as floats if the model takes them; a slack cable (0 N) it does.

    Raises
    ------
    TensionError
        As `solve` does.
    """
    if type(tension_l) is not float:
        tension_l = _as_float('tension_l', tension_l)
    if not 0.0 <= tension_l <= MAX_TENSION:
        raise _out_of_range('tension_l', tension_l)
    if type(tension_s) is not float:
        tension_s = _as_float('tension_s', tension_s)
    if not 0.0 <= tension_s <= MAX_TENSION:
        raise _out_of_range('tension_s', tension_s)
    taut = tension_l > 0.0 and tension_s > 0.0
    if taut and not weight_excess(design, tension_l, tension_s) > 0.0:
        raise TensionError(
            f'tension_l + tension_s is {tension_l!r} + {tension_s!r} = '
            f'{tension_l + tension_s:.6g} N, '
            f"which must exceed the unit's weight of {design.weight:.6g} N"
        )
    return tension_l, tension_s


def _out_of_range(name: str, value: float) -> TensionError:
    return TensionError(f'{name} is {value!r} N, allowed is 0 to {MAX_TENSION:g} N')


def _as_float(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TensionError(f'{name} is {value!r}, which is not a number; it is taken in N')
    try:
        return float(value)
    except OverflowError:
        return math.inf
