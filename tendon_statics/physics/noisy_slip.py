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

from .first_root import FirstRoot, Knot
from .normal_pair import both_below
from .roots import nearest_zero
from .slip import Probe, Slip
from .tension_conditions import ALWAYS, FAR, Condition
from .turns import turning_points

FINE = 0.02
"""Standard deviations of g to which it is followed where it turns"""

SQRT_TWO = math.sqrt(2.0)


class NoisySlip:
    """What noise makes of the slip function towards one side, together with a condition.

    Parameters
    ----------
    slip : Slip
    stop : float
        θ_max in rad.
    tension_stddev : float
        Standard deviation of each tension in N, the two independent.
    condition : Condition
        What else has to hold of the tensions: all probabilities are those of both.
    of_design : callable, optional
        Variance that the design's uncertainty gives to g in units of r T, of an angle ahead in
        rad.

    Attributes
    ----------
    root : FirstRoot
        The distribution of the root nearest to 0.
    held, driven : float
        Probability that the unit is held at every angle, and that it is driven to the stop.
    """

    def __init__(
        self,
        slip: Slip,
        stop: float,
        tension_stddev: float,
        condition: Condition = ALWAYS,
        of_design: Callable[[float], float] | None = None,
    ) -> None:
        self.side, self.condition = slip.side, condition
        self._slip, self._stop, self._of_design = slip, stop, of_design
        self._deviation = SQRT_TWO * tension_stddev / slip.total
        self._lever, self._by_share = slip.joint.lever, slip.law.by_share
        first, last = slip.ends(stop)
        # Of one that is the same at all angles the unit is held, or driven to the stop.
        self._slopes = slip.slope_bounds(first, last) if slip.is_determined else (0.0, 0.0)
        knots = [self._knot(first), self._knot(last)]
        if self._slopes[0] < 0.0 < self._slopes[1]:
            knots[1:1] = map(self._knot, self._turns(first, last))
        self.root = FirstRoot(self._knot_at, knots, condition.score)
        self.held = max(condition.chance - self.root.greatest, 0.0)
        self.driven = self.root.least

    def _turns(self, first: Probe, last: Probe) -> list[Probe]:
        """Return where the slip function turns, if it may matter."""
        # It is much the same at all angles.
        deviation = max(self._noise(first)[0], self._noise(last)[0])
        if nearest_zero(first, last, *self._slopes) > FAR * deviation:
            return []
        return turning_points(self._slip, first, last, FINE * deviation)

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
        if not 0.0 < share <= self.root.probability:
            return None
        (angle,) = self.root.angles_of([share])
        return angle

    def _knot_at(self, ahead: float) -> Knot:
        return self._knot(self._slip.probe(ahead))

    def _knot(self, probe: Probe) -> Knot:
        """Return what is known of g > 0 where it was probed, and of that with the condition."""
        deviation, correlation = self._noise(probe)
        score = probe[1] / deviation
        probability = both_below(score, self.condition.score, correlation)
        return probe[0], score, probe[2] / deviation, correlation, probability

    def _noise(self, probe: Probe) -> tuple[float, float]:
        """Return σ_g / (r T) where it was probed, and its correlation with the condition."""
        state, lever, condition = probe[8], self._lever, self.condition
        by_sum = self._slip.share * self._by_share(state) - state[0]
        size = math.sqrt(by_sum * by_sum + lever * lever)
        if self._of_design is not None:
            # Of a covariance without an inverse, rounding may leave less than nothing.
            of_design = max(self._of_design(probe[0]), 0.0)
            size = math.hypot(size, math.sqrt(of_design) / self._deviation)
        correlation = (condition.of_sum * by_sum + condition.of_lead * lever) / size
        return self._deviation * size, correlation
