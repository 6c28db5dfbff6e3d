"""Where the slip function has its first root, if noise lifts it by so many deviations.

Noise lifts or lowers the slip function g at all angles nearly alike, by so many of its own
standard deviations σ_g. So with the score s(x) = g(x) / σ_g(x) there is a root at or before x just
where the noise, a standard normal number, is between the least and the greatest of −s up to there:

    P(there is a root ≤ x) = max P(x) − min P(x) over [0, x],   P(x) = P(g(x) > 0) = Φ(s(x)).

Where the noise is to meet a condition too, P(x) is the probability that it lifts g(x) above 0 and
meets that, P(x) = Φ₂(s(x), t; ρ(x)), with the condition's own score t and its correlation ρ.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from .normal_pair import SQRT_TWO_PI, below, both_below, score_of
from .roots import LEAST

LAST_BEND = 1e-3
"""Score that the last step to an angle misses at the most, as the slopes nearby bend"""

LAST_TURN = 0.05
"""That as a share of the score that it mends"""

LAST_RISE = 1.0
"""Score that it mends at the most, since slopes are not exact"""

LAST_MISS = 0.3
"""The same of the score of P, given the condition"""

STEPS = 14
"""To such an angle at the most, should each but halve the range; one or two are taken"""

USUAL_STEPS = 4
"""Those after which every other one halves the range"""

CUBIC_STEPS = 6
"""To where a cubic has a value; two or three are taken"""

CUBIC_SHARE = 1e-2
"""Of its range: the last of them, of which the next would be a hundredth or less"""

PARTED = 3.0
"""Deviations of what parts the condition from g > 0, from which on one of the two decides"""

CERTAIN = 6.0
"""Score of a P, given the condition, that only tells to which side it is"""

NARROWEST = 1e-12
"""Least 1 − ρ², in place of what rounding makes of none"""

Knot = tuple[float, float, float, float, float]
"""An angle ahead in rad, the score s there, about its slope, ρ and P"""


class FirstRoot:
    """The distribution of the root nearest to 0, given a score.

    Parameters
    ----------
    knot : callable
        Knot of an angle ahead in rad.
    knots : sequence of Knot
        From 0 to the stop, ascending, with all at which the score turns.
    bound : float
        t; infinite without a condition.

    Attributes
    ----------
    least, greatest : float
        The range of P: the probabilities that g is above 0 at all angles, and that it is anywhere.
    probability : float
        Of a root.
    """

    def __init__(self, knot: Callable[[float], Knot], knots: Sequence[Knot], bound: float) -> None:
        self._knot, self._knots, self._bound = knot, knots, bound
        least = greatest = knots[0][4]
        for _, _, _, _, probability in knots:
            if probability < least:
                least = probability
            elif probability > greatest:
                greatest = probability
        self.least, self.greatest, self.probability = least, greatest, greatest - least

    def before(self, angle: float) -> float:
        """Probability of a root up to an angle ahead in rad, within the stop."""
        found = [knot[4] for knot in self._knots if knot[0] < angle]
        found.append(self._knot(angle)[4])
        return max(found) - min(found)

    def angles_of(self, probabilities: Sequence[float]) -> list[float | None]:
        """Angles ahead in rad up to which roots have probabilities; None where they never do."""
        knots = list(self._knots)
        return [self._angle_of(probability, knots) for probability in probabilities]

    def _angle_of(self, probability: float, knots: list[Knot]) -> float | None:
        least = greatest = knots[0][4]
        for index, knot in enumerate(knots):
            # Roots are new only where P goes beyond what it was before.
            if knot[4] > greatest:
                greatest = knot[4]
                wanted = least + probability
                is_there = wanted <= greatest
            elif knot[4] < least:
                least = knot[4]
                wanted = greatest - probability
                is_there = wanted >= least
            else:
                continue
            if is_there:
                return self._between(knots, index, wanted)
        return None

    def _between(self, knots: list[Knot], index: int, wanted: float) -> float:
        """Angle ahead in rad before a knot at which P is what it is to be.

        The last that is looked at becomes a knot, since another may be next to it.
        """
        low, high = knots[index - 1], knots[index]
        rises = low[4] < high[4]
        aim = _Aim(wanted, self._bound, low[3])
        ahead = _where(low, high, aim.score)
        for count in range(STEPS):
            if not low[0] <= ahead <= high[0] or (count > USUAL_STEPS and count % 2):
                ahead = 0.5 * (low[0] + high[0])
            knot = self._knot(ahead)
            if (knot[4] < wanted) == rises:
                low = knot
            else:
                high = knot
            _, score, slope, correlation, probability = knot
            miss = aim.mend(score, correlation, probability)
            rise = aim.score - score
            step = rise / slope if slope else math.inf
            width = high[0] - low[0]
            bend = abs(step * step * (high[2] - low[2]))
            is_near = -LAST_RISE < rise < LAST_RISE and -LAST_MISS < miss < LAST_MISS
            is_straight = bend < LAST_BEND * width and bend <= LAST_TURN * width * abs(rise)
            if (is_near and is_straight) or not width > 0.0:
                break
            ahead += step
        knots.insert(index, knot)
        return min(max(knot[0] + step, low[0]), high[0])


class _Aim:
    """The score s that goes with a P that is wanted.

    Parameters
    ----------
    bound, correlation : float
        t, and ρ about there.

    Attributes
    ----------
    score : float
        s, as far as it is known.
    """

    def __init__(self, wanted: float, bound: float, correlation: float) -> None:
        self._bound = bound
        self._chance = chance = below(bound)
        # That of a condition that goes together with g > 0, or with g < 0, as most do that count,
        # and that of one that has nothing to do with g; it is between the two.
        self._together = score_of(wanted if correlation >= 0.0 else wanted + 1.0 - chance)
        self._apart = score_of(wanted / chance)
        self._bounds = sorted((self._together, self._apart))
        self.score = self._together
        gap = self.score - bound if correlation >= 0.0 else self.score + bound
        if gap * gap < PARTED * PARTED * (1.0 - correlation * correlation):
            self.mend(self.score, correlation, both_below(self.score, bound, correlation))

    def mend(self, score: float, correlation: float, probability: float) -> float:
        """Correct it by the P at a score; return by how much that misses what is wanted.

        In terms of the score of P given the condition, which follows s nearly in a straight line.
        """
        if probability == below(score):  # The condition takes nothing away.
            self.score = self._together
            return 0.0
        chance = self._chance
        given = score_of(probability / chance)
        miss = self._apart - given
        if -CERTAIN < given < CERTAIN:
            # A step of Chebyshev's: by slope and curvature of that in terms of s
            spread = math.sqrt(max(1.0 - correlation * correlation, NARROWEST))
            rest = (self._bound - correlation * score) / spread
            met, density = below(rest) + LEAST, math.exp(-0.5 * rest * rest) / SQRT_TWO_PI
            slope = met / chance * math.exp(0.5 * (given * given - score * score)) + LEAST
            bend = given * slope - score - correlation * density / (spread * met)
            step = miss / slope
            score += step * (1.0 - 0.5 * bend * step)
            low, high = self._bounds
            self.score = low if score < low else high if score > high else score
        return miss


def _where(low: Knot, high: Knot, score: float) -> float:
    """Angle ahead in rad where the cubic through two knots, with their slopes, is at a score."""
    place, before, slope, _, _ = low
    other, after, other_slope, _, _ = high
    width = other - place
    rise = after - before
    slope *= width
    other_slope *= width
    third = slope + other_slope - 2.0 * rise
    second = rise - slope - third
    short = score - before
    share = short / (rise + LEAST)
    for _ in range(CUBIC_STEPS):
        missing = short - share * (slope + share * (second + share * third))
        step = missing / (slope + share * (2.0 * second + 3.0 * share * third) + LEAST)
        share += step
        if -CUBIC_SHARE < step < CUBIC_SHARE:
            break
    return place + share * width
