"""``estimation: equilibrium``: each pair of tensions by itself, the paper's model."""

from __future__ import annotations

from collections.abc import Mapping

from ..physics import Regime, SlipAngleDistribution, solve
from ..physics.kept import kept
from ..physics.uncertainty import distribution_about
from .estimate import Interval, Remark, Sample
from .exact_estimate import ExactEstimate
from .method import Method


class PairEstimate(ExactEstimate):
    """What one pair of tensions says by itself, and how sure that is under noise."""

    @property
    def angle_assured(self) -> bool:
        """Whether there is an angle: nothing is remembered that could be wrong."""
        return self.bend_angle is not None

    @property
    def bend_angle_stddev(self) -> float | None:
        """Standard deviation of the angle in rad, to first order."""
        settings = self.settings
        return self.result.bend_angle_stddev(settings.tension_stddev, settings.design_uncertainty)

    @kept
    def _distribution(self) -> SlipAngleDistribution | None:
        """That of the slip angle, where it is worked out as quickly as messages come."""
        settings = self.settings
        if self.regime is Regime.SLACK or not settings.tension_stddev > 0.0:
            return None
        found = distribution_about(
            self.result, settings.tension_stddev, settings.design_uncertainty
        )
        return found if found.is_closed_form else None

    @kept
    def interval(self) -> Interval | None:
        """Interval of the angle, given that the unit is about to slip, in that regime alone."""
        if self._distribution is None or self.regime is not Regime.EQUILIBRIUM:
            return None
        return self._distribution.interval(self.settings.confidence)

    @kept
    def regime_probabilities(self) -> Mapping[Regime, float] | None:
        """Probability of each regime, in closed form; None where there is none."""
        return None if self._distribution is None else self._distribution.probabilities

    @property
    def remarks(self) -> list[Remark]:
        """What is not as it should be."""
        found = super().remarks
        if self.regime is Regime.HELD:
            found.append(Remark.HELD)
        return found


class EachPair(Method):
    """Each pair of tensions by itself."""

    remembers = False

    def update(self, sample: Sample) -> PairEstimate:
        """Solve a pair of tensions."""
        return self.imagine(sample)

    def imagine(self, sample: Sample) -> PairEstimate:
        """Solve a pair of tensions."""
        settings, known = self.settings, sample.known
        result = solve(settings.design, *sample.pair, known.load)
        return PairEstimate(result, known, settings)
