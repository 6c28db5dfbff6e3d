"""The slip function towards one side under noise: how sure the unit is to slip, angle by angle.

Tensions and design are taken to be normal, and the slip function g = M − K to follow them to first
order, so that it is above 0 at an angle x with the probability Φ(s), s = g(x) / σ_g(x). The
difference of the tensions enters g through M alone, in proportion, and their sum through K alone,
so that little is lost however far from slipping the unit is.

There may be one more condition on the tensions; see `tension_conditions`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from statistics import NormalDist

from .first_root import FirstRoot, Knot
from .kept import kept
from .roots import nearest_zero
from .slip import Probe, Slip
from .tension_conditions import FAR, SURE, Condition
from .turns import turning_points

FINE = 0.02
"""Standard deviations of g to which it is followed where it turns"""

ROUNDING = 1e-12
"""Probability that may be rounding"""

RARE = 5e-3
"""Probability of both of which an error of `both_below` is no small part"""

SQRT_TWO = math.sqrt(2.0)

_NORMAL = NormalDist()


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
        self._ends = slip.ends(stop)
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
        sure = SURE if self._condition is None else FAR
        if nearest_zero(first, last, least, greatest) > sure * deviation:
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
        deviation = SQRT_TWO * self._stddev * math.sqrt(by_sum * by_sum + lever * lever)
        if self._of_design is not None:
            # Of a covariance without an inverse, rounding may leave less than nothing.
            of_design = slip.total * math.sqrt(max(self._of_design(probe[0]), 0.0))
            deviation = math.hypot(deviation, of_design)
        return deviation, by_sum - lever, by_sum + lever
