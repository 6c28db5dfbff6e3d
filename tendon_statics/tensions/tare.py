"""The biases of load cells from readings of slack cables."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from statistics import fmean, stdev
from typing import NamedTuple

from ..physics.errors import TendonStaticsError

FEWEST = 20
"""Readings of a cable that are enough for a mean and its scatter"""

STILL = 3.0
"""Standard deviations of the stated noise within which a slack cable's readings scatter, and
halves of them differ"""


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

    def doubt(self, weight: float, what: str = 'unit') -> str:
        """Say that the cable may have been taut, if it read more than a weight in N.

        Parameters
        ----------
        what : str
            Whose weight it is.
        """
        if not abs(self.mean) > weight:
            return ''
        return (
            f'{self.cable} read {self.mean:.4g} N, more than the weight of the {what}: if it was '
            'taut, this bias is wrong'
        )


def tare(
    tensions: Mapping[str, Sequence[float]], biases: Sequence[float], tension_stddev: float
) -> list[CableTare]:
    """Find the biases of all cables from what was measured while all were slack.

    Parameters
    ----------
    tensions : mapping
        Of each cable by name in N, with the biases as they are, in the order of time; what is not
        finite does not count.
    biases : sequence of float
        As they are, in N.
    tension_stddev : float
        Standard deviation of the noise of each tension in N.

    Raises
    ------
    TareError
        If there are too few readings, or a cable was not still; the text says which.
    """
    return [
        _of_cable(name, of_cable, bias, tension_stddev)
        for (name, of_cable), bias in zip(tensions.items(), biases, strict=True)
    ]


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
