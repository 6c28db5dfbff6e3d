"""What is drawn over time of an estimate of a unit."""

from __future__ import annotations

import math
from typing import Any

from .estimate_values import COVERAGE, angle_interval, pairs_of

BANDS = 2
"""How many intervals of admissible angles are drawn over time; the newest has them all"""

UNIT_NAMES = (
    *('angle', 'angle_low', 'angle_high'),  # in degrees
    *('pressure', 'pressure_low', 'pressure_high'),  # in Pa
    'slip_margin',
    *('tension_l', 'tension_s'),  # in N
    *(f'admissible_{end}_{band}' for band in range(BANDS) for end in ('low', 'high')),
)
"""Names of the columns of a unit's history"""


def unit_sample(estimate: Any) -> dict[str, float]:
    """Return what is drawn of an estimate, by name; NaN or nothing where not determined."""
    low, high = map(math.degrees, angle_interval(estimate) or (math.nan, math.nan))
    spread = COVERAGE * estimate.pressure_stddev
    sample = {
        'angle': math.degrees(estimate.bend_angle),
        'angle_low': low,
        'angle_high': high,
        'pressure': estimate.pressure,
        'pressure_low': estimate.pressure - spread,
        'pressure_high': estimate.pressure + spread,
        'slip_margin': estimate.slip_margin,
        'tension_l': estimate.tension_l,
        'tension_s': estimate.tension_s,
    }
    bands = [*pairs_of(estimate.admissible_angles)][:BANDS]
    for band, ends in enumerate(bands):
        for end, angle in zip(('low', 'high'), ends, strict=True):
            sample[f'admissible_{end}_{band}'] = math.degrees(angle)
    return sample
