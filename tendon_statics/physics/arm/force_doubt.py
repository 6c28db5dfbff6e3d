"""What noisy measurements of an arm say against forces at its tip.

Each joint speaks against a force as a single unit does; see `force_scores`. Its slip function also
hangs on the angles of all other joints: those before it turn its dead load, those beyond it shift
what they carry.

A force is doubtful as far as the joint is that it is most doubtful to. But where several joints
are as near to slipping, each of them may be misread, and one of m readings is beyond its share Φ
more often than one alone. So of a doubt P of one of them that of the arm is P^m (Šidák 1967):
exact if the joints' errors are independent, cautious if they have cables in common.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ..force_scores import NORMAL, STEP, Doubt, ForceScores, Noise, score
from ..gradients import slip_by_tensions
from ..load import DeadLoad, Load
from ..pushed_unit import PushedUnit
from .arm import Arm
from .cables import AtJoints, Crossing
from .carried import frozen_loads

NEAR = -2.0
"""Score of a joint from which on it counts among those that may be at their limit"""


class JointScores(ForceScores):
    """What noisy measurements of an arm say of one joint, by its index, against forces.

    Parameters
    ----------
    units : list of PushedUnit
        All joints, each with the others frozen.
    dead, push : list of DeadLoad
        What each unit carries, and what a newton at the tip adds to it, in the base's frame.
    gains : sequence of (float, float)
        By how much the pair of the joint's tensions grows with the tension of each cable that
        crosses it.
    """

    def __init__(
        self,
        units: list[PushedUnit],
        index: int,
        dead: list[DeadLoad],
        push: list[DeadLoad],
        gains: Sequence[tuple[float, float]],
        load: Load,
        noise: Noise,
    ) -> None:
        super().__init__(units[index], load, noise)
        self._gains, self._before = gains, index
        angles = [unit.bend_angle for unit in units]

        def moments(joint: int, step: float) -> tuple[float, float, PushedUnit]:
            """M of dead load and push with another joint turned on, and all of it."""
            turned = [*angles[:joint], angles[joint] + step, *angles[joint + 1 :]]
            of_dead, of_push = (frozen_loads(loads, turned)[index] for loads in (dead, push))
            unit = units[index]._replace(dead=of_dead, push=of_push)
            angle = unit.bend_angle
            cosine, sine = math.cos(angle), math.sin(angle)
            return (
                cosine * of_dead.moment_x - sine * of_dead.moment_z,
                cosine * of_push.moment_x - sine * of_push.moment_z,
                unit,
            )

        self._turned = moments(0, STEP)[2] if index else None
        """The joint with those before it turned on, one as good as the other"""
        self._by_beyond = []
        """∂M/∂θ of each joint beyond it in N m/rad, of the dead load and of each newton"""
        if noise.bend_angle_stddev:
            for joint in range(index + 1, len(units)):
                low, high = moments(joint, -STEP), moments(joint, STEP)
                self._by_beyond.append(
                    ((high[0] - low[0]) / (2.0 * STEP), (high[1] - low[1]) / (2.0 * STEP))
                )

    def towards(self, force: float, side: float) -> float:
        """Return g / σ_g under a force in N, for slipping to a side, 1 or −1."""
        unit, noise = self._seated(force), self._noise
        slip, ahead = unit.slip(force).facing(side), side * unit.bend_angle
        point = slip.at(ahead)
        by_pair = slip_by_tensions(slip, point, unit.design.relative_lever)[:: int(side)]
        variance = noise.tension_stddev**2 * sum(
            (by_pair[0] * left + by_pair[1] * right) ** 2 for left, right in self._gains
        )
        variance += noise.bend_angle_stddev**2 * (
            point.slope**2 + self._of_other_angles(unit, force, side, float(point.excess))
        )
        return score(float(point.excess), variance)

    def _of_other_angles(
        self, unit: PushedUnit, force: float, side: float, excess: float
    ) -> float:
        """Return the sum of (∂g/∂θ)² over all other joints."""
        scale = unit.design.ball_radius * unit.total
        found = sum(((one + force * by) / scale) ** 2 for one, by in self._by_beyond)
        if self._turned is not None:
            turned = self._turned._replace(tensions=unit.tensions)
            found += self._before * ((turned.excess(force, side) - excess) / STEP) ** 2
        return found

    def lift(self, force: float) -> float:
        """Return by how many deviations the tensions fall short of seating the joint."""
        unit, noise = self._unit, self._noise
        lift = unit.lift(force)
        variance = noise.tension_stddev**2 * sum((one + other) ** 2 for one, other in self._gains)
        if noise.bend_angle_stddev:
            turned = unit._replace(bend_angle=unit.bend_angle + STEP)
            by_angle = (turned.lift(force) - lift) / STEP
            variance += (self._before + 1) * (noise.bend_angle_stddev * by_angle) ** 2
        return score(lift, variance)


class ArmDoubt(NamedTuple):
    """How much speaks against a force at the tip of an arm, by what holds each of its joints."""

    of_joints: list[Doubt]

    def bounds(self, force: float) -> tuple[float, float]:
        """Return x and y of the doubt Φ(x) − Φ(y) of the joint to which it is most doubtful."""
        return max(doubt.bounds(force) for doubt in self.of_joints)

    def beyond(self, force: float, level: float) -> float:
        """Return by how much the doubt, as a score, is beyond that of a level."""
        bounds = [doubt.bounds(force) for doubt in self.of_joints]
        near = max(1, sum(most > NEAR for most, _ in bounds))
        most, least = max(bounds)
        doubt = min(max(NORMAL.cdf(most) - NORMAL.cdf(least), 1e-300), 1.0 - 1e-16)
        return NORMAL.inv_cdf(doubt) - NORMAL.inv_cdf(level ** (1.0 / near))

    def probability(self, force: float) -> float:
        """Return the probability that the sets of all joints have a force, as if independent."""
        return math.prod(doubt.probability(force) for doubt in self.of_joints)

    def bounding(self, force: float) -> int | None:
        """Return the joint, counted from 1, that bounds the set there; None for infinity."""
        if math.isinf(force):
            return None
        return (
            max(range(len(self.of_joints)), key=lambda index: self.of_joints[index].bounds(force))
            + 1
        )


def gains_at(
    arm: Arm, crossing: Crossing, at_joints: AtJoints, joint: int
) -> list[tuple[float, float]]:
    """Return by how much the pair of a joint grows with the tension of each cable, as measured.

    What friction has changed up to the joint is taken to be as unsure as at the first joint, in
    proportion.
    """
    levers = dict(crossing.leverage)
    found = []
    for index in crossing.left + crossing.right:
        lever = levers.get(index, arm.cables[index].sign)
        before = at_joints[0][index]
        kept = at_joints[joint][index] / before if before else 1.0
        found.append((0.5 * kept * (1.0 - lever), 0.5 * kept * (1.0 + lever)))
    return found
