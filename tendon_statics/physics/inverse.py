"""From a bend angle and a joint pressure, or a total tension, back to the cable tensions."""

from __future__ import annotations

import math
import numbers

from .admissible import check_bend_angle
from .design import JointDesign
from .errors import TensionError, UnreachableError
from .load import UPRIGHT, Load
from .regime import Regime
from .slip import NEGLIGIBLE_LOAD
from .solver import solve
from .tensions import Tensions, taut_slip

ROUND_TRIP_TOLERANCE = 1e-9
"""How far, in rad, `solve` may end from the angle that was asked for."""


def tensions_for(
    design: JointDesign,
    bend_angle: float,
    *,
    pressure: float | None = None,
    total_tension: float | None = None,
    load: Load = UPRIGHT,
) -> Tensions:
    """Return the tensions at which the unit is about to slip at a given angle.

    M = K solved for the tensions, in closed form. `solve` of the result gives the
    angle back, to 1e-9 rad; at 0 and at a stop it is aimed at 5e-10 rad inside the range.

    Parameters
    ----------
    bend_angle : float
        Angle θ in rad; its sign is the side to which the unit is about to slip, + for 0.
    pressure : float, optional
        Mean joint pressure p in Pa.
    total_tension : float, optional
        T_l + T_s in N. Just one of the two is given.
    load : Load
        What acts beside the cables.

    Raises
    ------
    UnreachableError
        If no pair of tensions does it, with the reason: a cable would have to push, the pressure
        is not positive, the total does not exceed the weight, or `solve` would answer otherwise.
    BendAngleError
        If the angle is not a number or lies beyond the stop.
    TypeError
        If not just one of pressure and total tension is given.
    """
    if (pressure is None) == (total_tension is None):
        raise TypeError('give either pressure or total_tension')
    bend_angle = check_bend_angle(design, bend_angle)
    # Just inside the range, so that rounding does not put the root beyond its end.
    inset = 0.5 * ROUND_TRIP_TOLERANCE
    angle = min(max(abs(bend_angle), inset), design.max_bend_angle - inset)
    side = -1.0 if bend_angle < 0.0 else 1.0
    pressure = _checked_number('pressure', pressure)
    total = _checked_number('total_tension', total_tension)
    if pressure is not None:
        if not 0.0 < pressure < math.inf:
            raise UnreachableError(f'pressure is {pressure!r} Pa, which must be above 0 Pa')
        axial, across = load.on(design).at(side * angle)
        normal_force = pressure * design.contact_area
        total = design.law.total_tension(axial, side * across, normal_force)
    assert total is not None
    if not 0.0 < total < math.inf:
        what = 'total_tension' if pressure is None else 'the total tension for that'
        raise UnreachableError(f'{what} is {total!r} N, which no pair of cables has')
    try:
        slip = taut_slip(design, Tensions(0.5 * total, 0.5 * total), load)
    except TensionError as error:
        raise UnreachableError(str(error)) from None
    if side < 0.0:
        slip = slip.mirrored()
    # With equal tensions M is all but that of the cables, which make up for what K has beyond it.
    difference = -slip.value(angle) * total / design.relative_lever
    weak, strong = 0.5 * (total - difference), 0.5 * (total + difference)
    tensions = Tensions(strong, weak) if bend_angle < 0.0 else Tensions(weak, strong)
    if min(tensions) <= 0.0:
        cable = 'l' if tensions.tension_l <= 0.0 else 's'
        raise UnreachableError(
            f'cable {cable} would have to push: it would need {min(tensions):.6g} N at '
            f'{bend_angle:.6g} rad'
        )
    _check_round_trip(design, tensions, bend_angle, load)
    return tensions


def _checked_number(name: str, value: float | None) -> float | None:
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise UnreachableError(f'{name} is {value!r}, which is not a number')
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _check_round_trip(
    design: JointDesign, tensions: Tensions, bend_angle: float, load: Load
) -> None:
    """Refuse tensions that `solve` takes for something else."""
    asked = (
        f'the unit is about to slip at {bend_angle:.6g} rad with {tensions.tension_l:.6g} N and '
        f'{tensions.tension_s:.6g} N, but solve would not say so'
    )
    try:
        answer = solve(design, *tensions, load)
    except TensionError as error:
        raise UnreachableError(str(error)) from None
    if load.on(design).size + design.stiffness / design.ball_radius < NEGLIGIBLE_LOAD * sum(
        tensions
    ):
        raise UnreachableError(
            f"the unit's weight of {design.weight:.6g} N is next to nothing beside "
            f'{sum(tensions):.6g} N of tension, so that no angle is determined'
        )
    if answer.regime is Regime.HELD or answer.bend_angle is None:
        raise UnreachableError(
            f'{asked}: its weight, not the stronger cable, drives it ({answer.regime})'
        )
    missed = abs(answer.bend_angle - bend_angle) > ROUND_TRIP_TOLERANCE
    if missed or answer.regime is Regime.DRIVEN_TO_STOP:
        raise UnreachableError(f'{asked}: it also is at {answer.bend_angle:.6g} rad')
