"""What `Consistency` gets of a session, without the members of the filter: a tenth of the time."""

from __future__ import annotations

import functools
from collections.abc import Iterator

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from tendon_statics.physics.filter.local_fits import REACH
from tendon_statics.physics.filter.scores import Reading
from tendon_statics.physics.filter.smoothing import Estimate, Windows
from tendon_statics.physics.load import UPRIGHT
from tendon_statics.physics.tensions import Tensions

Floats = NDArray[np.float64]

LAG = 0.15
"""Of the filter by default, in s"""

AT_ONCE = 1000
"""Places that are smoothed at once"""


@functools.lru_cache(512)
def _windows(count: int, age: int, signals: int) -> Windows:
    return Windows(count, np.array([age]), signals)


def readings(
    time: Floats, tensions: Floats, angles: Floats, noise: float, angle_stddev: float
) -> Iterator[Reading]:
    """Yield the readings of a session of measured angles, as the filter has them a lag later.

    Parameters
    ----------
    time : ndarray
        In s, at a steady rate.
    tensions : ndarray
        As measured in N, shape ``(2, samples)``.
    angles : ndarray
        As measured in rad.
    noise, angle_stddev : float
        Standard deviations of a tension in N and of an angle in rad.
    """
    age = int(np.sum(time > time[-1] - LAG))  # samples that are not settled
    settled = len(time) - age

    def of(places: slice, found: Estimate) -> Iterator[Reading]:
        values, errors = found.value.reshape(2, -1).T, found.error.reshape(2, -1).T
        of_samples = time[places], angles[places], values, errors
        for when, angle, pair, error in zip(*(part.tolist() for part in of_samples), strict=True):
            yield Reading(when, angle, angle_stddev, Tensions(*pair), tuple(error), UPRIGHT)

    first = min(REACH - 1, settled)
    for place in range(first):
        count = place + age + 1
        found = _windows(count, age, len(tensions)).estimate(tensions[:, :count], noise)
        yield from of(slice(place, place + 1), found)
    if settled > first:
        width = REACH + age
        views = sliding_window_view(tensions, width, axis=1)
        for start in range(0, views.shape[1], AT_ONCE):
            part = views[:, start : start + AT_ONCE]
            rows = part.reshape(-1, width)
            found = _windows(width, age, len(rows)).estimate(rows, noise)
            yield from of(slice(first + start, first + start + part.shape[1]), found)
