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
from collections.abc import Callable, Sequence
from statistics import NormalDist
from typing import NamedTuple

from .design import JointDesign
from .design_gradients import neighbours
from .design_uncertainty import DesignUncertainty
from .gradients import slip_by_tensions
from .pushed_unit import PushedUnit
from .slip import Slip, SlipPoint
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
    with_design : callable
        Returns the same unit with another design, whose weight and levers are that one's.
    """

    def __init__(
        self, unit: PushedUnit, noise: Noise, with_design: Callable[[JointDesign], PushedUnit]
    ) -> None:
        self._unit, self._noise = unit, noise
        uncertainty = noise.design
        self._by_design = {
            name: [
                (with_design(design), weight)
                for design, weight in neighbours(unit.design, name, unit.total)
            ]
            for name in (uncertainty.parameters if uncertainty else ())
        }
        """Parameter of the design → units next to it by that, and weights"""

    def towards(self, force: float, side: float) -> float:
        """Return g / σ_g under a force in N, for slipping to a side, 1 or −1.

        Where the tensions do not seat the joint, at those closest to them that do.
        """
        return self._towards(force, (side,), self._unit.lift(force))[0]

    def against(self, force: float, sides: Sequence[float]) -> tuple[list[float], float]:
        """Return that for several sides, and by how many deviations the joint is not seated."""
        lift = self._unit.lift(force)
        variance = self._of_measured_lift(force)
        variance += self._of_design(lambda other: other.lift(force))
        return self._towards(force, sides, lift), score(lift, variance)

    def _towards(self, force: float, sides: Sequence[float], lift: float) -> list[float]:
        short = max(0.0, lift + SEATED * abs(lift + self._unit.total))
        unit = _raised(self._unit, short)
        slip, found = unit.slip(force), []
        for side in sides:
            facing = slip if side == slip.side else slip.facing(side)
            point = facing.at(side * unit.bend_angle)
            variance = self._of_measured(force, facing, point)

            def excess(other: PushedUnit, side: float = side) -> float:
                return _raised(other, short).excess(force, side)

            variance += self._of_design(excess)
            found.append(score(float(point.excess), variance))
        return found

    def _of_measured(self, _force: float, slip: Slip, point: SlipPoint) -> float:
        """Return the variance that g has by what is measured."""
        noise = self._noise
        by_pair = slip_by_tensions(slip, point, self._unit.design.relative_lever)
        variance: float = noise.tension_stddev**2 * (by_pair[0] ** 2 + by_pair[1] ** 2)
        return variance + (noise.bend_angle_stddev * float(point.slope)) ** 2

    def _of_measured_lift(self, force: float) -> float:
        """Return the variance that the lift has by what is measured, in N²."""
        noise = self._noise
        variance = 2.0 * noise.tension_stddev**2
        return variance + (noise.bend_angle_stddev * self._lift_by_angle(force)) ** 2

    def _lift_by_angle(self, force: float) -> float:
        """Return the derivative of the lift by the angle in N/rad."""
        if not self._noise.bend_angle_stddev:
            return 0.0
        unit = self._unit
        before, after = (
            unit._replace(bend_angle=unit.bend_angle + step).lift(force) for step in (-STEP, STEP)
        )
        return (after - before) / (2.0 * STEP)

    def _of_design(self, quantity: Callable[[PushedUnit], float]) -> float:
        """Return the variance that a quantity of the unit has by its design's."""
        uncertainty = self._noise.design
        if uncertainty is None:
            return 0.0
        return uncertainty.variance(
            {
                name: math.fsum(weight * quantity(unit) for unit, weight in units)
                for name, units in self._by_design.items()
            }
        )


def _raised(unit: PushedUnit, by: float) -> PushedUnit:
    """Return a unit with both tensions together raised, in N."""
    if not by:
        return unit
    left, right = unit.tensions
    return unit._replace(tensions=Tensions(left + 0.5 * by, right + 0.5 * by))


def score(value: float, variance: float) -> float:
    """Return a value in deviations, infinite where it is exact."""
    if variance > 0.0:
        return value / math.sqrt(variance)
    return math.copysign(math.inf, value) if value else 0.0


def as_score(probability: float) -> float:
    """Return the deviations below which a value is with a probability; never infinite."""
    return NORMAL.inv_cdf(min(max(probability, 1e-300), 1.0 - 1e-16))


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
            (towards,), lift = self.scores.against(force, (self.slips_to,))
            return max(abs(towards), lift), -abs(towards)
        against, lift = self.scores.against(force, self.sides)
        least = min(against) if len(against) > 1 else -math.inf
        return max(*against, lift), least

    def beyond(self, force: float, level: float) -> float:
        """Return by how much the doubt, as a score, is beyond that of a level."""
        most, least = self.bounds(force)
        return as_score(NORMAL.cdf(most) - NORMAL.cdf(least)) - as_score(level)

    def probability(self, force: float) -> float:
        """Return the probability that the exact set has a force.

        While the unit slips the set is one force; then that of a reading as far off.
        """
        if self.slips_to:
            return 2.0 * NORMAL.cdf(-self.bounds(force)[0])
        against, lift = self.scores.against(force, self.sides)
        excluded = sum(map(NORMAL.cdf, (*against, lift)))
        return max(0.0, 1.0 - excluded)
