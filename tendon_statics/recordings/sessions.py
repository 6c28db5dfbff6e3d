"""Whether samples are a session, one after the other in time, or a list of single slips."""

from __future__ import annotations

import numpy as np

from .recording import Floats, Recording

FEW = 30
"""Samples that are too few to tell whether they follow each other"""

MANY = 500
"""Samples that are too many to have been listed by hand"""

SMOOTH = 0.4
"""Von Neumann's ratio below which values follow each other: their mean squared step by twice
their variance. It is 1 for values in any order, with a standard deviation of 1 / sqrt(n)"""


def follow_each_other(recording: Recording) -> str:
    """Say why samples are taken to follow each other in time; empty if they may be single ones.

    That they do must not hang on whether there is a column of times.
    """
    if recording.time is not None:
        return 'they have times'
    if len(recording) < FEW:
        return ''
    if len(recording) >= MANY:
        return f'there are {len(recording)} of them'
    for name in ('tension_l', 'tension_s', 'bend_angle'):
        values = getattr(recording, name)
        if values is not None and _ratio(values[np.isfinite(values)]) < SMOOTH:
            return f'{name} changes little from one to the next'
    return ''


def _ratio(values: Floats) -> float:
    """Von Neumann's ratio; 1 of values that do not differ."""
    variance = float(np.var(values)) if len(values) >= FEW else 0.0
    return float(np.mean(np.diff(values) ** 2)) / (2.0 * variance) if variance > 0.0 else 1.0
