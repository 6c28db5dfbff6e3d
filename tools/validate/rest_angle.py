"""Where a hanging unit comes to rest after it has slipped, by rigid-body simulation."""

from __future__ import annotations

import math

import mujoco

from .constructions import BALL_RADIUS, HangingUnit
from .rigid_body import Settings, bend_angle, mass_for, settled, unit_on_pads

SETTINGS = Settings(time_step=4e-4)
DEPTH = 1e-4
"""How far the cables press the unit in, as a share of r; softer than for the onset, since the unit
slides far"""
DASHPOT = 0.03
"""In N·m·s/rad: keeps the sliding unit slow, and has no force at rest"""
RAMP = 2.0
"""Seconds from one tension to the next"""
AT_REST = 1e-4
"""In rad/s"""
LONGEST_WAIT = 30.0
"""In s"""


def rest_angles(unit: HangingUnit, depth: float = DEPTH) -> list[float]:
    """Return the angles in rad, one for each of the tensions."""
    pads = unit.seat.pads(SETTINGS.rings, SETTINGS.azimuths)
    total = unit.tension_l + unit.tensions_s[0]
    # The weight is a force of its own, so that the mass may be what the contacts ask for.
    mass = mass_for(pads, depth, unit.seat.clearance, total, SETTINGS)
    model = unit_on_pads(
        pads,
        unit.friction,
        unit.seat.clearance,
        SETTINGS,
        mass,
        turning_inertia=mass * BALL_RADIUS**2,
    )
    tension_s = unit.tension_l
    data = settled(model, unit.tension_l + tension_s)
    angles = []
    for goal in unit.tensions_s:
        steps = round(RAMP / SETTINGS.time_step)
        for step in range(1, steps + 1):
            _pull(model, data, unit, tension_s + (goal - tension_s) * step / steps)
        tension_s = goal
        end = data.time + LONGEST_WAIT
        while abs(data.qvel[4]) > AT_REST and data.time < end:
            _pull(model, data, unit, tension_s)
        angles.append(bend_angle(data))
    return angles


def _pull(model: mujoco.MjModel, data: mujoco.MjData, unit: HangingUnit, tension_s: float) -> None:
    data.ctrl[0] = unit.tension_l + tension_s
    data.ctrl[1] = unit.cable_moment(tension_s) - DASHPOT * data.qvel[4]
    turned = unit.weight * unit.com_distance * math.sin(bend_angle(data))
    data.xfrc_applied[1] = 0.0, 0.0, -unit.weight, 0.0, turned, 0.0
    mujoco.mj_step(model, data)
