"""The contact between unit and ball: its coefficients, and the forces on it.

For a unit that friction keeps from slipping towards cable s (F > 0) the contact force points
along φ = β + θ; from slipping towards cable l it is the mirror image, φ = β − θ.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from .design import JointDesign


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
    """Forces on the joint surface in the ground frame, in N; Eqs. (1) and (2)."""

    pressure_x: float
    """F_FX = N sin φ, pressure-induced, along X_G"""
    pressure_z: float
    """F_FZ = N cos φ, pressure-induced, along Z_G"""
    friction_x: float
    """F_fX = F cos φ, friction, along X_G"""
    friction_z: float
    """F_fZ = F sin φ, friction, along Z_G"""


class ForceRemainder(NamedTuple):
    """What Eqs. (1) and (2) leave over when they are not merged into Eq. (4), in N.

    Zero would mean that both are met; the merge asks only for their squares to add up, so this is
    the model's own error bar.
    """

    x: float
    """(N − T) sin θ − F_fX"""
    z: float
    """(N − T) cos θ + F_fZ − W"""


class Contact(NamedTuple):
    """A contact force and friction, split up and held against Eqs. (1) and (2)."""

    forces: ContactForces
    remainder: ForceRemainder
    branch_consistent: bool
    """Whether F sin φ > W, so that Eq. (2) asks for the root with N < T"""


def contact_at(
    design: JointDesign,
    total_tension: float,
    bend_angle: float,
    normal_force: float,
    friction_force: float,
) -> Contact:
    """Split the contact force N and the friction F, both in N, of a unit at an angle in rad.

    The sign of F is the side towards which the unit would slip without it, positive for s.
    """
    side = math.copysign(1.0, friction_force)
    phi = design.contact_centre_angle + side * bend_angle
    return split_contact(
        design,
        total_tension,
        normal_force,
        friction_force,
        phi=(side * math.sin(phi), math.cos(phi)),
        theta=(math.sin(bend_angle), math.cos(bend_angle)),
    )


def split_contact(
    design: JointDesign,
    total_tension: float,
    normal_force: float,
    friction_force: float,
    phi: tuple[float, float],
    theta: tuple[float, float],
) -> Contact:
    """Work out `contact_at` from sine and cosine of both angles; floats, or arrays of one shape.

    The sine of φ comes with the sign of F.
    """
    sin_phi, cos_phi = phi
    sin_theta, cos_theta = theta
    friction_x, friction_z = friction_force * cos_phi, friction_force * sin_phi
    lift = normal_force - total_tension
    return Contact(
        ContactForces(normal_force * sin_phi, normal_force * cos_phi, friction_x, friction_z),
        ForceRemainder(
            lift * sin_theta - friction_x, lift * cos_theta + friction_z - design.weight
        ),
        friction_z > design.weight,
    )
