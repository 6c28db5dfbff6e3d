"""How sure the answer for one pair of noisy tensions is: the distribution of the slip angle.

The slip angle is that at which the unit is about to slip to the side of the stronger cable. Where
the slip function g rises with the angle through the range, it lies at or before x just where
g(x) ≥ 0. So to first order in the noise

    F(x) = P(slip angle ≤ x) = Φ(s(x)),  s(x) = g(x) / σ_g(x),

whatever the regime: F(0) is the probability of ``driven_to_stop``, 1 − F(θ_max) that of ``held``,
and in between lies an equilibrium. Where g falls, it is Φ(−s), and the two change places. Where g
turns it may have several roots, and the one nearest to 0 counts; see `first_root`. Where noise may
turn the stronger cable into the weaker there is an F of each side, and where it may end a cable's
tension, or lift the joint off its seat, one given that it does not; see `noisy_slip`.

The gradient of the root, on which deviations rest, says nothing of all this near the end of a
regime.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

from .design import JointDesign
from .design_gradients import excess_by_design
from .design_uncertainty import DesignUncertainty
from .drawn_slip_angles import DrawnSlipAngles
from .kept import kept
from .load import UPRIGHT, Load
from .noisy_slip import NoisySlip
from .regime import Regime
from .slip import Slip
from .state import Equilibrium
from .tension_conditions import ALWAYS, Condition, TensionConditions
from .tensions import Tensions, check_tensions, taut_slip

RARE = 1e-3
"""Probability below which an equilibrium has no interval, since none is known that well"""


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

    In closed form, but where noise may change two of these: which cable is the stronger, whether
    the weaker is taut, and whether the joint is seated; or, with the paper's law, the last of
    them. There it is from draws: of tensions through `solve_batch`, which takes some hundred
    solves' time; of designs too, where these are uncertain, one by one, which takes about a
    second. `SlipAngleDistribution.is_closed_form` tells.

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
        self._conditions = TensionConditions(design, load, slip, tensions, tension_stddev)

    @property
    def is_closed_form(self) -> bool:
        """Whether it is worked out in closed form; otherwise from draws.

        It is where noise may change at most one of these: which cable is the stronger, whether the
        weaker is taut, and whether the joint is seated. With the paper's law, whose K is far from
        linear there, it may not change the last.
        """
        return not self._conditions.is_bent and len(self._conditions.near) <= 1

    @kept
    def _sides(self) -> list[NoisySlip]:
        """The slip function towards each side to which the unit may slip, the likelier first."""
        near, stronger = self._conditions.near, self._conditions.stronger
        sides = [self._noisy(self._slip, near[0] if near else ALWAYS)]
        if stronger is not None:
            sides.append(self._noisy(self._slip.mirrored(), stronger.opposite()))
        return sides

    def _noisy(self, slip: Slip, condition: Condition) -> NoisySlip:
        of_design = None
        if self._uncertainty is not None:
            of_design = partial(self._variance_of_design, slip, self._uncertainty)
        return NoisySlip(slip, self._design.max_bend_angle, self._stddev, condition, of_design)

    def probability(self, regime: Regime | str) -> float:
        """Return the probability of what `solve` would answer without noise.

        Of ``equilibrium``, ``held``, ``driven_to_stop`` and, if noise can make one, ``slack``.
        What it would refuse is in none of them.
        """
        return self.probabilities[regime if type(regime) is Regime else Regime(regime)]

    @kept
    def probabilities(self) -> dict[Regime, float]:
        """The probability of each regime."""
        if not self.is_closed_form:
            return {regime: self._drawn.probability(regime) for regime in Regime}
        equilibrium = held = driven = 0.0
        taut = self._conditions.taut
        slack = 0.0 if taut is None else 1.0 - taut.chance
        for noisy in self._sides:
            equilibrium += noisy.root.probability
            held += noisy.held
            driven += noisy.driven
        return {
            Regime.EQUILIBRIUM: equilibrium,
            Regime.HELD: held,
            Regime.SLIPPING: 0.0,
            Regime.DRIVEN_TO_STOP: driven,
            Regime.SLACK: slack,
        }

    def cdf(self, angle: float) -> float:
        """Return the probability that the slip angle lies between 0, or before, and an angle.

        What is said of a negative angle is said of its mirror image: the slip angle towards
        cable l, up to that. The whole of one side is 1; 0 belongs to that of the stronger cable.
        Of the two other regimes ``driven_to_stop`` lies before 0 and ``held`` beyond the stop;
        where the slip function falls all the way it is the other way round.

        Parameters
        ----------
        angle : float
            Within the stops, in rad.
        """
        if not self.is_closed_form:
            return self._drawn.cdf(angle)
        for noisy in self._sides:
            ahead: float = noisy.side * angle
            if ahead >= 0.0:
                return min(noisy.cdf(ahead) / self._of_side(noisy), 1.0)
        return 0.0

    def quantile(self, q: float) -> float | None:
        """Return the angle in rad at which `cdf` is q; None where that is in no equilibrium.

        On the side of the stronger cable.

        Raises
        ------
        ValueError
            If `q` is not between 0 and 1.
        """
        if not 0.0 < q < 1.0:
            raise ValueError(f'q is {q!r}, allowed is between 0 and 1')
        if not self.is_closed_form:
            return self._drawn.quantile(q)
        noisy = self._sides[0]
        ahead = noisy.quantile(q * self._of_side(noisy))
        return None if ahead is None else noisy.side * ahead

    def _of_side(self, noisy: NoisySlip) -> float:
        """Return the probability of the side, of which that of `cdf` is the whole."""
        return 1.0 if self._conditions.stronger is None else noisy.condition.chance

    def interval(self, level: float = 0.95) -> tuple[float, float] | None:
        """Return the interval in rad that holds the angle of an equilibrium with a probability.

        Given that it is one; None where that is rarer than once in 1000 times.

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
        roots = self.probabilities[Regime.EQUILIBRIUM]
        if not roots >= RARE:
            return None
        ends = 0.5 * (1.0 - level) * roots, 0.5 * (1.0 + level) * roots
        low, high = self._angles_of(ends)
        return None if low is None or high is None else (low, high)

    def _angles_of(self, probabilities: Sequence[float]) -> list[float | None]:
        """Return the angles in rad up to which equilibria have probabilities, all ascending."""
        found: list[float | None] = []
        start = 0.0
        for noisy in self._sides if self._slip.side < 0.0 else reversed(self._sides):
            root = noisy.root
            end = start + root.probability
            of_side = [one for one in probabilities if start < one <= end]
            if of_side and noisy.side > 0.0:
                found += root.angles_of([one - start for one in of_side])
            elif of_side:
                angles = root.angles_of([end - one for one in of_side])
                found += [None if angle is None else -angle for angle in angles]
            start = end
        return found

    def _variance_of_design(
        self, slip: Slip, uncertainty: DesignUncertainty, ahead: float
    ) -> float:
        """Return what the design's uncertainty adds to the variance of g, in units of r T."""

        def excess(design: JointDesign) -> float:
            return float(taut_slip(design, self._tensions, self._load, slip.side).value(ahead))

        names = uncertainty.parameters
        slopes = excess_by_design(excess, self._design, names, slip.total)
        return uncertainty.variance(dict(zip(names, slopes, strict=True)))

    @kept
    def _drawn(self) -> DrawnSlipAngles:
        return DrawnSlipAngles(
            self._design, self._tensions, self._load, self._stddev, self._uncertainty
        )
