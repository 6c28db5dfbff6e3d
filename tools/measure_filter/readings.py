"""What `Consistency` gets of a session, without the members of the filter: a tenth of the time."""

from __future__ import annotations

import functools

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from tendon_statics.physics.filter.scores import Reading
from tendon_statics.physics.filter.smoothing import REACH, Windows
from tendon_statics.physics.load import UPRIGHT
from tendon_statics.physics.tensions import Tensions

Floats = NDArray[np.float64]

LAG = 0.15
"""Of the filter by default, in s"""

AT_ONCE = 2000
"""Places that are smoothed at once"""


@functools.cache
def _windows(count: int, age: int) -> Windows:
    return Windows(count, np.array([age]))


def readings(
    time: Floats, tensions: Floats, angles: Floats, noise: float, angle_stddev: float
) -> list[Reading]:
    """Return the readings of a session of measured angles, as the filter has them a lag later.

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
    values, errors = np.zeros((2, settled)), np.zeros((2, settled))
    first = min(REACH - 1, settled)
    for place in range(first):
        count = place + age + 1
        found = _windows(count, age).estimate(tensions[:, :count], noise)
        values[:, place], errors[:, place] = found.value[:, 0], found.error[:, 0]
    if settled > first:
        width = REACH + age
        views = sliding_window_view(tensions, width, axis=1)
        for start in range(0, views.shape[1], AT_ONCE):
            part = views[:, start : start + AT_ONCE]
            found = _windows(width, age).estimate(part.reshape(-1, width), noise)
            places = slice(first + start, first + start + part.shape[1])
            values[:, places] = found.value.reshape(2, -1)
            errors[:, places] = found.error.reshape(2, -1)
    return [
        Reading(when, angle, angle_stddev, Tensions(*pair), (of_l, of_s), UPRIGHT)
        for when, angle, pair, (of_l, of_s) in zip(
            *(time[:settled].tolist(), angles[:settled].tolist()),
            *(values.T.tolist(), errors.T.tolist()),
            strict=True,
        )
    ]
