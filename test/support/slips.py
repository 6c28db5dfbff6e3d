"""Samples of a unit that is about to slip, from Eqs. (1) to (3) as they stand."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from designs import PRELIMINARY, tensions_at_slip

from tendon_statics import JointDesign, Recording

TRUTH = dataclasses.replace(
    PRELIMINARY, mass=0.024, cable_offset=0.0041, friction_coefficient=0.92
)
"""A unit that is not what its drawing, the preliminary design, says"""

TENSION_STDDEV, BEND_ANGLE_STDDEV, PRESSURE_STDDEV = 0.01, math.radians(0.5), 8.0


def slipping_samples(
    count: int, rng: np.random.Generator, design: JointDesign = TRUTH
) -> np.ndarray:
    """Tensions, angle and pressure without noise, shape ``(count, 4)``."""
    rows = []
    while len(rows) < count:
        angle, total = rng.uniform(-0.4, 0.4), rng.uniform(0.5, 4.0)
        weak, strong = tensions_at_slip(design, abs(angle), total)
        if weak <= 0.0:
            continue
        moment = (strong - weak) * (design.ball_radius + design.cable_offset)
        moment += design.weight * design.com_distance * math.sin(abs(angle))
        normal_force = moment / (design.friction_coefficient * design.ball_radius)
        pair = (weak, strong) if angle > 0.0 else (strong, weak)
        rows.append((*pair, angle, normal_force / design.contact_area))
    return np.array(rows)


def measured(samples: np.ndarray, rng: np.random.Generator, share: float = 1.0) -> np.ndarray:
    """The samples with noise, or a share of it."""
    stddevs = [TENSION_STDDEV, TENSION_STDDEV, BEND_ANGLE_STDDEV, PRESSURE_STDDEV]
    return samples + share * rng.normal(size=samples.shape) * stddevs


def recording(samples: np.ndarray, with_pressure: bool = True, **more) -> Recording:
    """The samples as a recording."""
    tension_l, tension_s, bend_angle, pressure = samples.T
    return Recording(tension_l, tension_s, bend_angle, pressure if with_pressure else None, **more)


def session(
    slips: np.ndarray, rng: np.random.Generator, ramp: int = 80, at_stop: int = 40
) -> Recording:
    """A slow ramp up to each of the slips, and rest at the stop after it, all with noise.

    The ramp begins at equal tensions and reaches the boundary in so small steps that its last
    samples are as good as on it. Beyond it the unit lies against its stop, on either side of
    which the noise of the angle puts it.
    """
    rows, state = [], []
    for tension_l, tension_s, angle, pressure in slips:
        weak = min(tension_l, tension_s)
        for share in np.linspace(0.0, 1.0, ramp + 1) ** 0.5:
            pair = [weak + share * (tension - weak) for tension in (tension_l, tension_s)]
            rows.append((*pair, angle, math.nan))
        rows[-1] = (tension_l, tension_s, angle, pressure)
        state += ['held'] * ramp + ['slipping']
        side = math.copysign(TRUTH.max_bend_angle, tension_s - tension_l)
        rows += [(tension_l, tension_s, side, math.nan)] * at_stop
        state += ['held'] * at_stop
    return recording(measured(np.array(rows), rng), state=state)
