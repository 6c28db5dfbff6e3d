"""Stick and slip of an arm with memory: where its joints are, from where they were."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..load import UPRIGHT, Load
from ..loaded_joint import LoadedJoint
from ..regime import Regime
from ..state import Equilibrium
from ..tensions import Tensions
from ..tracker import StickSlipTracker
from .arm import Arm
from .cables import AtJoints, crossings, pair_at, slack_joint, transmitted
from .carried import Carried
from .excess import Excess
from .flow import settle
from .joints import Driven, check_bend_angles, check_joint, check_joint_angle, drive
from .spread import spread_after
from .state import ArmState

LIMIT = 1.0 + 1e-12
"""Margin up to which a joint is taken for held, as by `StickSlipTracker`"""


class ArmTracker:
    """Follows an arm through a sequence of tensions, with exact set-valued Coulomb friction.

    A joint stays where it is, to the last bit, for as long as friction can hold it there. Where it
    cannot, the arm slips until all joints are at rest again, each with |M| ≤ K or against its
    stop: joints beyond their limit move at once, each in proportion to its |M| − K, as with an
    equal viscosity in all that is taken to zero; see `flow`. Tensions and load are taken to jump
    from one update to the next. There is no smoothing and no time step.

    An arm of one unit, whose cables have no friction, is the `StickSlipTracker`, to the last bit;
    as that does, it also looks at the tensions in between where the last alone may mislead.

    Parameters
    ----------
    arm : Arm
    bend_angles : sequence of float, optional
        Where the joints are at first in rad, from the base on; None: the arm is straight.

    Raises
    ------
    BendAngleError
        If an angle is missing, not a number, or beyond its joint's stop.
    """

    def __init__(self, arm: Arm, bend_angles: Sequence[float] | None = None) -> None:
        self._arm, self._crossing = arm, crossings(arm)
        self._carried: Carried | None = None
        self._single = None
        if len(arm.units) == 1 and arm.cable_friction_coefficient == 0.0:
            self._single = StickSlipTracker(arm.designs[0])
        self.reset([0.0] * len(arm.units) if bend_angles is None else bend_angles)

    @property
    def arm(self) -> Arm:
        """The arm that is followed."""
        return self._arm

    @property
    def bend_angles(self) -> tuple[float, ...]:
        """Where the joints were last, in rad."""
        return tuple(self._angles)

    def copy(self) -> ArmTracker:
        """Return a tracker that goes on from here on its own, say to try what would be."""
        other = copy.copy(self)  # nothing that it holds is changed in place, but for this
        other._single = copy.copy(self._single)
        return other

    def reset(self, bend_angles: Sequence[float]) -> None:
        """Put all joints to angles in rad, and forget how the cables' friction was used.

        Raises
        ------
        BendAngleError
            If an angle is missing, not a number, or beyond its joint's stop; nothing then changes.
        """
        self._angles = check_bend_angles(self._arm, bend_angles)
        count = len(self._angles)
        self._assured = [True] * count
        self._covariance: NDArray[np.float64] = np.zeros((count, count))
        self._at_joints: AtJoints | None = None
        self._frozen: list[LoadedJoint] | None = None
        self._sides = [1.0] * count
        if self._single:
            self._single.reset(self._angles[0])

    def measure(self, joint: int, bend_angle: float) -> None:
        """Put one joint, counted from 1 at the base, to an angle in rad that an encoder told.

        Raises
        ------
        ArmError
            If the arm has no such joint.
        BendAngleError
            If the angle is not a number or beyond the stop; nothing then changes.
        """
        index = check_joint(self._arm, joint)
        angle = check_joint_angle(self._arm, joint, bend_angle)
        self._angles = [*self._angles[:index], angle, *self._angles[index + 1 :]]
        self._be_sure_of(index)
        self._frozen = None
        if self._single:
            self._single.reset(bend_angle)

    def doubt(self) -> None:
        """Take it that the arm may have moved unseen, say while no tensions came.

        The angles stay, but none is assured until a stop, a measurement or a reset tells it.
        """
        self._assured = [False] * len(self._angles)
        self._covariance = np.full(self._covariance.shape, math.nan)
        if self._single:
            self._single.doubt()

    def update(self, tensions: Mapping[str, float], load: Load = UPRIGHT) -> ArmState:
        """Take the tensions of all cables, and what acts beside them; return where the arm is.

        Parameters
        ----------
        tensions : mapping
            Tension in N of each cable by its name, at the base.
        load : Load
            On the base: gravity's direction and the force at the end of the last unit, both in the
            base's frame. Its `tip_distance` is left out, or that unit's length.

        Raises
        ------
        TensionError, LoadError
            As `arm_margins` does, but for slack joints; the arm then stays as it was.
        ArmError
            If the numbers are so out of proportion that the arm is not followed to rest; likewise.
        """
        at_base = self._arm.check_tensions(tensions)
        at_joints = transmitted(self._arm, at_base, self._angles, self._at_joints)
        if slack_joint(self._crossing, at_joints) is not None:
            return self._slack(at_base, load)
        carried, frozen = self._carried, self._frozen
        if carried is None or carried.load is not load:
            carried, frozen = Carried(self._arm, load), None
        if frozen is None:
            frozen = carried.frozen(self._angles)
        pairs = [pair_at(*both) for both in zip(self._crossing, at_joints, strict=True)]
        driven = drive(carried, frozen, self._angles, pairs, self._sides)
        if self._single:
            self._carried, self._frozen = carried, frozen
            return self._single_update(at_base, pairs[0], load)
        beyond = [
            joint
            for joint, (slip, probe) in enumerate(driven)
            if not -LIMIT <= slip.margin_at(probe) <= LIMIT
        ]
        moved: set[int] = set()
        if not all(self._leans_on_stop(joint, driven[joint]) for joint in beyond):
            excess = Excess(self._arm, self._crossing, carried, at_base, at_joints)
            settled = settle(excess, self._angles)
            at_joints, pairs = settled.look.at_joints, settled.look.pairs
            moved = settled.moved
            self._covariance = spread_after(excess, settled, self._covariance)
            self._angles = settled.look.angles
            frozen = carried.frozen(self._angles)
            driven = drive(carried, frozen, self._angles, pairs, self._sides)
        regimes = self._regimes(driven, moved)
        self._carried, self._frozen, self._at_joints = carried, frozen, at_joints
        self._sides = [slip.side for slip, _ in driven]
        return self._state(load, at_base, at_joints, self._joints(load, pairs, driven, regimes))

    def _leans_on_stop(self, joint: int, driven: Driven) -> bool:
        """Whether a joint is at the stop to which it is driven."""
        side: float = driven[0].side
        return side * self._angles[joint] == self._arm.stops[joint]

    def _regimes(self, driven: list[Driven], moved: set[int]) -> list[Regime]:
        """What has become of each joint; one that is pressed on its stop is there for sure."""
        found = []
        for joint, (slip, probe) in enumerate(driven):
            is_beyond = abs(slip.margin_at(probe)) > LIMIT
            if is_beyond and self._leans_on_stop(joint, driven[joint]):
                found.append(Regime.DRIVEN_TO_STOP)
                if not self._assured[joint]:
                    self._be_sure_of(joint)
            else:
                found.append(Regime.SLIPPING if joint in moved else Regime.HELD)
        return found

    def _be_sure_of(self, joint: int) -> None:
        self._assured = [*self._assured[:joint], True, *self._assured[joint + 1 :]]
        covariance = self._covariance.copy()  # the states that have it keep theirs
        covariance[joint, :] = covariance[:, joint] = 0.0
        self._covariance = covariance

    def _joints(
        self, load: Load, pairs: list[Tensions], driven: list[Driven], regimes: list[Regime]
    ) -> tuple[Equilibrium, ...]:
        found = []
        for index, (slip, probe) in enumerate(driven):
            fields = (
                *(self._arm.designs[index], load, regimes[index], *pairs[index]),
                *(self._angles[index], None, None, self._assured[index], None),
            )
            found.append(Equilibrium.of(slip, probe, fields))
        return tuple(found)

    def _state(
        self,
        load: Load,
        at_base: list[float],
        at_joints: AtJoints,
        joints: tuple[Equilibrium, ...],
    ) -> ArmState:
        arm = self._arm
        cables = {
            cable.name: tuple([at[index] for at in at_joints[: cable.last_unit]])
            for index, cable in enumerate(arm.cables)
        }
        by_name = dict(zip(arm.cable_names, at_base, strict=True))
        return ArmState(arm, load, by_name, joints, cables, self._covariance)

    def _slack(self, at_base: list[float], load: Load) -> ArmState:
        """Say nothing of an arm of which some joint is loose: the others carry it."""
        self.doubt()
        at_joints = transmitted(self._arm, at_base, self._angles, None)
        self._at_joints = None
        pairs = [pair_at(*both) for both in zip(self._crossing, at_joints, strict=True)]
        joints = tuple(
            Equilibrium(design, load, Regime.SLACK, *pair, angle_assured=False)
            for design, pair in zip(self._arm.designs, pairs, strict=True)
        )
        return self._state(load, at_base, at_joints, joints)

    def _single_update(self, at_base: list[float], pair: Tensions, load: Load) -> ArmState:
        assert self._single
        length = self._arm.units[0].length
        if load.tip_distance != length and any(load.tip_force):
            load = Load(load.gravity_direction, load.tip_force, length)
        found = self._single.update(*pair, load)
        assert found.bend_angle is not None
        if found.bend_angle != self._angles[0]:
            self._angles, self._frozen = [found.bend_angle], None
        by_l, by_s = found.bend_angle_gradient or (math.nan, math.nan)
        left, _, leverage = self._crossing[0]
        levers = [-1.0 if index in left else 1.0 for index in range(len(at_base))]
        for index, lever in leverage:
            levers[index] = lever
        by_cable = [0.5 * (by_l * (1.0 - lever) + by_s * (1.0 + lever)) for lever in levers]
        self._assured = [found.angle_assured]
        self._covariance = np.array([[sum(gradient**2 for gradient in by_cable)]])
        return self._state(load, at_base, [at_base], (found,))
