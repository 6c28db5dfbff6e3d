"""The unit as a rigid body on a fixed ball, in MuJoCo.

It touches the ball with many small pads, each a contact with an elliptic friction cone. Each pad
is a spring along the ball's normal, as stiff as the part of the seat that it stands for is large.
The mass is a means to an end: what is asked does not depend on it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from .constructions import BALL_RADIUS, Construction, LooseBowl, Pads

PAD_RADIUS = 0.02 * BALL_RADIUS
SETTLED = 0.4
"""Seconds for the cables to take up their tension, twice the time over which they pull harder"""


@dataclass(frozen=True)
class Settings:
    """Numerical settings; what they change is in docs/validation.md."""

    time_step: float = 1e-4
    """In s"""
    steps_per_contact_time: float = 10.0
    """Contact time constant, in time steps"""
    damping_ratio: float = 0.7
    """Of the contacts; pressure and friction, which depend on each other, flutter with less"""
    impedance: float = 0.9
    """MuJoCo's `solimp`, the same at any depth"""
    friction_impedance_ratio: float = 1e4
    """MuJoCo's `impratio`: how much harder friction is than pressure"""
    no_slip_iterations: int = 0
    """Not needed where friction is so much harder; they change nothing and double the time"""
    slowness: float = 0.004
    """How fast the unit is turned: its surface moves by this share of the contacts' depth within a
    contact time"""
    depth_factor: float = 1.0
    """How far the unit is pressed in, times the construction's depth"""
    rings: int = 4
    azimuths: int = 24
    across: int = 8
    """Pads of a tight seat, and over the patch of a loose bowl"""

    @property
    def contact_time(self) -> float:
        """Time constant of a contact in s."""
        return self.steps_per_contact_time * self.time_step


def pads_for(construction: Construction, friction: float, settings: Settings) -> Pads:
    """Return the pads of a construction; those of a bowl reach to where its patch slips."""
    if isinstance(construction, LooseBowl):
        return construction.pads(settings.across, math.degrees(math.atan(friction)))
    return construction.pads(settings.rings, settings.azimuths)


def mass_for(pads: Pads, depth: float, clearance: float, tension: float, settings: Settings):
    """Return the mass in kg with which a tension presses the unit in by a depth, without friction.

    MuJoCo's contacts have a stiffness in proportion to the mass they carry.
    """
    axial = pads.directions[:, 2]
    gaps = np.maximum(0.0, (depth + clearance) * axial - clearance)
    pressed = len(axial) * float(np.sum(pads.shares * gaps * axial)) * BALL_RADIUS
    softness = (1.0 - settings.impedance) * settings.contact_time**2
    return tension * softness / pressed


def unit_on_pads(
    pads: Pads,
    friction: float,
    clearance: float,
    settings: Settings,
    mass: float,
    turning_inertia: float,
) -> mujoco.MjModel:
    """Return the model: actuator 0 pulls along the unit in N, actuator 1 bends it in N·m."""
    spec = mujoco.MjSpec()
    spec.memory = 256 << 20
    option = spec.option
    option.timestep = settings.time_step
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = settings.friction_impedance_ratio
    option.noslip_iterations = settings.no_slip_iterations
    option.tolerance = option.noslip_tolerance = 1e-18
    option.gravity = (0.0, 0.0, 0.0)
    sphere = mujoco.mjtGeom.mjGEOM_SPHERE
    spec.worldbody.add_geom(type=sphere, size=(BALL_RADIUS, 0, 0), contype=1, conaffinity=0)
    unit = spec.worldbody.add_body(name='unit', pos=(0.0, 0.0, -clearance * BALL_RADIUS))
    unit.add_freejoint()
    unit.explicitinertial = True
    unit.mass, unit.inertia = mass, [turning_inertia] * 3
    stiffness = settings.contact_time**-2
    damping = 2.0 * settings.damping_ratio / settings.contact_time
    reach = (1.0 + clearance) * BALL_RADIUS + PAD_RADIUS
    for direction, share in zip(pads.directions, len(pads.shares) * pads.shares, strict=True):
        unit.add_geom(
            type=sphere,
            size=(PAD_RADIUS, 0, 0),
            pos=reach * direction,
            mass=0.0,
            contype=0,
            conaffinity=1,
            priority=1,
            condim=3,
            friction=(friction, 0.0, 0.0),
            solref=(-share * stiffness, -share * damping),
            solimp=(settings.impedance, settings.impedance, 1.0, 0.5, 2.0),
        )
    unit.add_site(name='centre')
    for gear in ((0, 0, -1, 0, 0, 0), (0, 0, 0, 0, 1, 0)):
        # Both turn with the unit, as the cables' forces do.
        spec.add_actuator(trntype=mujoco.mjtTrn.mjTRN_SITE, target='centre', gear=gear)
    return spec.compile()


def bend_angle(data: mujoco.MjData) -> float:
    """Return θ in rad."""
    axis_x, axis_z = data.site_xmat[0][2], data.site_xmat[0][8]
    return math.atan2(axis_x, axis_z)


def settled(model: mujoco.MjModel, tension: float) -> mujoco.MjData:
    """Let the cables pull the unit into its seat, harder and harder up to a tension in N."""
    data = mujoco.MjData(model)
    steps = round(SETTLED / model.opt.timestep)
    for step in range(steps):
        data.ctrl[0] = tension * min(1.0, 2.0 * step / steps)
        mujoco.mj_step(model, data)
    return data
