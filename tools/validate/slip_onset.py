"""The moment at which the unit slips, by rigid-body simulation."""

from __future__ import annotations

import mujoco
import numpy as np

from .constructions import BALL_RADIUS, Construction
from .rigid_body import Settings, bend_angle, mass_for, pads_for, settled, unit_on_pads

TENSION = 3.0
"""T in N; K is in proportion to it"""
FIRST_TURN = 4.0
"""In depths"""
LONGEST_TURN = 4096.0
"""In depths"""
STEADY = 1e-3
"""Relative change of the moment while the angle doubles, below which it is taken for steady"""


def held_moment(construction: Construction, friction: float, settings: Settings) -> float:
    """Turn the unit slowly, as a testing machine does; return the steady moment K / (r T)."""
    depth = settings.depth_factor * construction.depth
    pads = pads_for(construction, friction, settings)
    mass = mass_for(pads, depth, construction.clearance, TENSION, settings)
    # Nothing that friction does within a step turns so heavy a body.
    model = unit_on_pads(
        pads, friction, construction.clearance, settings, mass, turning_inertia=1e4
    )
    data = settled(model, TENSION)
    goal, before = FIRST_TURN * depth, 0.0
    while True:
        moment = _turned(model, data, goal, settings)
        if abs(moment - before) <= STEADY * moment or goal > LONGEST_TURN * depth:
            return moment
        goal, before = 2.0 * goal, moment


def _turned(model: mujoco.MjModel, data: mujoco.MjData, goal: float, settings: Settings) -> float:
    """Turn to an angle in rad; return the mean moment over the last tenth of the steps."""
    moments = []
    while bend_angle(data) < goal:
        deepest = -data.contact.dist.min() if data.ncon else 0.0
        speed = settings.slowness * max(deepest, 0.0) / (settings.contact_time * BALL_RADIUS)
        data.qvel[3:6] = 0.0, speed, 0.0
        mujoco.mj_step(model, data)
        moments.append(-data.qfrc_constraint[4])
    last = moments[-max(1, len(moments) // 10) :]
    return float(np.mean(last)) / (BALL_RADIUS * TENSION)


def ramped_moment(
    construction: Construction, friction: float, settings: Settings, rate: float, start: float
) -> float:
    """Bend the unit by a moment that grows; return K / (r T) where it has turned by ten depths.

    Parameters
    ----------
    rate : float
        Growth of M / (r T) in 1/s.
    start : float
        M / (r T) from which on it grows so slowly.
    """
    depth = settings.depth_factor * construction.depth
    pads = pads_for(construction, friction, settings)
    mass = mass_for(pads, depth, construction.clearance, TENSION, settings)
    inertia = mass * BALL_RADIUS**2
    model = unit_on_pads(pads, friction, construction.clearance, settings, mass, inertia)
    data = settled(model, TENSION)
    moment = 0.0
    while bend_angle(data) < 10.0 * depth:
        # A second to come to where it begins.
        moment += settings.time_step * (start if moment < start else rate)
        data.ctrl[1] = moment * BALL_RADIUS * TENSION
        mujoco.mj_step(model, data)
    return moment
