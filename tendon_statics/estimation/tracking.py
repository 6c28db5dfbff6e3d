"""``estimation: tracking``: with the memory of a tracker, which believes each sample."""

from __future__ import annotations

import copy

from ..physics import Equilibrium, Regime, StickSlipTracker
from ..physics.noise_risk import noise_risk
from .estimate import KnownLoad, Remark, Sample
from .exact_estimate import ExactEstimate
from .method import Method, within_stop
from .settings import Settings

AT_LIMIT = {Regime.SLIPPING: Regime.EQUILIBRIUM, Regime.DRIVEN_TO_STOP: Regime.DRIVEN_TO_STOP}
"""Regime in which a tracked unit has moved → what `solve` calls the state it came to"""


class TrackedEstimate(ExactEstimate):
    """Where a tracked unit is.

    Parameters
    ----------
    brought : Equilibrium, optional
        How it came where it is, as an answer of `solve`; None if it was put there.
    """

    def __init__(
        self,
        result: Equilibrium,
        known: KnownLoad,
        settings: Settings,
        brought: Equilibrium | None,
    ) -> None:
        if not known.is_assured:  # Under a load that may be wrong nothing of the unit is sure.
            result = result._replace(angle_assured=False)
        super().__init__(result, known, settings)
        self._brought = brought

    @property
    def angle_assured(self) -> bool:
        """Whether the unit cannot have moved unseen."""
        return self.result.angle_assured and self.is_confirmed

    @property
    def bend_angle_stddev(self) -> float | None:
        """Standard deviation in rad of where it slipped to, to first order."""
        settings, covariance = self.settings, self.settings.design_uncertainty
        if not self.angle_assured:
            return None
        if covariance is None or self._brought is None:
            return self.result.bend_angle_stddev(settings.tension_stddev)
        return self._brought.bend_angle_stddev(settings.tension_stddev, covariance)

    @property
    def remarks(self) -> list[Remark]:
        """What is not as it should be."""
        found = super().remarks
        if not self.angle_assured:
            found.append(Remark.UNASSURED)
        risk = noise_risk(self.result, self.settings.tension_stddev)
        if risk is not None and risk.is_unsafe:
            found.append(Remark.NOISE)
        return found


class Tracking(Method):
    """Follows the unit, and takes each pair of tensions as it is."""

    remembers = True

    def __init__(self, settings: Settings) -> None:
        super().__init__(settings)
        self._tracker = StickSlipTracker(settings.design, settings.initial_bend_angle)
        self._brought: Equilibrium | None = None

    def update(self, sample: Sample) -> TrackedEstimate:
        """Follow the unit through a pair of tensions."""
        result = self._tracker.update(*sample.pair, sample.known.load)
        if result.regime in AT_LIMIT:
            self._brought = result._replace(
                regime=AT_LIMIT[result.regime], root_count=1, slip_gradient=None
            )
        return TrackedEstimate(result, sample.known, self.settings, self._brought)

    def imagine(self, sample: Sample) -> TrackedEstimate:
        """Work out where a pair of tensions would take the unit."""
        tracker = copy.copy(self._tracker)
        result = tracker.update(*sample.pair, sample.known.load)
        return TrackedEstimate(result, sample.known, self.settings, self._brought)

    def change_settings(self, settings: Settings) -> str:
        """Go on with other settings, from the same angle."""
        said = ''
        if settings.design != self.settings.design:
            _, said = within_stop(self._tracker.bend_angle, settings.design)
            self._tracker.change_design(settings.design)
            self._brought = None
        self.settings = settings
        return said

    def doubt(self) -> None:
        """Take it that the unit may have moved unseen."""
        self._tracker.doubt()

    def put(self, bend_angle: float) -> None:
        """Put the unit to an angle in rad."""
        self._tracker.reset(bend_angle)
        self._brought = None
