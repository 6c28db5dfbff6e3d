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
