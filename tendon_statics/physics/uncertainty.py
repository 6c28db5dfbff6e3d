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

import bisect
import math
from functools import cached_property
from statistics import NormalDist

from .design import JointDesign
from .design_gradients import excess_by_design
from .design_uncertainty import DesignUncertainty
from .errors import TensionError
from .gradients import slip_by_tensions
from .load import UPRIGHT, Load
from .roots import Probe, refine
from .slip import Slip
from .solver import solve
from .state import Regime
from .tensions import Tensions, check_tensions, taut_slip

DRAWS = 8192
"""Pairs that are solved where there is no closed form"""

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
    slip = taut_slip(design, tensions, load)
    if tension_l > tension_s:
        slip = slip.mirrored()
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

    @cached_property
    def is_closed_form(self) -> bool:
        """Whether it is worked out in closed form; otherwise from `DRAWS` draws."""
        return self._is_side_sure and self._direction != 0.0

    @cached_property
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
        regime = Regime(regime)
        if not self.is_closed_form:
            return self._drawn.probability(regime)
        at_zero, at_stop = self._before(0.0), self._before(self._stop)
        first, last = (
            (Regime.DRIVEN_TO_STOP, Regime.HELD)
            if self._direction > 0.0
            else (Regime.HELD, Regime.DRIVEN_TO_STOP)
        )
        found = {first: at_zero, last: 1.0 - at_stop, Regime.EQUILIBRIUM: at_stop - at_zero}
        return max(found.get(regime, 0.0), 0.0)

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
        score = _Score(self, _NORMAL.inv_cdf(q))
        ends = score.probe(0.0), score.probe(self._stop)
        if not ends[0][1] < 0.0 <= ends[1][1]:
            return None
        root, _ = refine(score, ends)
        ahead: float = root[0]
        return self._slip.side * ahead  # type: ignore[no-any-return]

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
        low, high = self._before(0.0), self._before(self._stop)
        shares = (0.5 * (1.0 - level), 0.5 * (1.0 + level))
        levels = [low + share * (high - low) for share in shares]
        if not 0.0 < levels[0] < levels[1] < 1.0:
            return None
        one, other = map(self.quantile, levels)
        if one is None or other is None:
            return None
        return min(one, other), max(one, other)

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
            names, covariance = self._uncertainty.parameters, self._uncertainty.covariance
            slopes = excess_by_design(
                lambda other: self._excess_of(other, ahead), self._design, names, slip.total
            )
            variance += sum(
                a * b * covariance[i][j]
                for i, a in enumerate(slopes)
                for j, b in enumerate(slopes)
            )
        return self._direction * float(point.excess) / math.sqrt(variance)

    def _excess_of(self, design: JointDesign, ahead: float) -> float:
        """Return g in units of r T for another design, at an angle ahead in rad."""
        slip = taut_slip(design, self._tensions, self._load).facing(self._slip.side)
        return float(slip.value(ahead))

    @cached_property
    def _drawn(self) -> _Drawn:
        return _Drawn(self._design, self._tensions, self._load, self._stddev, self._uncertainty)


class _Score:
    """The score above a level as a function of which `roots.refine` finds the root."""

    def __init__(self, distribution: SlipAngleDistribution, level: float) -> None:
        self._distribution = distribution
        self._level = level

    def probe(self, place: float) -> Probe:
        """Return place, value and slope."""
        step = 1e-6
        before, here, after = (
            self._distribution._score(at) for at in (place - step, place, place + step)
        )
        return place, here - self._level, (after - before) / (2.0 * step)

    def slope_bounds(self, _one: Probe, _other: Probe) -> tuple[float, float]:
        """Nothing is known of the slope."""
        return -math.inf, math.inf


class _Drawn:
    """The same from draws of tensions and design, solved one by one or as a batch."""

    def __init__(
        self,
        design: JointDesign,
        tensions: Tensions,
        load: Load,
        tension_stddev: float,
        uncertainty: DesignUncertainty | None,
    ) -> None:
        import numpy as np  # Here, for who stays in closed form should not wait for it.

        from .batch import INVALID, REGIME_CODES, solve_batch
        from .draws import draw_designs, draw_normals

        parameters = 0 if uncertainty is None else len(uncertainty.parameters)
        normals = draw_normals(DRAWS, 2 + parameters)
        pairs = np.array(tensions)[:, None] + tension_stddev * normals[:2]
        # A tension below zero is one of a slack cable.
        pairs = np.maximum(pairs, 0.0)
        if uncertainty is not None:
            designs = draw_designs(design, uncertainty, normals[2:])
            # One by one: a batch is of one design.
            answers = [
                _answer(one, left, right, load)
                for one, (left, right) in zip(designs, pairs.T.tolist(), strict=True)
            ]
            regimes = np.array(
                [INVALID if regime is None else REGIME_CODES[regime] for regime, _ in answers]
            )
            angles = np.array([angle for _, angle in answers])
        else:
            batch = solve_batch(design, pairs[0], pairs[1], load)
            regimes, angles = batch.regime, batch.bend_angle
        self._regimes = regimes
        self._codes = REGIME_CODES
        at_root = regimes == REGIME_CODES[Regime.EQUILIBRIUM]
        self._angles: list[float] = sorted(angles[at_root].tolist())
        driven = regimes == REGIME_CODES[Regime.DRIVEN_TO_STOP]
        self._driven = {side: int(np.sum(driven & (side * angles > 0.0))) for side in (1.0, -1.0)}
        self._of_side = {
            1.0: int(np.sum(pairs[1] >= pairs[0])),
            -1.0: int(np.sum(pairs[1] < pairs[0])),
        }

    def probability(self, regime: Regime) -> float:
        return float((self._regimes == self._codes[regime]).mean())

    def cdf(self, angle: float) -> float:
        side = -1.0 if angle < 0.0 else 1.0
        count = sum(0.0 <= side * one <= side * angle for one in self._angles)
        return (self._driven[side] + count) / max(self._of_side[side], 1)

    def quantile(self, q: float) -> float | None:
        place = bisect.bisect_left(
            range(len(self._angles)), q, key=lambda index: self.cdf(self._angles[index])
        )
        if not self._angles or place == len(self._angles) or q < self.cdf(0.0):
            return None
        return self._angles[place]

    def interval(self, level: float) -> tuple[float, float] | None:
        if not self._angles:
            return None
        outside = int(0.5 * (1.0 - level) * len(self._angles))
        return self._angles[outside], self._angles[-1 - outside]


def _answer(
    design: JointDesign, tension_l: float, tension_s: float, load: Load
) -> tuple[Regime | None, float]:
    """Regime and bend angle in rad; None and NaN where there is none."""
    try:
        answer = solve(design, tension_l, tension_s, load)
    except TensionError:
        return None, math.nan
    return answer.regime, math.nan if answer.bend_angle is None else answer.bend_angle
