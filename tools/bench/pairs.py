"""Tensions as from a sensor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tendon_statics.physics import paper

NOISE = 0.002
"""Standard deviation in N of the tensions around the published ones"""


def noisy_pairs(count: int) -> NDArray[np.float64]:
    """Return pairs of T_l and T_s in N around the published ones, no two alike; ``(count, 2)``."""
    draw = np.random.default_rng(1)
    return [paper.TENSION_L, paper.TENSION_S] + NOISE * draw.standard_normal((count, 2))
