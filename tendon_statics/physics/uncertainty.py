"""How sure the answer for one pair of noisy tensions is: the distribution of the slip angle.

The slip angle is that at which the unit is about to slip to the side of the stronger cable. Where
the slip function g rises with the angle through the range, it lies at or before x just where
g(x) ≥ 0. So to first order in the noise

    F(x) = P(slip angle ≤ x) = Φ(g(x) / σ_g(x)),

whatever the regime: F(0) is the probability of ``driven_to_stop``, 1 − F(θ_max) that of ``held``,
and in between lies an equilibrium. Where g falls, it is Φ(−g / σ_g), and the two change places.
The gradient of the root, on which deviations rest, says nothing of all this near the end of a
regime.
"""

from __future__ import annotations

import math
from statistics import NormalDist

from .design import JointDesign
from .design_gradients import excess_by_design
from .design_uncertainty import DesignUncertainty
from .drawn_slip_angles import DrawnSlipAngles
from .gradients import slip_by_tensions
from .kept import kept
from .load import UPRIGHT, Load
from .regime import Regime
from .slip import Slip
from .tensions import Tensions, check_tensions, taut_slip

FAR = 5.0
"""Standard deviations that count as never"""

LAST_STEP = 1e-6
"""Step to a quantile in rad after which it is there within some 1e-8 rad: of two errors of the
secant method the next is a product"""

STEPS = 60
"""To a quantile at the most, should each but halve the range; five or so are taken"""

_NORMAL = NormalDist()


def slip_angle_distribution(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    *,
    tension_stddev: float,
    load: Load = UPRIGHT,
    design_covariance: DesignUncertainty | None = None,
) -> SlipAngleDistribution:
    """Return the distribution of the slip angle of a pair of noisy tensions.

    In closed form where the slip function is monotonic and the side of slip is sure; from `DRAWS`
    draws through `solve_batch` elsewhere. `SlipAngleDistribution.is_closed_form` tells.

    Parameters
    ----------
    tension_l, tension_s : float
        Measured cable tensions in N, both above 0.
    tension_stddev : float
        Standard deviation of each tension in N, above 0, the two independent.
    load : Load
        What acts beside them.
    design_covariance : DesignUncertainty, optional
        Of parameters of the design; without it the design is exact.

    Raises
    ------
    TensionError
        As `solve` does, and for a slack cable.
    ValueError
        If the deviation is not a finite number above 0.
    """
    if not 0.0 < tension_stddev < math.inf:
        raise ValueError(f'tension_stddev is {tension_stddev!r} N, which must be above 0')
    tensions = check_tensions(tension_l, tension_s)
    slip = taut_slip(design, tensions, load, -1.0 if tension_l > tension_s else 1.0)
    return SlipAngleDistribution(design, tensions, load, slip, tension_stddev, design_covariance)


class SlipAngleDistribution:
    """The distribution of the slip angle of one pair of noisy tensions.

    Made by `slip_angle_distribution`. Angles are in rad, positive towards cable s.
    """

    def __init__(
        self,
        design: JointDesign,
        tensions: Tensions,
        load: Load,
        slip: Slip,
        tension_stddev: float,
        uncertainty: DesignUncertainty | None,
    ) -> None:
        self._design = design
        self._tensions = tensions
        self._load = load
        self._slip = slip
        self._stddev = tension_stddev
        self._uncertainty = uncertainty
        self._stop = design.max_bend_angle

    @kept
    def is_closed_form(self) -> bool:
        """Whether it is worked out in closed form; otherwise from `DRAWS` draws."""
        return self._is_side_sure and self._direction != 0.0

    @kept
    def _direction(self) -> float:
        """1 where the slip function rises through the range, −1 where it falls, else 0."""
        if not self._slip.is_determined:
            return 1.0  # the same at all angles: held, or driven to the stop
        slip = self._slip
        least, greatest = slip.slope_bounds(slip.probe(0.0), slip.probe(self._stop))
        return 1.0 if least > 0.0 else -1.0 if greatest < 0.0 else 0.0

    @property
    def _is_side_sure(self) -> bool:
        """Whether noise neither turns the stronger cable into the weaker nor ends its tension."""
        weak, strong = sorted(self._tensions)
        spare = min(weak, self._slip.excess / math.sqrt(2.0))
        surest: float = min((strong - weak) / math.sqrt(2.0), spare)
        return surest > FAR * self._stddev

    def probability(self, regime: Regime | str) -> float:
        """Return the probability of what `solve` would answer without noise.

        Of ``equilibrium``, ``held``, ``driven_to_stop`` and, if noise can make one, ``slack``.
        What it would refuse is in none of them.
        """
        return self.probabilities[Regime(regime)]

    @kept
    def probabilities(self) -> dict[Regime, float]:
        """The probability of each regime."""
        if not self.is_closed_form:
            return {regime: self._drawn.probability(regime) for regime in Regime}
        at_zero, at_stop = self._at_ends
        driven, held = at_zero, 1.0 - at_stop
        if self._direction < 0.0:
            driven, held = held, driven
        return {
            Regime.EQUILIBRIUM: max(at_stop - at_zero, 0.0),
            Regime.HELD: held,
            Regime.SLIPPING: 0.0,
            Regime.DRIVEN_TO_STOP: driven,
            Regime.SLACK: 0.0,
        }

    def cdf(self, angle: float) -> float:
        """Return the probability that the slip angle lies between 0, or before, and an angle.

        What is said of a negative angle is said of its mirror image: the slip angle towards
        cable l, up to that. The whole of one side is 1, of which `probability` of the two other
        regimes lies before 0 and beyond the stop.

        Parameters
        ----------
        angle : float
            Within the stops, in rad.
        """
        ahead = self._slip.side * angle
        if ahead < 0.0 and self.is_closed_form:
            return 0.0
        ahead = min(ahead, self._stop)
        return self._before(ahead) if self.is_closed_form else self._drawn.cdf(angle)

    def quantile(self, q: float) -> float | None:
        """Return the angle in rad at which `cdf` is q; None where that is in no equilibrium.

        Raises
        ------
        ValueError
            If `q` is not between 0 and 1.
        """
        if not 0.0 < q < 1.0:
            raise ValueError(f'q is {q!r}, allowed is between 0 and 1')
        if not self.is_closed_form:
            return self._drawn.quantile(q)
        score = _NORMAL.inv_cdf(q)
        at_zero, at_stop = self._ends
        if not at_zero < score <= at_stop:
            return None
        side: float = self._slip.side
        return side * self._angle_of(score)

    def _angle_of(self, score: float) -> float:
        """Angle ahead in rad at which the score reaches a value between those at its ends."""
        (low, at_low), (high, at_high) = (0.0, self._ends[0]), (self._stop, self._ends[1])
        before, ahead = (high, at_high), low + (score - at_low) * (high - low) / (at_high - at_low)
        for _ in range(STEPS):
            value = self._score(ahead)
            low, high = (ahead, high) if value < score else (low, ahead)
            rise = value - before[1]
            nearer = ahead + (score - value) * (ahead - before[0]) / rise if rise else math.nan
            if not low <= nearer <= high:
                nearer = 0.5 * (low + high)
            if abs(nearer - ahead) < LAST_STEP:
                return nearer
            before, ahead = (ahead, value), nearer
        return ahead

    def interval(self, level: float = 0.95) -> tuple[float, float] | None:
        """Return the interval in rad that holds the angle of an equilibrium with a probability.

        Given that it is one; None where it never is.

        Parameters
        ----------
        level : float
            Between 0 and 1.

        Raises
        ------
        ValueError
            If it is not.
        """
        if not 0.0 < level < 1.0:
            raise ValueError(f'level is {level!r}, allowed is between 0 and 1')
        if not self.is_closed_form:
            return self._drawn.interval(level)
        low, high = self._at_ends
        shares = (0.5 * (1.0 - level), 0.5 * (1.0 + level))
        levels = [low + share * (high - low) for share in shares]
        if not 0.0 < levels[0] < levels[1] < 1.0:
            return None
        one, other = map(self.quantile, levels)
        if one is None or other is None:
            return None
        return min(one, other), max(one, other)

    @kept
    def _ends(self) -> tuple[float, float]:
        """The score at 0 and at the stop."""
        return self._score(0.0), self._score(self._stop)

    @kept
    def _at_ends(self) -> tuple[float, float]:
        """F at 0 and at the stop."""
        at_zero, at_stop = self._ends
        return _NORMAL.cdf(at_zero), _NORMAL.cdf(at_stop)

    def _before(self, ahead: float) -> float:
        """F at an angle ahead in rad."""
        return _NORMAL.cdf(self._score(ahead))

    def _score(self, ahead: float) -> float:
        """Return g / σ_g, or its negative where g falls, at an angle ahead in rad."""
        slip = self._slip
        point = slip.at(ahead)
        by_tensions = slip_by_tensions(slip, point, self._design.relative_lever)
        variance = self._stddev**2 * (by_tensions[0] ** 2 + by_tensions[1] ** 2)
        if self._uncertainty is not None:
            names = self._uncertainty.parameters
            slopes = excess_by_design(
                lambda other: self._excess_of(other, ahead), self._design, names, slip.total
            )
            variance += self._uncertainty.variance(dict(zip(names, slopes, strict=True)))
        return self._direction * float(point.excess) / math.sqrt(variance)

    def _excess_of(self, design: JointDesign, ahead: float) -> float:
        """Return g in units of r T for another design, at an angle ahead in rad."""
        slip = taut_slip(design, self._tensions, self._load).facing(self._slip.side)
        return float(slip.value(ahead))

    @kept
    def _drawn(self) -> DrawnSlipAngles:
        return DrawnSlipAngles(
            self._design, self._tensions, self._load, self._stddev, self._uncertainty
        )
