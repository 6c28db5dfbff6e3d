"""The biases of load cells from readings of slack cables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import fmean, stdev
from typing import NamedTuple

from ..physics.errors import TendonStaticsError

FEWEST = 20
"""Readings of a cable that are enough for a mean and its scatter"""

STILL = 3.0
"""Standard deviations of the stated noise within which a slack cable's readings scatter, and
halves of them differ"""

NAMES = ('cable_l', 'cable_s')


class TareError(TendonStaticsError, ValueError):
    """Readings from which no bias can be told; the text is for the user."""


class CableTare(NamedTuple):
    """What slack readings tell of one cable."""

    cable: str
    readings: int
    mean: float
    """N, with the bias as it was"""
    scatter: float
    """Standard deviation of one reading in N"""
    drift: float
    """Mean of the second half less that of the first, in N"""
    old_bias: float
    """N"""

    @property
    def bias(self) -> float:
        """Bias in N with which the mean is 0."""
        return self.old_bias - self.mean

    def doubt(self, weight: float) -> str:
        """Say that the cable may have been taut, if it read more than the unit's weight in N."""
        if not abs(self.mean) > weight:
            return ''
        return (
            f'{self.cable} read {self.mean:.4g} N, more than the weight of the unit: if it was '
            'taut, this bias is wrong'
        )


def tare(
    tensions_l: Sequence[float],
    tensions_s: Sequence[float],
    biases: tuple[float, float],
    tension_stddev: float,
) -> tuple[CableTare, CableTare]:
    """Find the biases of both cables from what was measured while both were slack.

    Parameters
    ----------
    tensions_l, tensions_s : sequence of float
        N, with the biases as they are, in the order of time; what is not finite does not count.
    biases : tuple of float
        As they are, in N.
    tension_stddev : float
        Standard deviation of the noise of each tension in N.

    Raises
    ------
    TareError
        If there are too few readings, or a cable was not still; the text says which.
    """
    of_l, of_s = (
        _of_cable(name, tensions, bias, tension_stddev)
        for name, tensions, bias in zip(NAMES, (tensions_l, tensions_s), biases, strict=True)
    )
    return of_l, of_s


def _of_cable(
    name: str, tensions: Sequence[float], old_bias: float, tension_stddev: float
) -> CableTare:
    known = [tension for tension in tensions if math.isfinite(tension)]
    if len(known) < FEWEST:
        raise TareError(f'{name} has {len(known)} readings; {FEWEST} are needed')
    half = len(known) // 2
    drift = fmean(known[half:]) - fmean(known[:half])
    found = CableTare(name, len(known), fmean(known), stdev(known), drift, old_bias)
    limit = STILL * tension_stddev
    if not found.scatter <= limit:
        raise TareError(
            f'{name} was not still: its readings scatter by {found.scatter:.3g} N, at most '
            f'{limit:.3g} N fit the stated noise of {tension_stddev:g} N'
        )
    # The means of two halves scatter less than single readings, by the root of their number.
    limit = max(tension_stddev, STILL * 2.0 * found.scatter / math.sqrt(len(known)))
    if not abs(drift) <= limit:
        raise TareError(
            f'{name} was not still: the second half of its readings lies {drift:+.3g} N from the '
            f'first, at most {limit:.3g} N are allowed'
        )
    return found
