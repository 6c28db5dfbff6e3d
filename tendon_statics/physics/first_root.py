"""Where the slip function has its first root, if noise lifts it by so many deviations.

Noise lifts or lowers the slip function g at all angles nearly alike, by so many of its own
standard deviations σ_g. So with the score s(x) = g(x) / σ_g(x) there is a root at or before x just
where the noise, a standard normal number, is between the least and the greatest of −s up to there:

    P(there is a root ≤ x) = Φ(max s) − Φ(min s) over [0, x].
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from statistics import NormalDist

from .kept import kept
from .roots import cubic_zero

LOOKS = 7
"""Angles from 0 to the stop at which it is seen how a score turns"""

LAST_STEP = 1e-6
"""rad, to an angle; the next would be a thousandth of it"""

STEPS = 60
"""To such an angle at the most, should each but halve the range; two are taken as a rule"""

Knot = tuple[float, float, float]
"""An angle ahead in rad, the score there, and about the score's slope: that of g over σ_g, which
turns far less than g does"""

_NORMAL = NormalDist()


class FirstRoot:
    """The distribution of the root nearest to 0, given a score.

    Parameters
    ----------
    score : callable
        Returns the knot at an angle ahead in rad.
    ends : tuple of Knot
        Those at 0 and at the stop.
    is_monotonic : bool
        Whether it rises or falls all the way, so that its ends tell.

    Attributes
    ----------
    least, greatest : float
        The score's range. Below the least the unit is driven to the stop, above the greatest held.
    """

    def __init__(
        self, score: Callable[[float], Knot], ends: tuple[Knot, Knot], *, is_monotonic: bool
    ) -> None:
        self._score = score
        first, last = ends
        self._knots = [first, last]
        if not is_monotonic:
            step = last[0] / (LOOKS - 1)
            looks = [first, *(score(step * index) for index in range(1, LOOKS - 1)), last]
            tops = [_top(*three, step) for three in zip(looks, looks[1:], looks[2:], strict=False)]
            self._knots = sorted([*looks, *(score(angle) for angle in tops if angle is not None)])
        scores = [knot[1] for knot in self._knots]
        self.least, self.greatest = min(scores), max(scores)

    @kept
    def probability(self) -> float:
        """Of a root."""
        return max(_NORMAL.cdf(self.greatest) - _NORMAL.cdf(self.least), 0.0)

    def before(self, angle: float) -> float:
        """Probability of a root up to an angle ahead in rad, within the stop."""
        scores = [score for knot, score, _ in self._knots if knot < angle]
        scores.append(self._score(angle)[1])
        return _NORMAL.cdf(max(scores)) - _NORMAL.cdf(min(scores))

    def angle_of(self, probability: float) -> float | None:
        """Angle ahead in rad up to which roots have a probability; None where they never do."""
        least = greatest = self._knots[0][1]
        for one, other in itertools.pairwise(self._knots):
            # Roots are new only where the score goes beyond what it was before.
            if other[1] > greatest:
                greatest = other[1]
                score = _score_of(_NORMAL.cdf(least) + probability)
                is_there = score <= greatest
            elif other[1] < least:
                least = other[1]
                score = _score_of(_NORMAL.cdf(greatest) - probability)
                is_there = score >= least
            else:
                continue
            if is_there:
                return self._between(one, other, score)
        return None

    def _between(self, one: Knot, other: Knot, score: float) -> float:
        """Angle ahead in rad between two knots at which the score is what it is to be."""
        (low, at_low, low_slope), (high, at_high, high_slope) = one, other
        rises = at_high > at_low
        ahead: float = cubic_zero(
            (low, at_low - score, low_slope), (high, at_high - score, high_slope)
        )
        if not low <= ahead <= high:
            ahead = 0.5 * (low + high)
        before: Knot | None = None
        for _ in range(STEPS):
            knot = self._score(ahead)
            _, value, slope = knot
            low, high = (ahead, high) if (value < score) == rises else (low, ahead)
            if before is not None and ahead != before[0]:
                slope = (value - before[1]) / (ahead - before[0])
            nearer = ahead + (score - value) / slope if slope else math.nan
            if not low <= nearer <= high:
                nearer = 0.5 * (low + high)
            if before is not None and abs(nearer - ahead) < LAST_STEP:
                return nearer
            before, ahead = knot, nearer
        return ahead


def _top(one: Knot, middle: Knot, other: Knot, step: float) -> float | None:
    """Angle at which a parabola through three knots turns, if it does between them."""
    to, onwards = middle[1] - one[1], other[1] - middle[1]
    return middle[0] + 0.5 * step * (to + onwards) / (to - onwards) if to * onwards < 0.0 else None


def _score_of(probability: float) -> float:
    """Φ⁻¹; NaN where rounding leaves none."""
    return _NORMAL.inv_cdf(probability) if 0.0 < probability < 1.0 else math.nan
