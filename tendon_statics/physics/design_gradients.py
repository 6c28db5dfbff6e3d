"""How the answer of `solve` follows the tilt of the base and each number of the design.

At a root g(θ; x) = 0 of the slip function, a parameter x moves the angle by

    dθ/dx = −(∂g/∂x) / (∂g/∂θ),

and the pressure p(θ; x) of a unit about to slip by ∂p/∂x + (∂p/∂θ) dθ/dx. The derivatives are
differences of g and p, which serve every contact law, and no root is searched for them.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from .design import DesignParameter, JointDesign, design_parameters
from .errors import DesignError, TensionError
from .load import Load

Derivatives = dict[str, float]
"""``base_tilt`` and every name of `design_parameters` → derivative by it, in SI units"""

STEP = 1e-5
"""Step of the differences, as a share of the scale of a parameter: truncation and rounding then
both are some 1e-10 of the derivative"""

STENCILS = (
    ((-1.0, -0.5), (1.0, 0.5)),
    ((0.0, -1.5), (1.0, 2.0), (2.0, -0.5)),
    ((0.0, 1.5), (-1.0, -2.0), (-2.0, 0.5)),
)
"""Places in steps and weights of differences: central, or one-sided at the end of a range"""


class SlipAnswer(NamedTuple):
    """What is known of a unit at some angle, taken to be about to slip there."""

    excess: float
    """g in N, towards the side of slip"""
    pressure: float
    """p in Pa"""


Ask = Callable[[JointDesign, Load, float], SlipAnswer]
"""The answer for a design, a load and a bend angle in rad"""


def answer_derivatives(
    ask: Ask, design: JointDesign, load: Load, bend_angle: float, total: float, *, at_stop: bool
) -> tuple[Derivatives, Derivatives] | None:
    """Return the derivatives of bend angle and pressure; None where they are infinite.

    Parameters
    ----------
    total : float
        T in N.
    at_stop : bool
        Whether the unit is at its stop, where the angle follows ``max_bend_angle`` alone, and not
        at a root.
    """

    def turned(change: float) -> SlipAnswer:
        return ask(design, load, bend_angle + change)

    def tilted(change: float) -> SlipAnswer:
        return ask(design, _tilted(load, change), bend_angle)

    def changed(parameter: DesignParameter) -> Callable[[float], SlipAnswer]:
        value = getattr(design, parameter.name)

        def answer(change: float) -> SlipAnswer:
            return ask(_changed(design, parameter.name, value + change), load, bend_angle)

        return answer

    slopes = {'base_tilt': _slopes(tilted, STEP)}
    for parameter in design_parameters():
        step = STEP * _scale(parameter, design, total)
        slopes[parameter.name] = _slopes(changed(parameter), step)
    by_angle = _slopes(turned, STEP)
    if not at_stop and by_angle.excess == 0.0:
        return None
    angles, pressures = {}, {}
    for name, by_parameter in slopes.items():
        if not at_stop:
            angle = -by_parameter.excess / by_angle.excess
        else:
            angle = math.copysign(1.0, bend_angle) if name == 'max_bend_angle' else 0.0
        angles[name] = angle + 0.0  # no −0
        pressures[name] = by_parameter.pressure + by_angle.pressure * angle
    if not all(map(math.isfinite, (*angles.values(), *pressures.values()))):
        return None
    return angles, pressures


@lru_cache(256)
def _changed(design: JointDesign, name: str, value: float) -> JointDesign:
    """Return a design with another number; every sample of a unit asks for the same ones."""
    other: dict[str, Any] = {name: value}
    return dataclasses.replace(design, **other)


def excess_by_design(
    excess: Callable[[JointDesign], float], design: JointDesign, names: Sequence[str], total: float
) -> list[float]:
    """Return the derivatives of a slip function at one angle by some parameters of the design.

    Parameters
    ----------
    excess : callable
        The slip function of a design there, in any unit.
    names : sequence of str
        Of `design_parameters`.
    total : float
        T in N.
    """
    known = {parameter.name: parameter for parameter in design_parameters()}

    def slope(name: str) -> float:
        value = getattr(design, name)

        def answer(change: float) -> SlipAnswer:
            return SlipAnswer(excess(_changed(design, name, value + change)), 0.0)

        return _slopes(answer, STEP * _scale(known[name], design, total)).excess

    return [slope(name) for name in names]


def neighbours(design: JointDesign, name: str, total: float) -> list[tuple[JointDesign, float]]:
    """Return designs next to one by a parameter, and weights.

    What they have, times the weights, sums up to its derivative by the parameter.

    Parameters
    ----------
    name : str
        Of `design_parameters`.
    total : float
        T in N.
    """
    (parameter,) = (one for one in design_parameters() if one.name == name)
    value, step = getattr(design, name), STEP * _scale(parameter, design, total)
    for stencil in STENCILS:
        try:
            return [
                (_changed(design, name, value + place * step), weight / step)
                for place, weight in stencil
            ]
        except DesignError:
            continue
    return [(design, math.nan)]


def _tilted(load: Load, change: float) -> Load:
    """Tilt the base further towards cable s; the tip force stays as it is in the joint frame."""
    x, y, z = load.gravity_direction
    cosine, sine = math.cos(change), math.sin(change)
    return dataclasses.replace(
        load, gravity_direction=(x * cosine - z * sine, y, z * cosine + x * sine)
    )


def _scale(parameter: DesignParameter, design: JointDesign, total: float) -> float:
    """Return by how much a parameter may change before the answer is quite another one."""
    if parameter.name in ('cable_offset', 'com_distance'):  # which may be zero
        return design.ball_radius
    match parameter.unit:
        case 'kg':
            return design.mass or total / max(design.gravity, 1.0)
        case 'm/s^2':
            return design.gravity or 1.0
        case 'N·m/rad':
            return design.ball_radius * total
        case 'rad':
            return min(1.0, design.contact_end_angle - design.contact_start_angle)
        case _:
            return float(getattr(design, parameter.name))


def _slopes(answer: Callable[[float], SlipAnswer], step: float) -> SlipAnswer:
    """Return the slopes of both numbers, by the first of `STENCILS` that is allowed."""
    for stencil in STENCILS:
        try:
            values = [answer(place * step) for place, _ in stencil]
        except (DesignError, TensionError):
            continue
        weights = [weight for _, weight in stencil]
        return SlipAnswer(
            *(
                math.fsum(w * v for w, v in zip(weights, of, strict=True)) / step
                for of in zip(*values, strict=True)
            )
        )
    return SlipAnswer(math.nan, math.nan)
