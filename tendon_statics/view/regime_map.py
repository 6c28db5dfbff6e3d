"""Which regime each pair of tensions has, for the map."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..physics import JointDesign, Load, Regime
from ..physics.batch import INVALID, REGIME_CODES, solve_batch

POINTS = 100
"""Pairs along each side"""

CODES = (INVALID, *(REGIME_CODES[regime] for regime in Regime))
"""The numbers in a map, ascending"""

ROOM = 1.25
"""How far the map reaches, in multiples of the largest tension that is to be on it"""

STEPS = (1.0, 1.5, 2.0, 3.0, 5.0, 7.5, 10.0)
"""Ends of a map, but for a power of ten"""

SAME_DIRECTION = math.cos(math.radians(0.5))
SAME_FORCE = 0.02
"""Share of the weight by which a force may change before it makes another map"""


def map_end(largest: float) -> float:
    """Return up to which tension in N a map is to reach, so that a tension is well on it."""
    needed = max(ROOM * largest, 1e-3)
    power: float = 10.0 ** math.floor(math.log10(needed))
    return next(step * power for step in (*STEPS, 20.0) if step * power >= needed)


def regimes_over_tensions(design: JointDesign, load: Load, end: float) -> NDArray[np.int8]:
    """Return codes of regimes, of shape (`POINTS`, `POINTS`): row by T_s, column by T_l.

    Each stands for the middle of its cell; the cells reach from 0 to `end` N.
    """
    middles = (np.arange(POINTS) + 0.5) * (end / POINTS)
    answers = solve_batch(design, middles[None, :], middles[:, None], load)
    return answers.regime


def gives_same_map(design: JointDesign, one: Load, other: Load) -> bool:
    """Whether two loads differ by no more than a map of regimes shows."""
    along = math.fsum(
        a * b for a, b in zip(one.gravity_direction, other.gravity_direction, strict=True)
    )
    change = math.dist(one.tip_force, other.tip_force)
    return (
        along >= SAME_DIRECTION
        and change <= SAME_FORCE * design.weight
        and one.tip_distance == other.tip_distance
    )
