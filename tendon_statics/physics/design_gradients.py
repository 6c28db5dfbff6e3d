"""How the answer of `solve` follows the tilt of the base and each number of the design.

At a root g(θ; x) = 0 of the slip function, a parameter x moves the angle by

    dθ/dx = −(∂g/∂x) / (∂g/∂θ),

and the pressure p(θ; x) of a unit about to slip by ∂p/∂x + (∂p/∂θ) dθ/dx. The slopes by θ are the
contact law's own; those by x are differences at the same θ, so that one method serves every law.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from .design import DesignParameter, JointDesign, design_parameters
from .errors import DesignError, TensionError
from .load import Load
from .slip import Slip, SlipPoint
from .tensions import Tensions, taut_slip

BASE_TILT = 'base_tilt'

Derivatives = dict[str, float]
"""``base_tilt`` and every name of `design_parameters` → derivative by it, in SI units"""

STEP = 1e-5
"""Step of the differences, as a share of the scale of a parameter: truncation and rounding then
both are some 1e-10 of the derivative"""


class _Answer(NamedTuple):
    """What depends on a parameter at one angle."""

    excess: float
    """g / (r T)"""
    pressure: float
    """p in Pa, of a unit about to slip"""


_At = Callable[[float], _Answer]
"""The answer for a change of one parameter"""


def answer_derivatives(
    design: JointDesign,
    load: Load,
    tensions: Tensions,
    slip: Slip,
    point: SlipPoint,
    *,
    at_stop: bool,
) -> tuple[Derivatives, Derivatives] | None:
    """Return the derivatives of bend angle and pressure; None where they are infinite.

    Parameters
    ----------
    slip, point : Slip, SlipPoint
        Towards the side of slip, and at the angle of the answer.
    at_stop : bool
        Whether the unit is at its stop, where the angle follows ``max_bend_angle`` alone, and not
        at a root.
    """
    if not at_stop and point.slope == 0.0:
        return None
    cosine, sine = point.turn
    ahead = math.atan2(sine, cosine)
    pressure_by_angle = _pressure_slope(slip, point) / design.contact_area
    changes = _changes(design, load, tensions, slip.side, ahead)
    angles, pressures = {}, {}
    for name, (answer, scale) in changes.items():
        by_excess, by_pressure = _difference(answer, STEP * scale)
        if at_stop:
            turned = 1.0 if name == 'max_bend_angle' else 0.0
        else:
            turned = -by_excess / point.slope
        angles[name] = slip.side * turned + 0.0  # no −0
        pressures[name] = by_pressure + pressure_by_angle * turned
    if not all(map(math.isfinite, (*angles.values(), *pressures.values()))):
        return None
    return angles, pressures


def slip_by_design(
    design: JointDesign,
    load: Load,
    tensions: Tensions,
    slip: Slip,
    ahead: float,
    parameters: Sequence[str],
) -> list[float]:
    """Return ∂g/∂x, g in units of r T, at one angle ahead in rad by some parameters.

    Parameters
    ----------
    slip : Slip
        Towards the side of slip.
    parameters : sequence of str
        Names of `design_parameters`, or ``base_tilt``.
    """
    changes = _changes(design, load, tensions, slip.side, ahead)
    found = []
    for name in parameters:
        answer, scale = changes[name]
        found.append(_difference(answer, STEP * scale)[0])
    return found


def _changes(
    design: JointDesign, load: Load, tensions: Tensions, side: float, ahead: float
) -> dict[str, tuple[_At, float]]:
    """The answer at one angle for a change of each parameter, and the parameter's scale."""

    def at(other: JointDesign, other_load: Load) -> _Answer:
        moved = taut_slip(other, tensions, other_load).facing(side)
        there = moved.at(ahead)
        normal = moved.law.contact(moved.load, there.cosine, there.sine, there.capacity).normal
        return _Answer(there.excess, moved.total * normal / other.contact_area)

    changes: dict[str, tuple[_At, float]] = {
        BASE_TILT: (lambda change: at(design, _tilted(load, change)), 1.0)
    }
    for parameter in design_parameters():
        changes[parameter.name] = (
            _changing(design, load, parameter, at),
            _scale(parameter, design, tensions),
        )
    return changes


def _pressure_slope(slip: Slip, point: SlipPoint) -> float:
    """∂N/∂θ in N, ahead, of a unit about to slip."""
    slopes = slip.law.normal_slopes(slip.load, point.cosine, point.sine, point.capacity)
    slope: float = slip.total * (slopes.by_tilt + slopes.by_moment * point.by_tilt)
    return slope


def _tilted(load: Load, change: float) -> Load:
    """Tilt the base further towards cable s; the tip force stays as it is in the joint frame."""
    x, y, z = load.gravity_direction
    cosine, sine = math.cos(change), math.sin(change)
    return dataclasses.replace(
        load, gravity_direction=(x * cosine - z * sine, y, z * cosine + x * sine)
    )


def _changing(
    design: JointDesign,
    load: Load,
    parameter: DesignParameter,
    at: Callable[[JointDesign, Load], _Answer],
) -> _At:
    value = getattr(design, parameter.name)

    def answer(change: float) -> _Answer:
        return at(dataclasses.replace(design, **{parameter.name: value + change}), load)

    return answer


def _scale(parameter: DesignParameter, design: JointDesign, tensions: Tensions) -> float:
    """Return by how much a parameter may change before the answer is quite another one."""
    total = sum(tensions)
    match parameter.unit:
        case 'm':
            # Of lengths that may be zero, the radius; the depth of the zone has its own size.
            own = parameter.name in ('ball_radius', 'contact_width')
            return float(getattr(design, parameter.name)) if own else design.ball_radius
        case 'kg':
            return design.mass or total / max(design.gravity, 1.0)
        case 'm/s^2':
            return design.gravity or 1.0
        case 'N·m/rad':
            return design.ball_radius * total
        case 'rad':
            return min(1.0, design.contact_end_angle - design.contact_start_angle)
        case _:
            return design.friction_coefficient


def _difference(answer: _At, step: float) -> tuple[float, float]:
    """Return the slopes of both numbers: central, or one-sided at the end of the range."""
    for points in ((-step, step), (0.0, step, 2.0 * step), (0.0, -step, -2.0 * step)):
        try:
            values = [answer(change) for change in points]
        except (DesignError, TensionError):
            continue
        width = points[1] - points[0]
        if len(values) == 2:
            excess, pressure = ((b - a) / width for a, b in zip(*values, strict=True))
        else:
            excess, pressure = (
                (4.0 * b - 3.0 * a - c) / (2.0 * width) for a, b, c in zip(*values, strict=True)
            )
        return excess, pressure
    return math.nan, math.nan
