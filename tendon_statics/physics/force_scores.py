"""By how many standard deviations measurements speak against a tip force.

To first order in the noise of tensions, angle and design, the slip function g under a force F is
normal about its value, with the deviation σ_g. So g / σ_g says how sure it is that F would have
the unit slip to a side. A force is doubtful as far as it would have it slip to one side and not to
the other,

    doubt = Φ(x) − Φ(y),   x = max(g_s / σ_s, g_l / σ_l),   y the smaller,

since of a unit that is at rest g is below zero on both sides. A set of all forces with a doubt up
to a level holds the true one at that rate if that is at an end of the exact set, and more often if
it is inside: where the set is wide y is −∞ and each end one-sided, where friction is nothing y is
−x and the ends are those of an ordinary interval (Imbens and Manski, Econometrica 72, 2004).
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from statistics import NormalDist
from typing import Any, NamedTuple

from .design import JointDesign
from .design_gradients import excess_by_design
from .design_uncertainty import DesignUncertainty
from .gradients import slip_by_tensions
from .load import Load
from .pushed_unit import PushedUnit
from .tensions import Tensions

STEP = 1e-6
"""rad, of differences by the angle"""

SEATED = 1e-4
"""Share by which tensions have to exceed what seats the joint, for differences by the design"""

NORMAL = NormalDist()


class Noise(NamedTuple):
    """How well a state is known."""

    tension_stddev: float
    """N, of each tension, the two independent"""
    bend_angle_stddev: float
    """rad"""
    design: DesignUncertainty | None

    @property
    def is_none(self) -> bool:
        """Whether all is exact."""
        return self.tension_stddev == 0.0 == self.bend_angle_stddev and (
            self.design is None or not any(self.design.flat)
        )


class ForceScores:
    """What noisy measurements of a pushed unit say against forces.

    Parameters
    ----------
    unit : PushedUnit
    load : Load
        All that acts on it but the force; the weight follows an uncertain design.
    """

    def __init__(self, unit: PushedUnit, load: Load, noise: Noise) -> None:
        self._unit, self._load, self._noise = unit, load, noise

    def towards(self, force: float, side: float) -> float:
        """Return g / σ_g under a force in N, for slipping to a side, 1 or −1.

        Where the tensions do not seat the joint, at those closest to them that do.
        """
        unit = self._seated(force)
        slip, ahead = unit.slip(force).facing(side), side * unit.bend_angle
        point = slip.at(ahead)
        behind, before = slip_by_tensions(slip, point, unit.design.relative_lever)
        variance = self._noise.tension_stddev**2 * (behind * behind + before * before)
        variance += (self._noise.bend_angle_stddev * point.slope) ** 2
        variance += self._of_design(lambda other: other.excess(force, side), unit)
        return score(float(point.excess), variance)

    def lift(self, force: float) -> float:
        """Return by how many deviations the tensions fall short of seating the joint."""
        unit, noise = self._unit, self._noise
        variance = 2.0 * noise.tension_stddev**2
        if noise.bend_angle_stddev:
            before, after = (
                unit._replace(bend_angle=unit.bend_angle + step).lift(force)
                for step in (-STEP, STEP)
            )
            variance += (noise.bend_angle_stddev * (after - before) / (2.0 * STEP)) ** 2
        variance += self._of_design(lambda other: other.lift(force), unit)
        return score(unit.lift(force), variance)

    def _seated(self, force: float) -> PushedUnit:
        """Return the unit, with both tensions raised by as much as seats it, if anything."""
        unit = self._unit
        lift = unit.lift(force)
        short = lift + SEATED * abs(lift + unit.total)
        if short <= 0.0:
            return unit
        return unit._replace(tensions=Tensions(*(t + 0.5 * short for t in unit.tensions)))

    def _of_design(self, quantity: Any, unit: PushedUnit) -> float:
        """Return the variance that a quantity of a pushed unit has by the design's."""
        uncertainty = self._noise.design
        if uncertainty is None:
            return 0.0

        def of(design: JointDesign) -> float:
            value: float = quantity(unit._replace(design=design, dead=self._load.on(design)))
            return value

        slopes = excess_by_design(of, unit.design, uncertainty.parameters, unit.total)
        return math.fsum(
            one * other * covariance
            for one, row in zip(slopes, uncertainty.covariance, strict=True)
            for other, covariance in zip(slopes, row, strict=True)
        )


def score(value: float, variance: float) -> float:
    """Return a value in deviations, infinite where it is exact."""
    if variance > 0.0:
        return value / math.sqrt(variance)
    return math.copysign(math.inf, value) if value else 0.0


@dataclasses.dataclass(frozen=True)
class Doubt:
    """How much speaks against a force, by what is known of what holds the unit.

    Parameters
    ----------
    sides : sequence of float
        To which the unit is known not to slip.
    slips_to : float
        Side to which it slips, so that friction is at its limit; 0 if to none.
    """

    scores: ForceScores
    sides: Sequence[float]
    slips_to: float = 0.0

    def bounds(self, force: float) -> tuple[float, float]:
        """Return x and y of the doubt Φ(x) − Φ(y)."""
        if self.slips_to:
            score = abs(self.scores.towards(force, self.slips_to))
            return max(score, self.scores.lift(force)), -score
        against = [self.scores.towards(force, side) for side in self.sides]
        least = min(against) if len(against) > 1 else -math.inf
        return max(*against, self.scores.lift(force)), least

    def beyond(self, force: float, level: float) -> float:
        """Return by how much the doubt, as a score, is beyond that of a level."""
        most, least = self.bounds(force)
        doubt = NORMAL.cdf(most) - NORMAL.cdf(least)
        clipped = min(max(doubt, 1e-300), 1.0 - 1e-16)
        return NORMAL.inv_cdf(clipped) - NORMAL.inv_cdf(level)

    def probability(self, force: float) -> float:
        """Return the probability that the exact set has a force.

        While the unit slips the set is one force; then that of a reading as far off.
        """
        if self.slips_to:
            return 2.0 * NORMAL.cdf(-self.bounds(force)[0])
        against = [self.scores.towards(force, side) for side in self.sides]
        excluded = sum(map(NORMAL.cdf, (*against, self.scores.lift(force))))
        return max(0.0, 1.0 - excluded)
