"""Sessions of slips of a unit of any contact law, by the brute force that shares no code."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import brute
import numpy as np
from designs import PRELIMINARY

from tendon_statics import JointDesign, Load, Recording


class SessionPlan(NamedTuple):
    """How a session is recorded."""

    slips: int = 30
    angles: tuple[float, float] = (-0.4, 0.4)
    """rad; uniform in between"""
    totals: tuple[float, float] = (0.5, 4.0)
    """T in N; uniform in between"""
    tilts: tuple[float, ...] = (0.0,)
    """rad; of the base, in turn"""
    tip_forces: tuple[tuple[float, float], ...] = ((0.0, 0.0),)
    """N; in the joint frame, in turn"""
    tip_distance: float = 0.0
    """m"""
    pressure_stddev: float | None = None
    """As a share of the median pressure; None: there is no sensor for it"""
    tension_stddev: float = 0.01
    bend_angle_stddev: float = math.radians(0.5)


def pressure(case: brute.Case, angle: float, side: float) -> float:
    """Contact pressure in Pa of a unit that is about to slip at an angle."""
    design = case.design
    mu, r = design.friction_coefficient, design.ball_radius
    start, end = design.contact_start_angle, design.contact_end_angle
    limit = float(brute.capacity(case, angle, side))
    if design.contact_law == 'elastic_seat':
        _, axial, across = brute.forces(case, angle)
        _, c, q, mean = brute.seat_constants(start, end)
        total = case.tension_l + case.tension_s
        normal = (total + axial + mu * q * side * across) / (1.0 + c * mu**2)
        area = 2.0 * math.pi * r**2 * (math.cos(start) - math.cos(end))
        return float(normal * mean / area)
    length = 2.0 * r * math.sin(0.5 * (end - start))
    return limit / (mu * r) / (length * design.contact_width)


def slips_of(
    design: JointDesign, plan: SessionPlan, rng: np.random.Generator
) -> tuple[np.ndarray, list[Load]]:
    """Tensions, angle and pressure without noise, shape ``(n, 4)``, and the load of each."""
    rows: list[tuple[float, float, float, float]] = []
    loads: list[Load] = []
    while len(rows) < plan.slips:
        turn = len(rows)
        load = Load.tilted(
            plan.tilts[turn % len(plan.tilts)],
            plan.tip_forces[turn % len(plan.tip_forces)],
            plan.tip_distance,
        )
        angle, total = rng.uniform(*plan.angles), rng.uniform(*plan.totals)
        side = rng.choice((-1.0, 1.0))
        even = brute.Case(design, load, 0.5 * total, 0.5 * total)
        lacking = -side * float(brute.excess(even, angle, side))
        difference = lacking / (design.ball_radius + design.cable_offset)
        # Cable tensions that a person would call taut.
        if not abs(difference) < 0.95 * total:
            continue
        case = brute.Case(design, load, 0.5 * (total - difference), 0.5 * (total + difference))
        moment, _, _ = brute.forces(case, angle)
        if side * float(moment) <= 0.0:
            continue
        rows.append((case.tension_l, case.tension_s, angle, pressure(case, angle, side)))
        loads.append(load)
    return np.array(rows), loads


def recorded(
    rows: np.ndarray, loads: list[Load], plan: SessionPlan, rng: np.random.Generator
) -> tuple[Recording, float | None]:
    """The slips with noise as a recording, and the deviation of the pressure in Pa."""
    count = len(rows)
    noisy = rows.copy()
    noisy[:, :2] += plan.tension_stddev * rng.normal(size=(count, 2))
    noisy[:, 2] += plan.bend_angle_stddev * rng.normal(size=count)
    stddev = None
    if plan.pressure_stddev is not None:
        stddev = plan.pressure_stddev * float(np.median(rows[:, 3]))
        noisy[:, 3] += stddev * rng.normal(size=count)
    with_tip = any(any(force) for force in plan.tip_forces)
    recording = Recording(
        *noisy[:, :3].T,
        noisy[:, 3] if stddev is not None else None,
        base_tilt=[load.base_tilt for load in loads] if any(plan.tilts) else None,
        tip_force_x=[load.tip_force[0] for load in loads] if with_tip else None,
        tip_force_z=[load.tip_force[1] for load in loads] if with_tip else None,
    )
    return recording, stddev


def session_of(
    design: JointDesign, plan: SessionPlan, rng: np.random.Generator
) -> tuple[Recording, float | None]:
    """Return a session with noise, and the deviation of its pressure in Pa."""
    return recorded(*slips_of(design, plan, rng), plan, rng)


LAW_TRUTHS = {
    'merged': {'friction_coefficient': 0.92},
    'friction_circle': {'friction_coefficient': 0.5},
    'elastic_seat': {'friction_coefficient': 0.25},
}
"""Friction of a unit of each law, with which it slips at about half of the weak cable's tension"""


def unit_of(law: str, **changes: float) -> JointDesign:
    """A unit that is not what its drawing, the preliminary design, says."""
    return dataclasses.replace(
        PRELIMINARY,
        contact_law=law,
        **{'mass': 0.024, 'cable_offset': 0.0041, **LAW_TRUTHS[law], **changes},
    )
