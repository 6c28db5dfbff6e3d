"""A sample of the filter: what it costs, and whether that grows with the session."""

from __future__ import annotations

import time

import numpy as np
from measure_filter.sessions import session

from tendon_statics import StickSlipFilter

from .rows import Row, at_most

NOISE = 0.02
"""N"""

RATE = 500.0
"""Hz"""

SECONDS = 40.0

STRETCH = 4000
"""Samples of which the mean is taken"""

SAMPLE_LIMIT = 0.3e-3
"""s"""


def rows() -> list[Row]:
    """Measure."""
    drawn = session('preliminary', 'ramps', NOISE, RATE, SECONDS, np.random.default_rng(1))
    found = StickSlipFilter(drawn.design, tension_stddev=NOISE)
    means = []
    start = time.process_time()
    for number, (at, _, _, tension_l, tension_s) in enumerate(drawn.samples, 1):
        found.update(tension_l, tension_s, at)
        if number % STRETCH == 0:
            end = time.process_time()
            means.append((end - start) / STRETCH)
            start = end
    first, *later = means
    work = 'a sample of `StickSlipFilter`, 500 Hz, on average'
    return [
        at_most(work, '0.3 ms', float(np.median(means)) / SAMPLE_LIMIT, 1.0),
        at_most(
            f'{work}, later in a session',
            'the same at its start',
            float(np.median(later)) / first,
            1.1,
        ),
    ]
