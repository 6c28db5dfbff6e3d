"""What equations tell of the parameters that are fitted to them, by a soft L1 loss.

The loss of a residual x is ρ(x) = 2 c² (√(1 + (x/c)²) − 1), its score ψ(x) = x / √(1 + (x/c)²):
least squares for |x| far below c, least absolute values far above it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..array_roots import Floats

LOSS_SCALE = 1.5
"""c in standard deviations of the noise"""
NORMAL_SCORE, NORMAL_SCORE_STDDEV = 0.509122, 0.465347
"""Mean and standard deviation of ψ² for Gaussian noise of standard deviation 1"""
LOSS_VARIANCE = 1.039768
"""By how much the loss enlarges the variance of what is fitted when the noise is Gaussian"""

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

    @property
    def rank(self) -> int:
        """How many directions of the parameters the equations determine."""
        return len(self.standard_errors) - len(self.null_directions)


def loss(residuals: Floats) -> Floats:
    """ρ of residuals in standard deviations.

    It is −2 log of the density, but for a constant, of a noise that is Gaussian near 0 and has
    exponential tails, so that sums of it may be compared as likelihoods.
    """
    losses: Floats = 2.0 * LOSS_SCALE**2 * (np.hypot(1.0, residuals / LOSS_SCALE) - 1.0)
    return losses


def score(residuals: Floats) -> Floats:
    """ψ of residuals in standard deviations."""
    scores: Floats = residuals / np.hypot(1.0, residuals / LOSS_SCALE)
    return scores


def scatter_scale(residuals: Floats, degrees_of_freedom: int) -> float:
    """Standard deviation of the noise that the scatter of residuals itself tells.

    It solves Σ ψ²(x / s) = (n − k) E ψ², with the mean for Gaussian noise, for s: proposal 2 of
    Huber (Robust Statistics, 1981, ch. 6). 0 where there are no more equations than parameters.

    Parameters
    ----------
    residuals : ndarray
        Shape ``(n,)``.
    degrees_of_freedom : int
        n − k.
    """
    from scipy.optimize import brentq

    wanted = degrees_of_freedom * NORMAL_SCORE
    # For s → 0 every residual but a 0 counts c².
    if not 0.0 < wanted < LOSS_SCALE**2 * np.count_nonzero(residuals):
        return 0.0

    def surplus(log_scale: float) -> float:
        return float(np.sum(score(residuals / math.exp(log_scale)) ** 2)) - wanted

    # ψ² is less than x², so this s is too large.
    high = math.log(float(np.linalg.norm(residuals)) / math.sqrt(wanted))
    low = high - 1.0
    while surplus(low) < 0.0:
        low -= 1.0
    return math.exp(brentq(surplus, low, high))


def scatter_significance(residuals: Floats, degrees_of_freedom: int) -> float:
    """By how many standard deviations residuals scatter more than the stated noise would.

    Of the sum of ψ², which no single outlier can raise much.
    """
    if degrees_of_freedom < 1:
        return 0.0
    surplus = float(np.sum(score(residuals) ** 2)) - degrees_of_freedom * NORMAL_SCORE
    return surplus / (NORMAL_SCORE_STDDEV * math.sqrt(degrees_of_freedom))


def identify(jacobian: Floats, residuals: Floats) -> Identification:
    """Tell what equations determine, from the singular values of their Jacobian.

    Its columns are first brought to one length, so that units do not matter. The covariance is
    that of an M-estimator, K² κ (JᵀJ)⁻¹ with κ = E ψ² / mean(ψ')² and Huber's correction for few
    equations, K = 1 + (k/n) var(ψ') / mean(ψ')² (Robust Statistics, 1981, ch. 7), but not less
    than for Gaussian residuals.

    Parameters
    ----------
    jacobian : ndarray
        Shape ``(n, k)``, of residuals in standard deviations of their noise.
    residuals : ndarray
        Shape ``(n,)``.
    """
    width = jacobian.shape[1]
    lengths = np.linalg.norm(jacobian, axis=0)
    lengths[lengths == 0.0] = 1.0
    # The triangle of a QR decomposition has the same singular values, however many the equations.
    _, singular, rows = np.linalg.svd(np.linalg.qr(jacobian / lengths, mode='r'))
    singular = np.concatenate([singular, np.zeros(width - len(singular))])
    known = singular > RANK_TOLERANCE * max(singular[0], 1.0)
    null = rows[~known] / lengths
    null = null / abs(null).max(axis=1, keepdims=True, initial=1e-300)
    inverse = rows[known].T / singular[known] / lengths[:, None]
    covariance = inverse @ inverse.T * _enlargement(residuals, width)
    undetermined = (abs(rows[~known]) > math.sqrt(RANK_TOLERANCE)).any(axis=0)
    errors = np.sqrt(np.diag(covariance))
    errors[undetermined] = math.nan
    with np.errstate(invalid='ignore', divide='ignore'):
        correlation = covariance / np.outer(errors, errors)
    return Identification(errors, correlation, null)


def _enlargement(residuals: Floats, width: int) -> float:
    """K² κ of `identify`."""
    if len(residuals) <= width:
        return LOSS_VARIANCE
    slopes = (1.0 + (residuals / LOSS_SCALE) ** 2) ** -1.5  # ψ'
    mean = float(np.mean(slopes))
    correction = 1.0 + width / len(residuals) * float(np.var(slopes)) / mean**2
    return max(LOSS_VARIANCE, correction**2 * NORMAL_SCORE / mean**2)
