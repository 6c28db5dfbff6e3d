"""`ArmFilter`: where an arm is, from noisy tensions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ...filter import StickSlipFilter
from ...filter.lagged import LaggedFilter, check_least, check_stddev, drawn_to
from ...filter.recent import Sample
from ...filter.smoothing import Estimate
from ...load import UPRIGHT, Load
from ..arm import Arm
from ..cables import Crossing, pair_at, slack_joint, transmitted
from ..carried import at_tip
from ..joints import check_bend_angles, check_joint, check_joint_angle
from .answers import single_state, slack_state, state_at
from .ensemble import ArmEnsemble
from .follow import Place
from .state import ArmFilterState

Floats = NDArray[np.float64]


class ArmFilter(LaggedFilter[ArmFilterState, Place]):
    """Follows an arm as `ArmTracker` does, where each tension is noisy.

    As `StickSlipFilter` follows a unit: tensions are smoothed, slips are committed `lag` behind,
    and what remains unsure is carried by members. A member is a whole arm, so that a slip of one
    joint that loads another is seen by the other in all of them, each with errors of its own.

    An arm of one unit with a cable on either side, whose cables have no friction, is the
    `StickSlipFilter`, to the last bit.

    Parameters
    ----------
    arm : Arm
    bend_angles : sequence of float, optional
        Where the joints are at first in rad, from the base on; None: the arm is straight.
    bend_angle_stddev : float or sequence of float
        Standard deviation of that, of each joint or of all alike.
    tension_stddev : float
        Standard deviation of the noise of each tension in N, from sample to sample.
    tension_bias_stddev : float
        Standard deviation of the constant error of each tension in N.
    lag : float
        Time in s after which what was found is committed.
    seed : int
        Of what tells the members apart; the same seed gives the same results.

    Raises
    ------
    BendAngleError
        If an angle is missing, not a number, or beyond its joint's stop.
    ValueError
        If a standard deviation or the lag is not allowed.
    """

    def __init__(
        self,
        arm: Arm,
        *,
        bend_angles: Sequence[float] | None = None,
        bend_angle_stddev: float | Sequence[float] = 0.0,
        tension_stddev: float,
        tension_bias_stddev: float = 0.0,
        lag: float = 0.15,
        seed: int = 0,
    ) -> None:
        super().__init__(len(arm.cables), tension_stddev, tension_bias_stddev, lag)
        self._arm = arm
        self._ensemble = ArmEnsemble(arm, tension_bias_stddev, seed)
        self._single: StickSlipFilter | None = None
        if _is_single_unit(arm, self._ensemble.arms.crossing):
            self._single = StickSlipFilter(
                arm.designs[0],
                tension_stddev=tension_stddev,
                tension_bias_stddev=tension_bias_stddev,
                lag=lag,
                seed=seed,
            )
        straight = [0.0] * len(arm.units)
        self.reset(straight if bend_angles is None else bend_angles, bend_angle_stddev)

    @property
    def arm(self) -> Arm:
        """The arm that is followed."""
        return self._arm

    def reset(self, bend_angles: Sequence[float], stddev: float | Sequence[float] = 0.0) -> None:
        """Put all joints to angles in rad that a homing move has told, with their deviation.

        Raises
        ------
        BendAngleError
            If an angle is missing, not a number, or beyond its joint's stop.
        ValueError
            If a deviation is not allowed. The angles then stay in both cases.
        """
        angles = check_bend_angles(self._arm, bend_angles)
        stddevs = _deviations(stddev, len(angles))
        self._assured = [True] * len(angles)
        self._committed = self._newest = Place(self._ensemble.angles(angles, stddevs))
        self._begin_history()
        if self._single:
            self._single.reset(angles[0], stddevs[0])

    def doubt(self) -> None:
        """Take it that the arm may have moved unseen, say while no tensions came.

        The angles stay, but none is assured until a stop, a measurement or a reset tells it.
        """
        self._committed = self._newest
        self._assured = [False] * len(self._assured)
        self._forget_samples()
        if self._single:
            self._single.doubt()

    def update(
        self, tensions: Mapping[str, float], time: float, load: Load = UPRIGHT
    ) -> ArmFilterState:
        """Take the tensions of all cables; return where the arm is then, provisionally.

        Parameters
        ----------
        tensions : mapping
            Tension in N of each cable by its name, at the base.
        time : float
            When they were measured, in s; later than those before.
        load : Load
            On the base, as `ArmTracker.update` takes it.

        Raises
        ------
        TensionError, LoadError
            As `ArmTracker.update` does.
        ValueError
            If the time is not later than that before. What was known stays in all cases.
        """
        arm = self._arm
        at_base = arm.check_tensions(tensions)
        dead = self._ensemble.dead(load)
        crossing = self._ensemble.arms.crossing
        if self._single:
            state = self._single.update(*pair_at(crossing[0], at_base), time, at_tip(arm, load))
            return single_state(arm, state)
        self._check_time(time)
        if slack_joint(crossing, [at_base] * len(crossing)) is not None:
            self.doubt()
            self._committed = self._newest = Place(self._newest.angles)
            return slack_state(arm, crossing, at_base, time, load)
        medians = np.median(self._newest.angles, axis=0).tolist()
        at_joints = transmitted(arm, at_base, medians, None)
        for joint, both in enumerate(zip(crossing, at_joints, strict=True)):
            dead.carried.excess(joint, pair_at(*both))
        return self._take(at_base, Sample(time, load))

    def _followed(
        self, estimate: Estimate, loads: list[Load], start: Place
    ) -> tuple[Floats, list[Place]]:
        paths = self._ensemble.tensions(estimate)
        return paths, self._ensemble.follow(paths, loads, start)

    def _state(
        self,
        sample: Sample,
        tensions: Sequence[float],
        path: Sequence[Place],
        member_tensions: Floats,
        tension_errors: Floats,
        *,
        provisional: bool,
    ) -> ArmFilterState:
        return state_at(
            *(self._ensemble, sample, tensions, path, member_tensions, tension_errors),
            provisional=provisional,
            assured=self._assured,
        )

    def _take_for_sure(self, state: ArmFilterState) -> None:
        for index, joint in enumerate(state.joints):
            if not self._assured[index] and joint.is_told_by_stop:
                self._assured[index] = joint.assured = True

    def measure(self, joint: int, bend_angle: float, stddev: float) -> None:
        """Take what an encoder or a camera says of one joint at the newest sample.

        The other joints stay where they are, and so does what the friction of cables remembers.

        Parameters
        ----------
        joint : int
            Counted from 1 at the base.
        bend_angle, stddev : float
            In rad; the deviation above 0.

        Raises
        ------
        ArmError
            If the arm has no such joint.
        BendAngleError
            If the angle is not a number or lies beyond the stop.
        ValueError
            If the deviation is not a number above 0.
        """
        index = check_joint(self._arm, joint)
        angle = check_joint_angle(self._arm, joint, bend_angle)
        check_stddev(stddev)
        if self._single:
            self._single.measure(angle, stddev)
            return
        angles = self._newest.angles.copy()
        angles[:, index] = drawn_to(
            self._ensemble.angles_of(index, angle, stddev),
            *(angles[:, index], angle, stddev),
            assured=self._assured[index],
        )
        self._assured[index] = True
        if self._put(self._newest._replace(angles=angles)) is not None:
            found = self._last.measured(angles, self._assured)
            if self._history and self._history[-1].time == found.time:  # another joint was too
                self._history.pop()
            self._history.append(found)

    @property
    def committed(self) -> ArmFilterState | None:
        """The newest state that will not be taken back; None before there is one."""
        if self._single:
            found = self._single.committed
            return None if found is None else single_state(self._arm, found)
        return super().committed

    def history(self, time: float) -> ArmFilterState | None:
        """Return the newest committed state that is not after a time in s, if it is kept."""
        if self._single:
            found = self._single.history(time)
            return None if found is None else single_state(self._arm, found)
        return super().history(time)


def _is_single_unit(arm: Arm, crossing: list[Crossing]) -> bool:
    """Whether an arm is a unit with a cable on either side, as a `StickSlipFilter` has it."""
    return (
        (len(arm.units), len(arm.cables)) == (1, 2)
        and arm.cable_friction_coefficient == 0.0
        and not crossing[0].leverage
    )


def _deviations(stddev: float | Sequence[float], count: int) -> list[float]:
    """Return the standard deviations of the angles of so many joints.

    Raises
    ------
    ValueError
        If there are not as many, or one is negative or no number.
    """
    found = [stddev] * count if isinstance(stddev, (int, float)) else list(stddev)
    if len(found) != count:
        raise ValueError(
            f'there are {len(found)} standard deviations of bend angles, but {count} joints; '
            'one for all joints or one for each is needed'
        )
    for value in found:
        check_least('bend_angle_stddev', value, 0.0)
    return found
