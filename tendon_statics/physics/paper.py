"""What the paper prints: its published case, Eq. (4) as it stands on the page, its bisection."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Collection
from enum import Enum

from .design import JointDesign
from .forces import contact_coefficients
from .load import UPRIGHT
from .regime import Regime
from .solver import solve
from .tensions import Tensions, taut_slip

TENSION_L, TENSION_S = 1.0, 2.0
"""Published input, N"""
BEND_ANGLE = math.radians(17.14)
"""Published result, rad"""
PRESSURE = 405.6
"""Published result, Pa"""

TOLERANCE = 1e-10
"""Width of the bracket at which its bisection ends, rad"""


def identify_mass_and_offset(design: JointDesign) -> JointDesign:
    """Return the design with the mass and cable offset that give the published result.

    With θ and p known, N = p C is known, and the square sum of Eqs. (1) and (2) is a quadratic
    in the weight, W² − 2 μ N sin φ W + (μ N)² − (T − N)² = 0. Its smaller root is the only one
    below T. Eq. (3) then gives δ.
    """
    total = TENSION_L + TENSION_S
    normal_force = PRESSURE * design.contact_length  # the paper's zone is 1 m deep
    friction = design.friction_coefficient * normal_force
    phi = design.contact_centre_angle + BEND_ANGLE
    weight = friction * math.sin(phi) - math.sqrt(
        (total - normal_force) ** 2 - (friction * math.cos(phi)) ** 2
    )
    moment = friction * design.ball_radius - weight * design.com_distance * math.sin(BEND_ANGLE)
    return dataclasses.replace(
        design,
        mass=weight / design.gravity,
        cable_offset=moment / (TENSION_S - TENSION_L) - design.ball_radius,
    )


class Misprint(Enum):
    """A place where the printed Eq. (4) differs from what Eqs. (1) to (3) give."""

    GROUPING = 'T (|C_F| − m g μ C_fZ), which adds m to N m; for T |C_F| − m g μ C_fZ'
    FRICTION_POWER = 'μ C_f²; for μ² C_f², since friction is μ p C_f'
    SIGN = 'the sign of the whole right-hand side'


def force_pressure(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    bend_angle: float,
    misprints: Collection[Misprint] = (),
) -> float | None:
    """Right-hand side of Eq. (4) in Pa, with these of its misprints; None if not real.

    With none it is N_f / (C w), though not in a form that keeps its digits near μ = 1.
    Numbers are taken as they stand where the units do not fit.
    """
    arc = contact_coefficients(design, bend_angle)
    friction, weight = design.friction_coefficient, design.weight
    total = tension_l + tension_s
    pressure_square = arc.pressure_x**2 + arc.pressure_z**2
    friction_square = arc.friction_x**2 + arc.friction_z**2
    if Misprint.GROUPING in misprints:
        linear = total * (math.sqrt(pressure_square) - weight * friction * arc.friction_z)
    else:
        linear = total * math.sqrt(pressure_square) - weight * friction * arc.friction_z
    power = 1 if Misprint.FRICTION_POWER in misprints else 2
    square = friction**power * friction_square - pressure_square
    discriminant = linear**2 - square * (weight**2 - total**2)
    if discriminant < 0.0 or square == 0.0:
        return None
    sign = 1.0 if Misprint.SIGN in misprints else -1.0
    return sign * (linear - math.sqrt(discriminant)) / square / design.contact_width


def moment_pressure(
    design: JointDesign, tension_l: float, tension_s: float, bend_angle: float
) -> float:
    """Left-hand side of Eq. (4), in Pa: the pressure that the moment Eq. (3) asks for."""
    arc = contact_coefficients(design, bend_angle)
    cables = (tension_s - tension_l) * (design.ball_radius + design.cable_offset)
    weight = design.weight * design.com_distance * math.sin(bend_angle)
    friction_square = arc.friction_x**2 + arc.friction_z**2
    resisting_arm = design.friction_coefficient * design.ball_radius
    return (cables + weight) / (resisting_arm * math.sqrt(friction_square) * design.contact_width)


def bisect(design: JointDesign, tension_l: float, tension_s: float) -> tuple[float, int] | None:
    """Solve the corrected Eq. (4) as the paper does, by plain bisection from 0 to the stop.

    `solve` answers the same from the same equation, in a few steps.

    Returns
    -------
    (float, int) or None
        θ in rad, the middle of the last bracket, and the halvings that it took; None where the two
        sides do not change order over the range.
    """

    def is_above(angle: float) -> bool:
        left = moment_pressure(design, tension_l, tension_s, angle)
        right = force_pressure(design, tension_l, tension_s, angle)
        return right is not None and left > right

    low, high = 0.0, design.max_bend_angle
    above_at_low = is_above(low)
    if above_at_low is is_above(high):
        return None
    halvings = 0
    while high - low > TOLERANCE:
        middle = 0.5 * (low + high)
        if is_above(middle) is above_at_low:
            low = middle
        else:
            high = middle
        halvings += 1
    return 0.5 * (low + high), halvings


def equilibrium_band(design: JointDesign) -> tuple[float, float]:
    """Return the tensions of cable s, in N, between which there is a root at the published T_l.

    For a design with a root in the published case.
    """

    def is_at_a_root(tension_s: float) -> bool:
        return solve(design, TENSION_L, tension_s).regime is Regime.EQUILIBRIUM

    return (
        slipping_tension(design),
        _edge(is_at_a_root, TENSION_S, 10.0 * TENSION_S),
    )


def slipping_tension(design: JointDesign) -> float:
    """Return the tension of cable s, in N, up to which the unit is held at the published T_l."""

    def is_held(tension_s: float) -> bool:
        return solve(design, TENSION_L, tension_s).regime is Regime.HELD

    return _edge(is_held, TENSION_L, 100.0 * TENSION_S)


def slipping_friction(design: JointDesign) -> float:
    """Return the friction coefficient below which the unit slips at the published tensions."""

    def slips(friction: float) -> bool:
        unit = dataclasses.replace(design, friction_coefficient=friction)
        return solve(unit, TENSION_L, TENSION_S).regime is not Regime.HELD

    return _edge(slips, 0.01, 10.0)


def bare_capacity(design: JointDesign) -> float:
    """Return K / (r T) of a design without a load, which is its law's and its friction's alone."""
    bare = dataclasses.replace(design, mass=0.0)
    slip = taut_slip(bare, Tensions(TENSION_L, TENSION_S), UPRIGHT)
    return slip.at(0.0).capacity  # type: ignore[no-any-return]


def _edge(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Return up to where something holds that does at `low` and not at `high`, by halving."""
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        if holds(middle):
            low = middle
        else:
            high = middle
    return low
