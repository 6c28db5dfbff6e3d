"""Random joint designs and tensions, and two designs."""

from __future__ import annotations

import dataclasses
import math
import random
from collections.abc import Iterator
from typing import Any

import numpy as np
from hypothesis import strategies as st

from tendon_statics import JointDesign, default_design_path, load_design

PRELIMINARY = load_design(default_design_path())

HANGING = dataclasses.replace(
    PRELIMINARY, com_distance=-0.02, mass=0.08, contact_law='friction_circle'
)
"""Comes to rest between the stops"""


def random_design(draw: random.Random) -> JointDesign:
    """Draw a design as a builder might make it: standing or hanging, smooth or rough."""
    start = draw.uniform(0.0, math.radians(80.0))
    return JointDesign(
        ball_radius=draw.uniform(0.002, 0.02),
        cable_offset=draw.uniform(0.0, 0.006),
        com_distance=draw.uniform(-0.03, 0.05),
        mass=math.exp(draw.uniform(math.log(0.002), math.log(0.3))),
        friction_coefficient=draw.choice((1.0, 1.0 + 1e-9, draw.uniform(0.05, 1.6))),
        contact_start_angle=start,
        contact_end_angle=start + draw.uniform(math.radians(5.0), math.radians(60.0)),
        max_bend_angle=draw.uniform(math.radians(10.0), math.radians(60.0)),
        gravity=9.81,
    )


def random_tensions(design: JointDesign, draw: random.Random) -> tuple[float, float]:
    """Draw tensions over all regimes, half of them on the verge of slipping at some angle."""
    total = design.weight * draw.uniform(1.05, 3.0) + draw.choice((0.0, draw.uniform(0.0, 30.0)))
    share = draw.uniform(0.02, 0.98)
    tension_l, tension_s = total * share, total * (1.0 - share)
    if draw.random() < 0.5:
        return tension_l, tension_s
    slipping = tensions_at_slip(design, draw.uniform(0.0, design.max_bend_angle), total)
    if min(slipping) <= 0.0:
        return tension_l, tension_s
    return slipping if draw.random() < 0.5 else slipping[::-1]


def tensions_at_slip(design: JointDesign, bend_angle: float, total: float) -> tuple[float, float]:
    """Tensions of a given sum at which the unit is about to slip at a given angle.

    Worked from Eqs. (1) to (3) as they stand, by SciPy's root finder instead of a formula.
    """
    from scipy.optimize import brentq

    friction, weight = design.friction_coefficient, design.weight
    phi = design.contact_centre_angle + bend_angle

    cosine, sine = math.cos(phi), math.sin(phi)

    def square_sum(normal: Any) -> Any:
        x = friction * normal * cosine
        z = weight - friction * normal * sine
        return (total - normal) ** 2 - x * x - z * z

    normal = brentq(square_sum, 0.0, _first_sign_change(square_sum, total), xtol=1e-15)
    moment = friction * design.ball_radius * normal
    moment -= weight * design.com_distance * math.sin(bend_angle)
    difference = moment / (design.ball_radius + design.cable_offset)
    return 0.5 * (total - difference), 0.5 * (total + difference)


def _first_sign_change(function, start: float) -> float:
    """Return the end of the shortest interval from 0 at which a function is negative."""
    steps = 4000
    values = 2.0 * start * np.arange(1, steps + 1) / steps
    return float(values[function(values) < 0.0][0])


def random_cases(count: int, seed: int) -> Iterator[tuple[JointDesign, float, float]]:
    """Yield designs with tensions, the same for the same seed."""
    draw = random.Random(seed)
    for _ in range(count):
        design = random_design(draw)
        yield design, *random_tensions(design, draw)


@st.composite
def cases(draw: st.DrawFn) -> tuple[JointDesign, float, float]:
    """Draw a design with tensions."""
    source = draw(st.randoms(use_true_random=False))
    design = random_design(source)
    return design, *random_tensions(design, source)
