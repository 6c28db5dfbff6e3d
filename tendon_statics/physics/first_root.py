"""Where the slip function has its first root, if noise lifts it by so many deviations.

Noise lifts or lowers the slip function g at all angles nearly alike, by so many of its own
standard deviations σ_g. So with the score s(x) = g(x) / σ_g(x) there is a root at or before x just
where the noise, a standard normal number, is between the least and the greatest of −s up to there:

    P(there is a root ≤ x) = Φ(max s) − Φ(min s) over [0, x].
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from statistics import NormalDist

from .kept import kept
from .roots import cubic_zero

LAST_STEP = 1e-3
"""rad, to an angle; the next would be a thousandth of it as a rule"""

LAST_MISS = 0.05
"""Score that is missed before that step"""

STEPS = 14
"""To such an angle at the most, should each but halve the range; two or so are taken"""

USUAL_STEPS = 4
"""Those after which every other one halves the range"""

Knot = tuple[float, float, float]
"""An angle ahead in rad, the score there, and about its slope"""

_NORMAL = NormalDist()


class FirstRoot:
    """The distribution of the root nearest to 0, given a score.

    Parameters
    ----------
    score : callable
        Knot of an angle ahead in rad.
    knots : sequence of Knot
        From 0 to the stop, ascending, with all at which the score turns.

    Attributes
    ----------
    least, greatest : float
        The score's range. Below the least the unit is driven to the stop, above the greatest held.
    """

    def __init__(self, score: Callable[[float], Knot], knots: Sequence[Knot]) -> None:
        self._score, self._knots = score, knots
        scores = [knot[1] for knot in knots]
        self.least, self.greatest = min(scores), max(scores)

    @kept
    def probability(self) -> float:
        """Of a root."""
        return max(_NORMAL.cdf(self.greatest) - _NORMAL.cdf(self.least), 0.0)

    def before(self, angle: float) -> float:
        """Probability of a root up to an angle ahead in rad, within the stop."""
        scores = [knot[1] for knot in self._knots if knot[0] < angle]
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
        low, high = ((angle, value - score, slope) for angle, value, slope in (one, other))
        rises = low[1] < high[1]
        ahead = cubic_zero(low, high)
        if not low[0] <= ahead <= high[0]:
            ahead = _from_turn(low, high)
        for step in range(STEPS):
            if not low[0] <= ahead <= high[0] or (step > USUAL_STEPS and step % 2):
                ahead = 0.5 * (low[0] + high[0])
            angle, value, slope = self._score(ahead)
            probe = angle, value - score, slope
            low, high = (probe, high) if (probe[1] < 0.0) == rises else (low, probe)
            nearer = ahead - probe[1] / slope if slope else math.nan
            if abs(nearer - ahead) < LAST_STEP and abs(probe[1]) < LAST_MISS:
                return min(max(nearer, low[0]), high[0])
            ahead = nearer
        return 0.5 * (low[0] + high[0])


def _from_turn(low: Knot, high: Knot) -> float:
    """Where a parabola through two knots is zero that turns at the flatter one."""
    turn, other = (low, high) if abs(low[2]) < abs(high[2]) else (high, low)
    drop = turn[1] - other[1]
    share = min(max(turn[1] / drop, 0.0), 1.0) if drop else 0.0
    return turn[0] + (other[0] - turn[0]) * math.sqrt(share)


def _score_of(probability: float) -> float:
    """Φ⁻¹; NaN where rounding leaves none."""
    return _NORMAL.inv_cdf(probability) if 0.0 < probability < 1.0 else math.nan
