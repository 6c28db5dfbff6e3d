"""What is said of a unit where tensions are noisy: the answer of a filter."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..physics import Regime, TensionError, admissible_angles, slip_margin
from ..physics.kept import kept
from .estimate import Estimate, Interval, KnownLoad, Remark
from .settings import Settings

if TYPE_CHECKING:
    from ..physics import FilterState

UNEXPLAINED = 1e-9
"""Consistency below which the model does not explain the measured angle: chance alone comes there
less than once a day at 500 Hz"""


class FilteredEstimate(Estimate):
    """Where a filter says that a unit is.

    Parameters
    ----------
    measured : float
        When the tensions were, in s.
    """

    def __init__(
        self,
        state: FilterState,
        known: KnownLoad,
        settings: Settings,
        measured: float,
    ) -> None:
        tensions = (state.tension_l, state.tension_s)
        super().__init__(known, settings, state.regime, tensions, state.bend_angle)
        self.state = state
        self.measured = measured
        self.is_provisional = state.provisional
        self.consistency = state.consistency
        self._assured = state.assured and known.is_assured

    @property
    def angle_assured(self) -> bool:
        """Whether the unit cannot have moved unseen."""
        return self._assured

    @property
    def bend_angle_stddev(self) -> float | None:
        """Standard deviation of the angle in rad."""
        return self.state.bend_angle_stddev if self._assured else None

    @property
    def interval(self) -> Interval | None:
        """Interval that holds the angle with the confidence of the settings."""
        return self.state.interval(self.settings.confidence) if self._assured else None

    @property
    def regime_probabilities(self) -> Mapping[Regime, float]:
        """Probability of each regime."""
        return self.state.regime_probabilities

    @kept
    def pressure(self) -> float | None:
        """Median of the pressure in Pa."""
        return self.state.pressure

    @property
    def pressure_stddev(self) -> float | None:
        """Its standard deviation in Pa."""
        return self.state.pressure_stddev

    @kept
    def slip_margin(self) -> float | None:
        """M / K at the median of the angle, under these tensions, noise and all."""
        if self.bend_angle is None:
            return None
        try:
            return slip_margin(
                self.design, self.tension_l, self.tension_s, self.bend_angle, self.load
            )
        except TensionError:  # smoothed tensions that do not seat the joint
            return None

    @kept
    def admissible_angles(self) -> list[Interval]:
        """Where friction can hold the unit under these tensions, noise and all."""
        if self.regime is Regime.SLACK:
            return []
        try:
            return admissible_angles(self.design, self.tension_l, self.tension_s, self.load)
        except TensionError:
            return []

    @property
    def branch_consistent(self) -> bool | None:
        """Whether there is a pressure that the model stands behind."""
        return None if self.bend_angle is None else self.pressure is not None

    @property
    def remarks(self) -> list[Remark]:
        """What is not as it should be."""
        found = super().remarks
        if self.consistency < UNEXPLAINED:
            found.append(Remark.UNEXPLAINED)
        if not self._assured:
            found.append(Remark.UNASSURED)
        return found
