"""The members of an arm's filter: possible arms, each with errors that stay the same."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...array_numbers import ARRAYS
from ...design import JointDesign
from ...draws import draw_normals
from ...filter.ensemble import CAUTION, MEMBERS, TensionErrors
from ...load import Load
from ...loaded_joint import LoadedJoint
from ...slip import Slip
from ..arm import Arm
from ..carried import Carried
from .follow import Place, follow
from .many import Dead, Drawn, ManyArms

Floats = NDArray[np.float64]


class ArmEnsemble(TensionErrors):
    """What tells the members of an arm's filter apart: constants of each.

    As those of a unit, but for the errors of the smoothed tensions: cables that end at the same
    unit have theirs in common, to s on the one side and on the other, and so drive all joints that
    they cross the same way; cables that end elsewhere have others, in an order of their own.

    Parameters
    ----------
    arm : Arm
    bias_stddev : float
        Standard deviation of the constant error of each tension in N.
    seed : int
        Of the orders.
    """

    def __init__(self, arm: Arm, bias_stddev: float, seed: int) -> None:
        ends = sorted({cable.last_unit for cable in arm.cables}, reverse=True)
        groups, cables = len(ends), len(arm.cables)
        normals = draw_normals(MEMBERS, groups + cables + 1 + len(arm.units), seed)
        self._spreads = normals[groups + cables + 1 :]
        of_groups = CAUTION * np.vstack([np.sort(normals[:1]), normals[1:groups]])
        scores = [cable.sign * of_groups[ends.index(cable.last_unit)] for cable in arm.cables]
        biases = bias_stddev * normals[groups : groups + cables]
        super().__init__(np.array(scores), CAUTION * normals[groups + cables], biases)
        self.arms = ManyArms(arm)
        self._dead: Dead | None = None

    def dead(self, load: Load) -> Dead:
        """Return what the joints carry under a load; the last is kept, since loads seldom change.

        Raises
        ------
        LoadError
            If the force at the tip is said to act elsewhere.
        """
        if self._dead is None or self._dead.carried.load != load:
            self._dead = Dead.of(Carried(self.arms.arm, load))
        return self._dead

    def angles(self, bend_angles: Sequence[float], stddevs: Sequence[float]) -> Floats:
        """Return angles of each member in rad, spread about some, shape ``(members, joints)``."""
        columns = [
            self.angles_of(joint, *of_joint)
            for joint, of_joint in enumerate(zip(bend_angles, stddevs, strict=True))
        ]
        return np.stack(columns, axis=1)

    def angles_of(self, joint: int, bend_angle: float, stddev: float) -> Floats:
        """Return an angle of one joint of each member, by its index, within its stops."""
        stop = self.arms.stops[joint]
        found: Floats = np.clip(bend_angle + stddev * self._spreads[joint], -stop, stop)
        return found

    def follow(self, paths: Floats, loads: list[Load], start: Place) -> list[Place]:
        """Follow the members through tensions in N, shape ``(cables, samples, members)``."""
        return follow(self.arms, [self.dead(load) for load in loads], paths, start)

    def drawn(self, tensions: Floats, place: Place, load: Load) -> Drawn:
        """Return what tensions of the members at one sample do at their joints."""
        return Drawn(self.arms, self.dead(load), tensions.T, place.at_joints)


class JointSlips(NamedTuple):
    """The slip functions of one joint of the members, all their other joints being frozen."""

    ensemble: ArmEnsemble
    joint: int
    load: Load
    pairs: Floats
    """Tensions in N that pull and turn the joint, shape ``(2, members)``"""
    angles: Floats
    """Of all joints, shape ``(members, joints)``"""
    error: Floats
    """Standard errors in N of the tensions of the cables that cross it"""

    @property
    def units(self) -> JointDesign:
        """The design of the joint's unit."""
        return self.ensemble.arms.arm.designs[self.joint]

    def driving(self) -> Slip:
        """Return them at the tensions that drive the members."""
        return self._at(self.pairs)

    def driving_and_pressing(self) -> Slip:
        """Return them at those, and at the tensions that press the joints, in a row each."""
        return self._at(self.ensemble.driving_and_pressing(self.pairs, self.error))

    def _at(self, pairs: Floats) -> Slip:
        dead = self.ensemble.dead(self.load).frozen(self.joint, self.angles)
        joint = LoadedJoint.of(self.units, dead)
        left, right = pairs
        excess = left + right - joint.size
        if not joint.law.carries_more_than_cables:
            excess = np.where(excess > 0.0, excess, np.nan)
        return Slip(joint, excess, left, right, 1.0, ARRAYS)
