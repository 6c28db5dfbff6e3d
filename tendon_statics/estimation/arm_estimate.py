"""What is said of an arm after the tensions of all its cables."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..physics import Regime
from ..physics.arm import Arm, ArmState, TipPose
from ..physics.noise_risk import noise_risk
from .arm_settings import ArmSettings
from .estimate import AnyEstimate, Interval, KnownLoad, Remark

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_SEVERITY = {Regime.HELD: 0, Regime.SLIPPING: 1, Regime.DRIVEN_TO_STOP: 2, Regime.SLACK: 3}


class ArmEstimate(AnyEstimate):
    """Where an arm is, joint by joint from the base on; what is not known is None.

    Attributes
    ----------
    settings : ArmSettings
        What it was worked out with.
    state : ArmState
        The model's answer.
    """

    has_parts = True

    def __init__(self, state: ArmState, known: KnownLoad, settings: ArmSettings) -> None:
        self.state = state
        self.known = known
        self.settings = settings

    @property
    def arm(self) -> Arm:
        """The arm."""
        return self.settings.arm

    @property
    def regimes(self) -> tuple[Regime, ...]:
        """Of each joint."""
        return self.state.regimes

    @property
    def bend_angles(self) -> tuple[float, ...] | None:
        """θ of each joint in rad; None while the arm is slack."""
        return self.state.bend_angles

    @property
    def angles_assured(self) -> tuple[bool, ...]:
        """False for a joint that may have moved unseen; for all under a load that may be wrong."""
        if not self.known.is_assured:
            return (False,) * len(self.state.joints)
        return self.state.angles_assured

    @property
    def bend_angle_stddevs(self) -> tuple[float | None, ...]:
        """Standard deviation of each angle in rad, to first order; None where not assured."""
        if not self.known.is_assured:
            return (None,) * len(self.state.joints)
        return self.state.bend_angle_stddevs(self.settings.tension_stddev)

    @property
    def intervals(self) -> Sequence[Interval | None] | None:
        """Ends of the interval that holds each angle with the probability of the settings."""
        return None

    @property
    def regime_probabilities(self) -> Sequence[Mapping[Regime, float]] | None:
        """Probability of each regime, joint by joint."""
        return None

    @property
    def slip_margins(self) -> tuple[float | None, ...]:
        """M / K of each joint."""
        return self.state.slip_margins

    @property
    def pressures(self) -> tuple[float | None, ...]:
        """P of each joint in Pa."""
        return self.state.pressures

    @property
    def tip(self) -> TipPose | None:
        """The end of the last unit, in the base's frame."""
        return self.state.tip

    @property
    def tip_covariance(self) -> NDArray[np.float64] | None:
        """Of the tip's (x, z, tilt); None where an angle is not assured."""
        if not self.known.is_assured:
            return None
        return self.state.tip_covariance(self.settings.tension_stddev)

    @property
    def tip_interval(self) -> tuple[TipPose, TipPose] | None:
        """Lower and upper ends of the intervals that hold x, z and tilt of the tip."""
        return None

    @property
    def bands(self) -> list[list[Interval]]:
        """Of each joint the angles at which friction can hold it, with the others frozen."""
        return [joint.admissible_angles for joint in self.state.joints]

    # For people

    @property
    def worst(self) -> int:
        """Index of the joint that asks for attention most: by its regime, then its margin."""
        if self.state.is_slack:
            pairs = self.state.joint_tensions
            return next((i for i, pair in enumerate(pairs) if not all(pair)), 0)
        margins = self.slip_margins
        return max(
            range(len(margins)),
            key=lambda joint: (_SEVERITY[self.regimes[joint]], abs(margins[joint] or 0.0)),
        )

    @property
    def summary(self) -> str:
        """The worst joint, its regime, and its margin where there is one."""
        worst = self.worst
        margin = self.slip_margins[worst]
        said = f'worst is {self.settings.joint_names[worst]}, {self.regimes[worst].value}'
        return said if margin is None else f'{said} at a margin of {margin:.3f}'

    @property
    def remarks(self) -> list[Remark]:
        """What is not as it should be, but for `slow_remarks`."""
        found = []
        if not self.known.is_assured:
            found.append(Remark.LOAD)
        if not all(self.angles_assured):
            found.append(Remark.UNASSURED)
        return found

    @property
    def slow_remarks(self) -> list[Remark]:
        """What else is not."""
        return [
            remark for remark in (Remark.NOISE, Remark.OTHER_ROOT) if any(self.joints_with(remark))
        ]

    def place_of(self, remark: Remark) -> str:
        """Return the names of the joints that a remark is of."""
        joints = zip(self.settings.joint_names, self.joints_with(remark), strict=True)
        return ', '.join(name for name, has_it in joints if has_it)

    def joints_with(self, remark: Remark) -> list[bool]:
        """Return which joints have a remark, as far as it is of joints."""
        joints = self.state.joints
        if remark is Remark.UNASSURED:
            return [not assured for assured in self.angles_assured]
        if remark is Remark.OTHER_ROOT:
            return [joint.branch_consistent is False for joint in joints]
        if remark is Remark.NOISE:
            stddev = self.settings.tension_stddev
            risks = [
                # The sum of the tensions of n cables is as noisy as √n of one.
                noise_risk(joint, stddev * math.sqrt(cables))
                for joint, cables in zip(joints, self._cables_a_side, strict=True)
            ]
            return [risk is not None and risk.is_unsafe for risk in risks]
        return [False] * len(joints)

    @property
    def _cables_a_side(self) -> list[int]:
        """How many cables cross each joint on the side that has the more."""
        cables = self.arm.cables
        return [
            max(sum(of.side == side and of.last_unit >= joint for of in cables) for side in 'ls')
            for joint in range(1, len(self.arm.units) + 1)
        ]

    def as_dict(self) -> dict[str, Any]:
        """Return it by name, ready for JSON; what is not known is None."""
        deviations = self.state.tip_stddev(self.settings.tension_stddev)
        return {
            'joint_names': self.settings.joint_names,
            **self.state.as_dict(),
            'angles_assured': self.angles_assured,
            'bend_angle_stddevs': self.bend_angle_stddevs,
            'tip_stddev': deviations.as_dict()
            if deviations is not None and self.known.is_assured
            else None,
        }
