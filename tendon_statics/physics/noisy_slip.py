"""The slip function towards one side under noise: how sure the unit is to slip, angle by angle.

Tensions and design are taken to be normal, and the slip function g = M − K to follow them to first
order, so that it is above 0 at an angle x with the probability Φ(s), s = g(x) / σ_g(x). The
difference of the tensions enters g through M alone, in proportion, and their sum through K alone,
so that little is lost however far from slipping the unit is.

Next to equal tensions noise decides which cable is the stronger, and next to a slack one whether
it carries tension at all. Either is one more condition on the tensions, that a difference of them
is above 0, as it is with the probability Φ(t) of its own score t. The correlation ρ of the two
follows from their gradients, and so does

    P(g > 0 and the condition) = Φ₂(s, t; ρ).

What counts then is the score given the condition, the s' of Φ(s') = Φ₂(s, t; ρ) / Φ(t).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from statistics import NormalDist

from .first_root import FirstRoot, Knot
from .kept import kept
from .normal_pair import both_below
from .roots import nearest_zero
from .slip import Probe, Slip
from .turns import turning_points

FAR = 5.0
"""Standard deviations that count as never"""

SURE = 8.3
"""Those of which a normal number is never, but for rounding"""

FINE = 0.02
"""Standard deviations of g to which it is followed where it turns"""

ROUNDING = 1e-15
"""Probability that may be rounding"""

RARE = 1e-3
"""Probability of both that may be an error of `both_below`"""

OUTER = 5e-4
"""Share of a condition's probability up to which `both_below` is not exact enough"""

NARROWEST = 1e-12
"""Least variance, in place of what rounding makes of none"""

_NORMAL = NormalDist()

OUTER_SCORE = -_NORMAL.inv_cdf(OUTER)


class Condition:
    """That a difference of the tensions is above 0.

    Parameters
    ----------
    behind, ahead : float
        Weights of the tension of the cable behind the unit and of that ahead of it, whose squares
        add up to 1.
    score : float
        Its value over its standard deviation.

    Attributes
    ----------
    chance : float
        Its probability.
    """

    def __init__(self, behind: float, ahead: float, score: float) -> None:
        self.behind, self.ahead, self.score = behind, ahead, score
        self.chance = _NORMAL.cdf(score)
        self._shift = _NORMAL.pdf(score) / self.chance

    def given(self, score: float, slope: float, correlation: float) -> tuple[float, float]:
        """Return a score given that the condition holds, and its slope, from those without it."""
        # By mean and deviation of the noise that is left, which is right far out and where
        # rounding leaves no probability to tell from.
        shift = self._shift
        narrowed = 1.0 - correlation * correlation * shift * (shift + self.score)
        narrowed = 1.0 / math.sqrt(max(narrowed, NARROWEST))
        about = (score + correlation * shift) * narrowed
        if abs(about) > SURE:
            return about, slope * narrowed
        share = both_below(score, self.score, correlation) / self.chance
        if share < OUTER:
            return min(about, -OUTER_SCORE), slope * narrowed
        if share > 1.0 - OUTER:
            return max(about, OUTER_SCORE), slope * narrowed
        given = _NORMAL.inv_cdf(share)
        rest = math.sqrt(max(1.0 - correlation * correlation, NARROWEST))
        density = _NORMAL.pdf(score) * _NORMAL.cdf((self.score - correlation * score) / rest)
        return given, slope * density / (self.chance * _NORMAL.pdf(given))


class NoisySlip:
    """What noise makes of the slip function towards one side.

    Parameters
    ----------
    slip : Slip
    stop : float
        θ_max in rad.
    tension_stddev : float
        Standard deviation of each tension in N, the two independent.
    condition : Condition, optional
        What else has to hold of the tensions; all is said given that it does.
    of_design : callable, optional
        Variance that the design's uncertainty gives to g in units of r T, of an angle ahead in
        rad.

    Attributes
    ----------
    chance : float
        Probability of the condition.
    least_known : float
        Probability below which one may be nothing.
    """

    def __init__(
        self,
        slip: Slip,
        stop: float,
        tension_stddev: float,
        condition: Condition | None = None,
        of_design: Callable[[float], float] | None = None,
    ) -> None:
        self._slip, self._stop, self._stddev = slip, stop, tension_stddev
        self._condition, self._of_design = condition, of_design
        self.side = slip.side
        self.chance = 1.0 if condition is None else condition.chance
        self.least_known = ROUNDING if condition is None else RARE
        self._ends = slip.probe(0.0), slip.probe(stop)
        # Of one that is the same at all angles the unit is held, or driven to the stop.
        self._slopes = slip.slope_bounds(*self._ends) if slip.is_determined else (0.0, 0.0)

    @kept
    def root(self) -> FirstRoot:
        """The distribution of the root nearest to 0."""
        first, last = self._ends
        turns = self._turns(first, last)
        return FirstRoot(
            lambda ahead: self._knot(self._slip.probe(ahead)),
            [self._knot(probe) for probe in (first, *turns, last)],
        )

    def _turns(self, first: Probe, last: Probe) -> list[Probe]:
        """Return where the slip function turns, if it may matter."""
        least, greatest = self._slopes
        if least >= 0.0 or greatest <= 0.0:
            return []
        deviation = max(self._deviation(first)[0], self._deviation(last)[0]) / self._slip.total
        # It is much the same at all angles.
        if nearest_zero(first, last, least, greatest) > SURE * deviation:
            return []
        return turning_points(self._slip, first, last, FINE * deviation)

    @kept
    def held(self) -> float:
        """Probability that the unit is held at every angle."""
        return _NORMAL.cdf(-self.root.greatest)

    @kept
    def driven(self) -> float:
        """Probability that it is driven to the stop."""
        return _NORMAL.cdf(self.root.least)

    @property
    def before_zero(self) -> float:
        """Probability of the regime that comes before an angle of 0."""
        return self.held if self._slopes[1] < 0.0 else self.driven

    def cdf(self, ahead: float) -> float:
        """Return the probability that the slip angle is before an angle ahead in rad."""
        return self.before_zero + self.root.before(min(ahead, self._stop))

    def quantile(self, q: float) -> float | None:
        """Return the angle ahead in rad at which `cdf` is q; None where that is in no root."""
        share = q - self.before_zero
        return self.root.angle_of(share) if 0.0 < share <= self.root.probability else None

    def _knot(self, probe: Probe) -> Knot:
        """Return the score of g > 0 where it was probed, given the condition."""
        deviation, behind, ahead = self._deviation(probe)
        scale = self._slip.total / deviation
        score, slope = probe[1] * scale, probe[2] * scale
        condition = self._condition
        if condition is None:
            return probe[0], score, slope
        correlation = self._stddev * (condition.behind * behind + condition.ahead * ahead)
        return probe[0], *condition.given(score, slope, correlation / deviation)

    def _deviation(self, probe: Probe) -> tuple[float, float, float]:
        """Return σ_g / r in N where it was probed, and its slopes by the cables.

        By that behind the unit and by that ahead of it.
        """
        slip = self._slip
        state = probe[8]
        lever = slip.joint.lever
        by_sum = slip.share * slip.law.by_share(state) - state[0]
        variance = 2.0 * self._stddev**2 * (by_sum * by_sum + lever * lever)
        if self._of_design is not None:
            variance += slip.total**2 * self._of_design(probe[0])
        return math.sqrt(variance), by_sum - lever, by_sum + lever
