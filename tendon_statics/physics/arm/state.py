"""What the model says of an arm under the tensions of its cables."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..load import Load
from ..regime import Regime
from ..state import Equilibrium
from .arm import Arm
from .shape import TipPose, tip_by_angles, tip_pose


@dataclass(frozen=True, eq=False)
class ArmState:
    """The answer of an `ArmTracker`, from the base on; None is what is not determined.

    Attributes
    ----------
    tensions : dict
        Of each cable by name in N, at the base, as given.
    joints : tuple of Equilibrium
        Each joint as a single unit that carries all beyond it: regime, angle, margin, pressure,
        forces. Its `load` is the arm's, and its tensions are the pair that pulls and turns the
        joint as the cables that cross it do: the sums of the two sides, if these have the same
        lever.
    cable_tensions : dict
        Of each cable by name in N, at each joint that it crosses, beyond the joint's guides.
    """

    arm: Arm
    load: Load
    tensions: dict[str, float]
    joints: tuple[Equilibrium, ...]
    cable_tensions: dict[str, tuple[float, ...]]
    _covariance: NDArray[np.float64] = field(repr=False)

    @property
    def is_slack(self) -> bool:
        """Whether some joint has no tension on one side; nothing is then said of any joint."""
        return self.joints[0].regime is Regime.SLACK

    @property
    def bend_angles(self) -> tuple[float, ...] | None:
        """θ of each joint in rad; None while the arm is slack."""
        if self.is_slack:
            return None
        return tuple([joint.bend_angle for joint in self.joints])  # type: ignore[misc]

    @property
    def regimes(self) -> tuple[Regime, ...]:
        """Of each joint: held, slipping (it has just slipped), driven to its stop, or slack."""
        return tuple(joint.regime for joint in self.joints)

    @property
    def slip_margins(self) -> tuple[float | None, ...]:
        """M / K of each joint; beyond ±1 only against its stop."""
        return tuple(joint.slip_margin for joint in self.joints)

    @property
    def pressures(self) -> tuple[float | None, ...]:
        """P of each joint in Pa; None where the contact law does not vouch for it."""
        return tuple(joint.pressure for joint in self.joints)

    @property
    def angles_assured(self) -> tuple[bool, ...]:
        """False for a joint that may have moved unseen, until a stop or a measurement tells it."""
        return tuple(joint.angle_assured for joint in self.joints)

    @property
    def joint_tensions(self) -> tuple[tuple[float, float], ...]:
        """Sums of the tensions at each joint in N: of cables l, of cables s."""
        sums = [[0.0, 0.0] for _ in self.joints]
        for cable in self.arm.cables:
            for number, tension in enumerate(self.cable_tensions[cable.name]):
                sums[number][cable.side == 's'] += tension
        return tuple((left, right) for left, right in sums)

    @property
    def tip(self) -> TipPose | None:
        """The end of the last unit, in the base's frame; None while the arm is slack."""
        angles = self.bend_angles
        return None if angles is None else tip_pose(self.arm, angles)

    def bend_angle_stddevs(self, tension_stddev: float) -> tuple[float | None, ...]:
        """Return the standard deviation of each angle in rad, to first order, None if not known.

        Parameters
        ----------
        tension_stddev : float
            Standard deviation of each tension in N, all independent.
        """
        if self.is_slack:
            return (None,) * len(self.joints)
        return tuple(
            _deviation(variance, tension_stddev) for variance in self._covariance.diagonal()
        )

    def tip_stddev(self, tension_stddev: float) -> TipPose | None:
        """Return the standard deviations of the tip's pose in the same way."""
        covariance = self.tip_covariance(tension_stddev)
        if covariance is None:
            return None
        return TipPose(*(math.sqrt(max(float(of), 0.0)) for of in covariance.diagonal()))

    def tip_covariance(self, tension_stddev: float) -> NDArray[np.float64] | None:
        """Return the covariance of the tip's (x, z, tilt) in m, m and rad in the same way."""
        angles = self.bend_angles
        if angles is None:
            return None
        by_angle = np.array(tip_by_angles(self.arm, angles))
        found: NDArray[np.float64] = (
            tension_stddev * tension_stddev * (by_angle.T @ self._covariance @ by_angle)
        )
        return None if np.isnan(found).any() else found

    def as_dict(self) -> dict[str, Any]:
        """Return all but arm and load by name, ready for JSON."""
        tip = self.tip
        return {
            'tensions': self.tensions,
            'bend_angles': self.bend_angles,
            'regimes': [regime.value for regime in self.regimes],
            'slip_margins': self.slip_margins,
            'pressures': self.pressures,
            'angles_assured': self.angles_assured,
            'joint_tensions': self.joint_tensions,
            'cable_tensions': self.cable_tensions,
            'tip': tip and tip.as_dict(),
        }


def _deviation(variance: float, tension_stddev: float) -> float | None:
    if math.isnan(variance):
        return None
    return tension_stddev * math.sqrt(max(float(variance), 0.0))
