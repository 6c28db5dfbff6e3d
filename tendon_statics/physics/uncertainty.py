"""How sure the answer for one pair of noisy tensions is: the distribution of the slip angle.

The slip angle is that at which the unit is about to slip to the side of the stronger cable. Where
the slip function g rises with the angle through the range, it lies at or before x just where
g(x) ≥ 0. So to first order in the noise

    F(x) = P(slip angle ≤ x) = Φ(s(x)),  s(x) = g(x) / σ_g(x),

whatever the regime: F(0) is the probability of ``driven_to_stop``, 1 − F(θ_max) that of ``held``,
and in between lies an equilibrium. Where g falls, it is Φ(−s), and the two change places. Where g
turns it may have several roots, and the one nearest to 0 counts; see `first_root`.

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
from .first_root import FirstRoot, Knot
from .gradients import slip_by_tensions
from .kept import kept
from .load import UPRIGHT, Load
from .regime import Regime
from .slip import Probe, Slip
from .state import Equilibrium
from .tensions import Tensions, check_tensions, taut_slip

FAR = 5.0
"""Standard deviations that count as never"""

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

    In closed form where the side of slip is sure; from `DRAWS` draws through `solve_batch` next to
    equal tensions and to a slack cable, which takes a hundred times as long.
    `SlipAngleDistribution.is_closed_form` tells.

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


def distribution_about(
    equilibrium: Equilibrium,
    tension_stddev: float,
    design_covariance: DesignUncertainty | None = None,
) -> SlipAngleDistribution:
    """`slip_angle_distribution` of tensions that are solved already, with their slip function.

    Parameters
    ----------
    equilibrium : Equilibrium
        Of `solve`, of two taut cables.
    """
    design, load = equilibrium.design, equilibrium.load
    pair = Tensions(equilibrium.tension_l, equilibrium.tension_s)
    if equilibrium.bend_angle is None:  # nothing has been kept of its slip function
        return slip_angle_distribution(
            design,
            *pair,
            tension_stddev=tension_stddev,
            load=load,
            design_covariance=design_covariance,
        )
    slip, _ = equilibrium._slip_and_probe
    return SlipAngleDistribution(design, pair, load, slip, tension_stddev, design_covariance)


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
    def _direction(self) -> float:
        """1 where the slip function rises through the range, −1 where it falls, else 0."""
        if not self._slip.is_determined:
            return 1.0  # the same at all angles: held, or driven to the stop
        least, greatest = self._slip.slope_bounds(*self._ends)
        return 1.0 if least > 0.0 else -1.0 if greatest < 0.0 else 0.0

    @kept
    def _ends(self) -> tuple[Probe, Probe]:
        """The slip function at 0 and at the stop."""
        return self._slip.probe(0.0), self._slip.probe(self._stop)

    @kept
    def _root(self) -> FirstRoot:
        first, last = self._ends
        return FirstRoot(
            self._score,
            (self._score_of(first), self._score_of(last)),
            is_monotonic=self._direction != 0.0,
        )

    @kept
    def is_closed_form(self) -> bool:
        """Whether it is worked out in closed form; otherwise from `DRAWS` draws.

        It is where noise neither turns the stronger cable into the weaker nor ends its tension.
        """
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
        return {
            Regime.EQUILIBRIUM: self._root.probability,
            Regime.HELD: _NORMAL.cdf(-self._root.greatest),
            Regime.SLIPPING: 0.0,
            Regime.DRIVEN_TO_STOP: _NORMAL.cdf(self._root.least),
            Regime.SLACK: 0.0,
        }

    def cdf(self, angle: float) -> float:
        """Return the probability that the slip angle lies between 0, or before, and an angle.

        What is said of a negative angle is said of its mirror image: the slip angle towards
        cable l, up to that. The whole of one side is 1. Of the two other regimes
        ``driven_to_stop`` lies before 0 and ``held`` beyond the stop; where the slip function
        falls all the way it is the other way round.

        Parameters
        ----------
        angle : float
            Within the stops, in rad.
        """
        if not self.is_closed_form:
            return self._drawn.cdf(angle)
        ahead: float = self._slip.side * angle
        if ahead < 0.0:
            return 0.0
        return self._before_zero + self._root.before(min(ahead, self._stop))

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
        share = q - self._before_zero
        return self._angle_of(share) if 0.0 < share <= self._root.probability else None

    @kept
    def _before_zero(self) -> float:
        """What of `cdf` lies before 0."""
        first = Regime.HELD if self._direction < 0.0 else Regime.DRIVEN_TO_STOP
        return self.probabilities[first]

    def _angle_of(self, share: float) -> float | None:
        """Angle in rad up to which roots have a probability."""
        ahead = self._root.angle_of(share)
        return None if ahead is None else self._slip.side * ahead

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
        whole = self._root.probability
        shares = (0.5 * (1.0 - level), 0.5 * (1.0 + level))
        one, other = (self._angle_of(whole * share) for share in shares)
        if one is None or other is None:
            return None
        return min(one, other), max(one, other)

    def _score(self, ahead: float) -> Knot:
        """Return s = g / σ_g at an angle ahead in rad."""
        return self._score_of(self._slip.probe(ahead))

    def _score_of(self, probe: Probe) -> Knot:
        """Return s = g / σ_g where the slip function was probed."""
        slip, (ahead, excess, slope) = self._slip, probe[:3]
        behind, in_front = slip_by_tensions(slip, slip.point(probe), self._design.relative_lever)
        variance = self._stddev**2 * (behind * behind + in_front * in_front)
        if self._uncertainty is not None:
            names = self._uncertainty.parameters
            slopes = excess_by_design(
                lambda other: self._excess_of(other, ahead), self._design, names, slip.total
            )
            variance += self._uncertainty.variance(dict(zip(names, slopes, strict=True)))
        deviation = math.sqrt(variance)
        return ahead, excess / deviation, slope / deviation

    def _excess_of(self, design: JointDesign, ahead: float) -> float:
        """Return g in units of r T for another design, at an angle ahead in rad."""
        slip = taut_slip(design, self._tensions, self._load).facing(self._slip.side)
        return float(slip.value(ahead))

    @kept
    def _drawn(self) -> DrawnSlipAngles:
        return DrawnSlipAngles(
            self._design, self._tensions, self._load, self._stddev, self._uncertainty
        )
