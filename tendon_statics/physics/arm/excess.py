"""What drives the joints of an arm beyond what friction holds, at any angles, under one load."""

from __future__ import annotations

import cmath
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ..contact.law import LoadedLaw
from ..slip import Slip
from ..tensions import Tensions
from .arm import Arm
from .cables import AtJoints, Crossing, by_angles, pair_at, transmitted_after
from .carried import Carried
from .look import Look

Floats = NDArray[np.float64]

Law = tuple[LoadedLaw, float, float, Tensions]
"""The contact law of a joint, r T in N m, |P| / T, and the pair of tensions that they are of"""

ULPS = 2e-15
"""Share of what is added up by which a sum may be wrong, some units in the last place"""


class Excess:
    """M and K of every joint of an arm as functions of all bend angles.

    A joint that moves to a side has the velocity f = M − side K by the rule of `flow`; with the
    frozen others that is `slip`'s g.

    Parameters
    ----------
    tensions : list of float
        At the base, in N, in the arm's order.
    at_joints : list of list of float
        At the joints, where the arm is at first.
    """

    def __init__(
        self,
        arm: Arm,
        crossing: list[Crossing],
        carried: Carried,
        tensions: list[float],
        at_joints: AtJoints,
    ) -> None:
        self.arm, self.carried = arm, carried
        self._crossing, self._tensions = crossing, tensions
        self.at_joints = at_joints
        self.springs = [design.stiffness for design in arm.designs]
        self.levers = [design.cable_lever for design in arm.designs]
        self._angles: list[float] | None = None
        """Where they were that"""
        self._pairs = [pair_at(*both) for both in zip(crossing, at_joints, strict=True)]
        self._turning = self._turning_of(self._pairs)
        self.rounding = self._rounding()
        # By joint and side, as they were last.
        self._laws: dict[tuple[int, float], Law] = {}

    def _rounding(self) -> list[float]:
        """What M of each joint may be wrong by in N m, from the size of all that it is made of."""
        sizes, beyond = [], 0.0
        for joint in range(len(self.springs) - 1, -1, -1):
            beyond += abs(self.carried.turning[joint])
            pull = self.levers[joint] * sum(map(abs, self._pairs[joint]))
            spring = self.springs[joint] * self.arm.stops[joint]
            sizes.append(ULPS * (pull + beyond + spring))
        return sizes[::-1]

    def at(self, angles: list[float]) -> Look:
        """Look at bend angles in rad."""
        at_joints, pairs, turning = self._cables_at(angles)
        turns, turned = self._turned(angles)
        moments = [
            pull + dead.real - spring * angle
            for pull, dead, spring, angle in zip(
                turning, turned, self.springs, angles, strict=True
            )
        ]
        return Look(self, angles, turns, turned, moments, pairs, at_joints)

    def flow(self, angles: list[float], leaning: list[float]) -> list[float]:
        """Return θ' in N m of all joints by the rule of `flow`, at bend angles in rad.

        Parameters
        ----------
        leaning : list of float
            The side to which a joint does not move, since it is at its stop; 0 if there is none.
        """
        # Without a `Look`, which would take as long again.
        _, pairs, turning = self._cables_at(angles)
        turns, turned = self._turned(angles)
        found, laws, springs = [], self._laws, self.springs
        for joint, turn in enumerate(turns):
            moment = turning[joint] + turned[joint].real - springs[joint] * angles[joint]
            side = -1.0 if moment < 0.0 else 1.0
            velocity = 0.0
            if side != leaning[joint]:
                kept = laws.get((joint, side))
                if kept is None or kept[3] is not pairs[joint]:
                    kept = self.law(joint, side, pairs[joint])
                excess = side * moment - kept[1] * kept[0].at(turn.real, side * turn.imag)[0]
                if excess > 0.0:
                    velocity = side * excess
            found.append(velocity)
        return found

    def _cables_at(self, angles: list[float]) -> tuple[AtJoints, list[Tensions], list[float]]:
        """Return the tensions at the joints, the pair at each, and the M that they make."""
        if not self.arm.cable_friction_coefficient:
            return self.at_joints, self._pairs, self._turning
        start = self._angles or angles
        if all(new * old >= old * old for new, old in zip(angles, start, strict=True)):
            # Bands that all widen push nothing.
            return self.at_joints, self._pairs, self._turning
        at_joints = transmitted_after(self.arm, self._tensions, (start, angles), self.at_joints)
        pairs = self._pairs_of(at_joints)
        return at_joints, pairs, self._turning_of(pairs)

    def _turned(self, angles: list[float]) -> tuple[list[complex], list[complex]]:
        """Return e^{jΘ_i} of each unit and q_i, of which the dead load's moment is Re q_i."""
        turns, tilt = [], 0.0
        for angle in angles:
            tilt += angle
            turns.append(cmath.rect(1.0, tilt))
        turned, beyond = [], 0.0j
        for own, turn in zip(reversed(self.carried.turning), reversed(turns), strict=True):
            beyond += own * turn
            turned.append(beyond)
        turned.reverse()
        return turns, turned

    def remember(self, look: Look) -> None:
        """Take it that the arm has come there, as the friction of the cables remembers."""
        if self.arm.cable_friction_coefficient:
            self.at_joints, self._pairs, self._angles = look.at_joints, look.pairs, look.angles
            self._turning = self._turning_of(look.pairs)

    def _pairs_of(self, at_joints: AtJoints) -> list[Tensions]:
        return [
            pair if at is was else pair_at(crossing, at)
            for crossing, at, was, pair in zip(
                self._crossing, at_joints, self.at_joints, self._pairs, strict=True
            )
        ]

    def _turning_of(self, pairs: list[Tensions]) -> list[float]:
        """M in N m that the cables alone make at each joint."""
        return [
            (right - left) * lever for (left, right), lever in zip(pairs, self.levers, strict=True)
        ]

    def law(self, joint: int, side: float, pair: Tensions) -> Law:
        """Return the contact law of a joint for slipping to a side."""
        kept = self._laws.get((joint, side))
        if kept is None or kept[3] is not pair:
            excess = self.carried.excess(joint, pair)
            slip = Slip(self.carried.upright[joint], excess, *pair, side)
            scale = self.arm.designs[joint].ball_radius * slip.total
            self._laws[joint, side] = kept = slip.law, scale, slip.share, pair
        return kept

    def by_tensions(self, sides: dict[int, float], look: Look) -> Floats:
        """∂f/∂T in m of some joints, by their sides: a row for each, by the tension of each cable.

        By that at the joint.
        """
        held = []
        for joint, side in sides.items():
            law, _, share, _ = self.law(joint, side, look.pairs[joint])
            _, _, state = look.capacity(joint, side)
            grip = state[0] - share * law.by_share(state)
            held.append(side * self.arm.designs[joint].ball_radius * grip)
        levers = self.arm.cable_levers.take(list(sides), 0)
        found: Floats = levers - np.array(held)[:, None] * (levers != 0.0)
        return found

    def by_base_tensions(self, sides: dict[int, float], look: Look) -> Floats:
        """∂f/∂T in m of some joints, by the tension at the base of each cable.

        What friction has kept at a guide from an earlier sample is taken to be as unsure as the
        sample of now, with the same error all along.
        """
        found = self.by_tensions(sides, look)
        if self.arm.cable_friction_coefficient:
            at_base = np.array(self._tensions)
            at_joints = np.array([look.at_joints[joint] for joint in sides])
            found *= np.divide(at_joints, at_base, where=at_base > 0.0, out=np.ones_like(found))
        return found

    def jacobian(self, look: Look, sides: dict[int, float]) -> Floats:
        """∂f/∂θ in N·m/rad of some joints, by their sides: a row for each, by all joints."""
        joints = list(sides)
        farther, before = _order(len(look.angles))
        turned = np.array([one.imag for one in look.turned])
        slopes = np.array([look.capacity(joint, side)[1] for joint, side in sides.items()])
        rows: Floats = -turned.take(farther.take(joints, 0))
        rows -= slopes[:, None] * before.take(joints, 0)
        rows[range(len(joints)), joints] -= [self.springs[joint] for joint in joints]
        if self.arm.cable_friction_coefficient:
            gains = self.by_tensions(sides, look)
            by_angle = by_angles(self.arm, self._tensions, look.angles, look.at_joints)
            rows += (gains[:, None, :] @ by_angle[joints])[:, 0]
        return rows


@cache
def _order(count: int) -> tuple[NDArray[np.intp], Floats]:
    """Return the farther of two joints, and 1 where the second is not the farther; else 0."""
    joints = np.arange(count)
    return np.maximum.outer(joints, joints), np.tri(count)
