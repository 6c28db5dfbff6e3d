"""Whether samples are a session, one after the other in time, or a list of single slips."""

from __future__ import annotations

import math

import numpy as np

from ..array_roots import Floats
from .measured import Samples

FEW = 9
"""Samples of which fewer do not tell whether they follow each other"""

MANY = 500
"""Samples that are too many to have been listed by hand"""

SMOOTH = 0.4
"""Von Neumann's ratio below which values follow each other: their mean squared step by twice
their variance. It is 1 for values in any order, with a standard deviation of 1 / sqrt(n)"""

SURE = 2.7
"""Standard deviations by which the ratio of few values has to be below 1 in any case"""


def follow_each_other(data: Samples) -> str:
    """Say why samples are taken to follow each other in time; empty if they may be single ones.

    That they do must not hang on whether there is a column of times.
    """
    if data.time is not None:
        return 'they have times'
    if getattr(data, 'unknown_times', ''):  # of a `Recording`
        return 'there is a column that rises as times do'
    count = len(np.atleast_1d(data.tension_l))
    if count >= MANY:
        return f'there are {count} of them'
    for name in ('tension_l', 'tension_s', 'bend_angle'):
        values = np.asarray(getattr(data, name), dtype=np.float64)
        if _are_smooth(values[np.isfinite(values)]):
            return f'{name} changes little from one to the next'
    return ''


def _are_smooth(values: Floats) -> bool:
    """Whether values that differ follow each other, by von Neumann's ratio."""
    if len(values) < FEW or not np.var(values) > 0.0:
        return False
    ratio = float(np.mean(np.diff(values) ** 2) / (2.0 * np.var(values)))
    return ratio < min(SMOOTH, 1.0 - SURE / math.sqrt(len(values)))
