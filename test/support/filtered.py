"""What tests of an estimator that filters need, of a unit's and of an arm's."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from stamps import stamp

NOISE = 0.02
"""N, of each tension"""

LAG = 0.5
"""s; a busy machine leaves longer gaps than 0.05 s, and nothing before a gap of a lag stays"""

FILTERING = (
    *('-p', 'estimation:=filtering', '-p', f'tension_stddev:={NOISE}'),
    *('-p', f'filter_lag:={LAG}'),
)
"""Arguments of the estimator"""


def noisy(tensions: Sequence[float], count: int) -> list[list[float]]:
    """Return so many readings in N of the same tensions."""
    noise = np.random.default_rng(4).normal(0.0, NOISE, (count, len(tensions)))
    readings: list[list[float]] = (np.array(tensions) + noise).tolist()
    return readings


def smoothed(committed: Sequence[Any], estimates: Sequence[Any]) -> list[Any]:
    """Return those committed that another followed in time, which a busy machine may delay."""
    stamps = [stamp(estimate) for estimate in estimates]
    return [
        one for one in committed if any(0 < other - stamp(one) < 1e9 * LAG for other in stamps)
    ]
