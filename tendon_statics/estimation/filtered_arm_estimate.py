"""What is said of an arm where tensions are noisy: the answer of a filter."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..physics import Regime
from .arm_estimate import ArmEstimate
from .arm_settings import ArmSettings
from .estimate import Interval, KnownLoad, Remark

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..physics import ArmFilterState, TipPose


class FilteredArmEstimate(ArmEstimate):
    """Where a filter says that an arm is: medians, and how far the noise lets one know.

    Attributes
    ----------
    state : ArmFilterState
        The filter's answer.
    measured : float
        When the tensions were, in s.
    """

    state: ArmFilterState  # type: ignore[assignment]

    def __init__(
        self, state: ArmFilterState, known: KnownLoad, settings: ArmSettings, measured: float
    ) -> None:
        self.state = state
        self.known = known
        self.settings = settings
        self.measured = measured
        self.is_provisional = state.provisional

    @property
    def bend_angle_stddevs(self) -> tuple[float | None, ...]:
        """Standard deviation of each angle in rad; None where not assured."""
        if not self.is_sure:
            return (None,) * len(self.state.joints)
        return self.state.bend_angle_stddevs

    @property
    def intervals(self) -> tuple[Interval | None, ...]:
        """Interval that holds each angle with the confidence; None where not assured."""
        found = self.state.intervals(self.settings.confidence)
        return tuple(
            interval if assured else None
            for interval, assured in zip(found, self.angles_assured, strict=True)
        )

    @property
    def regime_probabilities(self) -> tuple[Mapping[Regime, float], ...]:
        """Probability of each regime, joint by joint."""
        return self.state.regime_probabilities

    @property
    def tip_covariance(self) -> NDArray[np.float64] | None:
        """Of the tip's (x, z, tilt); None where an angle is not assured."""
        return self.state.tip_covariance if self.is_sure else None

    @property
    def tip_interval(self) -> tuple[TipPose, TipPose] | None:
        """Lower and upper ends of the intervals that hold x, z and tilt of the tip."""
        if not all(self.angles_assured):
            return None
        return self.state.tip_interval(self.settings.confidence)

    @property
    def bands(self) -> list[list[Interval]]:
        """Of each joint the angles at which friction can hold it, with the others frozen.

        At the medians of their angles, under these tensions, noise and all.
        """
        return self.state.admissible_angles

    @property
    def slow_remarks(self) -> list[Remark]:
        """None beside those that are quick to tell: the noise is in the answer."""
        return []

    def joints_with(self, remark: Remark) -> list[bool]:
        """Return which joints have a remark, as far as it is of joints."""
        if remark is Remark.UNASSURED:
            return [not assured for assured in self.angles_assured]
        return [False] * len(self.state.joints)

    def as_dict(self) -> dict[str, Any]:
        """Return it by name, ready for JSON; what is not known is None."""
        of_state = self.state.as_dict()
        return {
            'joint_names': self.settings.joint_names,
            **of_state,
            'angles_assured': self.angles_assured,
            'bend_angle_stddevs': self.bend_angle_stddevs,
            'intervals': self.intervals,
            'tip_stddev': of_state['tip_stddev'] if self.is_sure else None,
        }
