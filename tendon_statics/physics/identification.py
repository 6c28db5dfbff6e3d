"""What equations tell of the parameters that are fitted to them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .array_roots import Floats

LOSS_SCALE = 1.5
"""Distance in units of noise from which on a sample counts less than its square (soft L1)"""
LOSS_VARIANCE = 1.0398
"""By how much that loss enlarges the variance of what is fitted when the noise is Gaussian"""

RANK_TOLERANCE = 1e-6
"""Share of the largest singular value below which the data say nothing of a direction"""


class Identification(NamedTuple):
    """What equations tell of parameters near a solution."""

    standard_errors: Floats
    """Of each parameter; NaN where the equations do not determine it"""
    correlation: Floats
    """NaN likewise"""
    null_directions: Floats
    """Changes of the parameters that change no equation, one a row, the largest part being 1"""


def identify(jacobian: Floats, residuals: Floats) -> Identification:
    """Tell what equations determine, from the singular values of their Jacobian.

    Its columns are first brought to one length, so that units do not matter. The covariance is
    that of an M-estimator with the soft L1 loss, κ (JᵀJ)⁻¹ with κ = [Σψ² / (n − k)] / mean(ψ')²,
    but not less than for residuals of the stated noise (Huber, Robust Statistics, 1981, ch. 7).

    Parameters
    ----------
    jacobian : ndarray
        Shape ``(n, k)``, of residuals in units of noise.
    residuals : ndarray
        Shape ``(n,)``.
    """
    count, width = jacobian.shape
    lengths = np.linalg.norm(jacobian, axis=0)
    lengths[lengths == 0.0] = 1.0
    # The triangle of a QR decomposition has the same singular values, however many the equations.
    _, singular, rows = np.linalg.svd(np.linalg.qr(jacobian / lengths, mode='r'))
    singular = np.concatenate([singular, np.zeros(width - len(singular))])
    known = singular > RANK_TOLERANCE * max(singular[0], 1.0)
    null = rows[~known] / lengths
    null = null / abs(null).max(axis=1, keepdims=True, initial=1e-300)
    inverse = rows[known].T / singular[known] / lengths[:, None]
    covariance = inverse @ inverse.T * _enlargement(residuals, count - width)
    undetermined = (abs(rows[~known]) > math.sqrt(RANK_TOLERANCE)).any(axis=0)
    errors = np.sqrt(np.diag(covariance))
    errors[undetermined] = math.nan
    with np.errstate(invalid='ignore', divide='ignore'):
        correlation = covariance / np.outer(errors, errors)
    return Identification(errors, correlation, null)


def _enlargement(residuals: Floats, degrees_of_freedom: int) -> float:
    """κ of `identify`."""
    if degrees_of_freedom < 1:
        return LOSS_VARIANCE
    stretch = 1.0 + (residuals / LOSS_SCALE) ** 2
    scatter = float(np.sum(residuals**2 / stretch)) / degrees_of_freedom
    return max(LOSS_VARIANCE, scatter / float(np.mean(stretch**-1.5)) ** 2)
