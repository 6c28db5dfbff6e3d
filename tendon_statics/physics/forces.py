"""The forces on the joint surface, and what Eqs. (1) and (2) say to them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from .design import JointDesign
from .named import named
from .slip import Slip, SlipPoint


class ContactCoefficients(NamedTuple):
    """Integrals of a unit pressure and a unit shear over the contact arc, in m."""

    pressure_x: float
    """C_FX = C sin(β + θ)"""
    pressure_z: float
    """C_FZ = C cos(β + θ)"""
    friction_x: float
    """C_fX = C cos(β + θ)"""
    friction_z: float
    """C_fZ = C sin(β + θ)"""


def contact_coefficients(design: JointDesign, bend_angle: float) -> ContactCoefficients:
    """Contact coefficients of the paper's Eq. (4) at a bend angle in rad.

    The contact zone turns with the unit and spans θ1 + θ to θ2 + θ.
    """
    phi = design.contact_centre_angle + bend_angle
    sin_part = design.contact_length * math.sin(phi)
    cos_part = design.contact_length * math.cos(phi)
    return ContactCoefficients(
        pressure_x=sin_part, pressure_z=cos_part, friction_x=cos_part, friction_z=sin_part
    )


class ContactForces(NamedTuple):
    """Forces on the joint surface in the joint frame, in N; Eqs. (1) and (2)."""

    pressure_x: Any
    """F_FX, pressure-induced, along X"""
    pressure_z: Any
    """F_FZ, pressure-induced, along Z"""
    friction_x: Any
    """F_fX, friction, against X; so the paper counts it"""
    friction_z: Any
    """F_fZ, friction, along Z"""

    def as_dict(self) -> dict[str, Any]:
        """Return `_asdict`, spelt out, which takes a fifth of the time."""
        x, z, friction_x, friction_z = self
        return {
            'pressure_x': x,
            'pressure_z': z,
            'friction_x': friction_x,
            'friction_z': friction_z,
        }


class ForceRemainder(NamedTuple):
    """What Eqs. (1) and (2) leave over, one by one, in N.

    Zero but for rounding where a contact law meets both. The paper's merged law asks only for
    their squares to add up, so this is that law's own error bar.
    """

    x: Any
    """(N − T) sin θ − F_fX + P_x"""
    z: Any
    """(N − T) cos θ + F_fZ + P_z"""

    def as_dict(self) -> dict[str, Any]:
        """Return `_asdict`, spelt out as that of `ContactForces`."""
        x, z = self
        return {'x': x, 'z': z}


def contact_forces(
    slip: Slip, point: SlipPoint, friction: Any, normal: Any
) -> tuple[ContactForces, ForceRemainder]:
    """Return the forces on a unit at a point of its slip function; floats, or arrays.

    Parameters
    ----------
    friction : float
        Moment that friction takes up in units of r T: M, or K where friction is at its limit and a
        stop takes the rest, as a couple.
    normal : float
        N / T for it.
    """
    (pressed, pushed), (lifted, dragged), (balanced, opposed) = slip.law.contact(
        point.state, friction, normal
    )
    share, total, side = slip.share, slip.total, slip.side
    cosine, sine = point.turn
    left_along = balanced + lifted - 1.0 - share * point.cosine
    left_across = opposed + dragged + share * point.sine
    across = side * total
    # From the unit's axis, and across it to the side of slip, to X and Z.
    forces = (
        across * (pressed * sine + pushed * cosine),
        total * (pressed * cosine - pushed * sine),
        -across * (lifted * sine + dragged * cosine),
        total * (lifted * cosine - dragged * sine),
    )
    remainder = (
        across * (left_along * sine + left_across * cosine),
        total * (left_along * cosine - left_across * sine),
    )
    return named(ContactForces, forces), named(ForceRemainder, remainder)
