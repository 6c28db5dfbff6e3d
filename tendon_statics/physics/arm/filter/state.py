"""Where a filter says that an arm is: as many possible arms, of equal weight."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...admissible import Interval, angles_held
from ...errors import TensionError
from ...filter.state import FilterState, interval_of
from ...load import Load
from ...regime import Regime
from ...tensions import Tensions
from ..arm import Arm
from ..carried import Carried
from ..joints import Driven, drive
from ..shape import TipPose, tip_poses
from .ensemble import JointSlips

Floats = NDArray[np.float64]


class ArmFilterState:
    """Where an arm is under noise, from the base on. What is not determined is None.

    Attributes
    ----------
    arm : Arm
    load : Load
    time : float
        Of the tensions, in s.
    tensions : dict
        Of each cable by name in N, at the base: as given, or smoothed for a committed state.
    joints : tuple of FilterState
        Each joint as a single unit that carries all beyond it. Its `load` is the arm's, and its
        tensions are the pair that pulls and turns the joint as the cables that cross it do.
    cable_tensions : dict
        Of each cable by name in N, at each joint that it crosses, beyond the joint's guides.
    members : ndarray
        Angles of the possible arms in rad, one arm a row, one joint a column; of shape
        ``(0, joints)`` while the arm is slack.
    provisional : bool
        Whether it may be taken back when more samples have come.
    """

    def __init__(
        self,
        arm: Arm,
        load: Load,
        time: float,
        tensions: dict[str, float],
        *,
        joints: tuple[FilterState, ...],
        cable_tensions: dict[str, tuple[float, ...]],
        members: Floats,
        provisional: bool,
    ) -> None:
        self.arm = arm
        self.load = load
        self.time = time
        self.tensions = tensions
        self.joints = joints
        self.cable_tensions = cable_tensions
        self.members = members
        self.provisional = provisional

    def measured(self, members: Floats, assured: Sequence[bool]) -> ArmFilterState:
        """The same with the angles of the members that a measurement has told, to be kept."""
        joints = []
        for index, joint in enumerate(self.joints):
            slips = joint.slips
            assert isinstance(slips, JointSlips)
            slips = slips._replace(angles=members)
            joints.append(joint.measured(members[:, index], slips, assured=assured[index]))
        return ArmFilterState(
            *(self.arm, self.load, self.time, self.tensions),
            joints=tuple(joints),
            cable_tensions=self.cable_tensions,
            members=members,
            provisional=False,
        )

    @property
    def is_slack(self) -> bool:
        """Whether some joint has no tension on one side; nothing is then said of any joint."""
        return not len(self.members)

    @property
    def bend_angles(self) -> tuple[float, ...] | None:
        """Median of each bend angle in rad; None while the arm is slack."""
        if self.is_slack:
            return None
        return tuple([joint.bend_angle for joint in self.joints])  # type: ignore[misc]

    @property
    def bend_angle_stddevs(self) -> tuple[float | None, ...]:
        """Standard deviation of each bend angle in rad; None where it is not assured."""
        return tuple(joint.bend_angle_stddev for joint in self.joints)

    def intervals(self, level: float = 0.95) -> tuple[tuple[float, float] | None, ...]:
        """Return the interval in rad that holds each bend angle with a probability.

        Raises
        ------
        ValueError
            If the level is not between 0 and 1.
        """
        return tuple(joint.interval(level) for joint in self.joints)

    @property
    def regimes(self) -> tuple[Regime, ...]:
        """The most probable regime of each joint."""
        return tuple(joint.regime for joint in self.joints)

    @property
    def regime_probabilities(self) -> tuple[dict[Regime, float], ...]:
        """Of each joint, the probability of each regime."""
        return tuple(joint.regime_probabilities for joint in self.joints)

    @property
    def pressures(self) -> tuple[float | None, ...]:
        """Median of the pressure of each joint in Pa."""
        return tuple(joint.pressure for joint in self.joints)

    @property
    def pressure_stddevs(self) -> tuple[float | None, ...]:
        """Standard deviation of the pressure of each joint in Pa."""
        return tuple(joint.pressure_stddev for joint in self.joints)

    @property
    def angles_assured(self) -> tuple[bool, ...]:
        """False for a joint that may have moved unseen, until a stop or a measurement tells it."""
        return tuple(joint.angle_assured for joint in self.joints)

    @cached_property
    def slip_margins(self) -> tuple[float | None, ...]:
        """M / K of each joint at the medians of the angles, under these tensions, noise and all.

        None while the arm is slack, and where smoothed tensions do not seat all joints.
        """
        if self._driven is None:
            return (None,) * len(self.joints)
        return tuple(slip.margin_at(probe) for slip, probe in self._driven)

    @property
    def admissible_angles(self) -> list[list[Interval]]:
        """Of each joint the intervals in rad in which friction can hold it, the others frozen.

        Likewise; none where there is no margin.
        """
        if self._driven is None:
            return [[] for _ in self.joints]
        towards_s = (slip if slip.side > 0.0 else slip.mirrored() for slip, _ in self._driven)
        return [angles_held(*both) for both in zip(towards_s, self.arm.stops, strict=True)]

    @cached_property
    def _driven(self) -> list[Driven] | None:
        """Each joint as a single one, at the medians of all; None if they are not seated."""
        angles = self.bend_angles
        if angles is None:
            return None
        carried = Carried(self.arm, self.load)
        pairs = [Tensions(joint.tension_l, joint.tension_s) for joint in self.joints]
        frozen = carried.frozen(list(angles))
        try:
            return drive(carried, frozen, list(angles), pairs, [1.0] * len(angles))
        except TensionError:
            return None

    @cached_property
    def _tips(self) -> Floats:
        """Of each member, shape ``(3, members)``: x and z in m and the tilt in rad."""
        return tip_poses(self.arm, self.members)

    @property
    def tip(self) -> TipPose | None:
        """Medians of the pose of the end of the last unit, in the base's frame."""
        return None if self.is_slack else TipPose(*np.median(self._tips, axis=1).tolist())

    @property
    def tip_covariance(self) -> Floats | None:
        """Covariance of x and z in m and the tilt in rad; None where a joint is not assured."""
        if self.is_slack or not all(self.angles_assured):
            return None
        return np.cov(self._tips, bias=True)

    @property
    def tip_stddev(self) -> TipPose | None:
        """Standard deviations of the tip's pose."""
        covariance = self.tip_covariance
        if covariance is None:
            return None
        return TipPose(*(math.sqrt(max(value, 0.0)) for value in covariance.diagonal().tolist()))

    def tip_interval(self, level: float = 0.95) -> tuple[TipPose, TipPose] | None:
        """Return the intervals of x, z and tilt, each by itself, as their lower and upper ends.

        Raises
        ------
        ValueError
            If the level is not between 0 and 1.
        """
        ends = [interval_of(np.sort(values), level) for values in self._tips]
        if None in ends:
            return None
        lower, upper = zip(*ends, strict=True)
        return TipPose(*lower), TipPose(*upper)

    @property
    def joint_tensions(self) -> tuple[tuple[float, float], ...]:
        """Sums of the tensions at each joint in N: of cables l, of cables s."""
        sums = [[0.0, 0.0] for _ in self.joints]
        for cable in self.arm.cables:
            for number, tension in enumerate(self.cable_tensions[cable.name]):
                sums[number][cable.side == 's'] += tension
        return tuple((left, right) for left, right in sums)

    def as_dict(self) -> dict[str, Any]:
        """Return all but arm and load by name, ready for JSON."""
        tip, stddev = self.tip, self.tip_stddev
        return {
            'time': self.time,
            'provisional': self.provisional,
            'tensions': self.tensions,
            'bend_angles': self.bend_angles,
            'bend_angle_stddevs': self.bend_angle_stddevs,
            'intervals': self.intervals(),
            'regimes': [regime.value for regime in self.regimes],
            'regime_probabilities': [
                {regime.value: share for regime, share in found.items()}
                for found in self.regime_probabilities
            ],
            'slip_margins': self.slip_margins,
            'pressures': self.pressures,
            'pressure_stddevs': self.pressure_stddevs,
            'angles_assured': self.angles_assured,
            'joint_tensions': self.joint_tensions,
            'cable_tensions': self.cable_tensions,
            'tip': tip and tip.as_dict(),
            'tip_stddev': stddev and stddev.as_dict(),
        }
