"""``estimation: tracking``: with the memory of a tracker, which believes each sample."""

from __future__ import annotations

import copy
import math

from ..physics import Equilibrium, Regime, StickSlipTracker, TensionError, admissible_angles
from ..physics.noise_risk import LARGEST, noise_risk
from .estimate import ExactEstimate, KnownLoad, Remark, Sample
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
    is_assured : bool
        Whether the tensions, now and before, are such that it is there for sure.
    is_noisy : bool
        Whether noise of these tensions alone can slip it too far.
    """

    def __init__(
        self,
        result: Equilibrium,
        known: KnownLoad,
        settings: Settings,
        brought: Equilibrium | None,
        *,
        is_assured: bool = True,
        is_noisy: bool = False,
    ) -> None:
        if not (is_assured and known.is_assured):
            result = result._replace(angle_assured=False)
        super().__init__(result, known, settings)
        self._brought = brought
        self._is_noisy = is_noisy

    @property
    def angle_assured(self) -> bool:
        """Whether the unit cannot have moved unseen."""
        return self.result.angle_assured

    @property
    def bend_angle_stddev(self) -> float | None:
        """Standard deviation in rad of where it slipped to, to first order."""
        settings, covariance = self.settings, self.settings.design_uncertainty
        if covariance is None or self._brought is None or not self.angle_assured:
            return self.result.bend_angle_stddev(settings.tension_stddev)
        return self._brought.bend_angle_stddev(settings.tension_stddev, covariance)

    @property
    def remarks(self) -> list[Remark]:
        """What is not as it should be."""
        found = super().remarks
        if not self.angle_assured:
            found.append(Remark.UNASSURED)
        if self._is_noisy:
            found.append(Remark.NOISE)
        return found


class Tracking(Method):
    """Follows the unit, and takes each pair of tensions as it is.

    Where noise of them alone can slip the unit and by more than a degree, that is not safe: it may
    then be elsewhere, as after all else that casts doubt, though it is followed as before. A stop
    tells where it is if friction can hold it nowhere else, whatever the noise.
    """

    remembers = True

    def __init__(self, settings: Settings) -> None:
        super().__init__(settings)
        self._tracker = StickSlipTracker(settings.design, settings.initial_bend_angle)
        self._brought: Equilibrium | None = None
        self._may_be_elsewhere = False
        """Whether noise, or what nobody saw, may have slipped it"""

    def update(self, sample: Sample) -> TrackedEstimate:
        """Follow the unit through a pair of tensions."""
        result = self._tracker.update(sample.tension_l, sample.tension_s, sample.known.load)
        if result.regime in AT_LIMIT:
            self._brought = result._replace(
                regime=AT_LIMIT[result.regime], root_count=1, slip_gradient=None
            )
        is_noisy = self._is_noisy(result)
        self._may_be_elsewhere |= is_noisy or not result.angle_assured
        if self._may_be_elsewhere and self._is_at_stop_for_sure(result):
            self._may_be_elsewhere = False
        return self._estimate(result, sample, is_noisy=is_noisy)

    def imagine(self, sample: Sample) -> TrackedEstimate:
        """Work out where a pair of tensions would take the unit."""
        tracker = copy.copy(self._tracker)
        result = tracker.update(sample.tension_l, sample.tension_s, sample.known.load)
        return self._estimate(result, sample, is_noisy=self._is_noisy(result))

    def _is_noisy(self, result: Equilibrium) -> bool:
        risk = noise_risk(result, self.settings.tension_stddev)
        return risk is not None and risk.is_unsafe

    def _is_at_stop_for_sure(self, result: Equilibrium) -> bool:
        """Whether a unit that may be anywhere is driven to the stop, whatever the noise."""
        if result.regime is not Regime.DRIVEN_TO_STOP:
            return False
        # By the noise that drives it least, so many deviations of both tensions together.
        deviation = self.settings.tension_stddev / math.sqrt(2.0)
        noise = math.copysign(LARGEST * deviation, result.bend_angle or 0.0)
        pair = result.tension_l + noise, result.tension_s - noise
        try:
            return not admissible_angles(self.settings.design, *pair, result.load)
        except TensionError:
            return False

    def _estimate(self, result: Equilibrium, sample: Sample, *, is_noisy: bool) -> TrackedEstimate:
        is_safe = not (is_noisy or self._may_be_elsewhere)
        return TrackedEstimate(
            *(result, sample.known, self.settings, self._brought),
            is_assured=sample.is_confirmed and is_safe,
            is_noisy=is_noisy,
        )

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
        self._may_be_elsewhere = True

    def put(self, bend_angle: float) -> None:
        """Put the unit to an angle in rad."""
        self._tracker.reset(bend_angle)
        self._brought = None
        self._may_be_elsewhere = False
