"""What noisy measurements of an arm say against forces at its tip.

Each joint speaks against a force as a single unit does; see `force_scores`. Its slip function also
hangs on the angles of all other joints and on the weights of the units beyond: they change its
dead load.

A force is doubtful as far as the joint is that it is most doubtful to. But where several joints
are as near to slipping, each of them may be misread, and one of m readings is beyond its share Φ
more often than one alone. So of a doubt P of one of them that of the arm is P^m (Šidák 1967):
exact if the joints' errors are independent, cautious if they have cables in common.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import NamedTuple

from ..design_uncertainty import DesignUncertainty
from ..force_ends import STEP
from ..force_scores import NORMAL, Doubt, ForceScores, Noise, as_score
from ..gradients import slip_by_load, slip_by_tensions
from ..load import DeadLoad
from ..slip import Slip, SlipPoint
from .arm import Arm
from .cables import AtJoints, Crossing, crossings
from .pushed_arm import NOTHING, LoadChange, PushedArm

NEAR = -2.0
"""Score of a joint from which on it counts among those that may be at their limit"""


class ArmNoise(NamedTuple):
    """How well the state of an arm is known."""

    tension_stddev: float
    """N, of each cable's tension, all independent"""
    bend_angle_stddevs: Sequence[float]
    """rad, of each joint's angle, all independent"""
    designs: Sequence[DesignUncertainty | None]
    """Of each unit, all independent"""

    def of_joint(self, index: int) -> Noise:
        """What of it is a joint's own."""
        return Noise(self.tension_stddev, self.bend_angle_stddevs[index], self.designs[index])

    @property
    def is_none(self) -> bool:
        """Whether all is exact."""
        return all(self.of_joint(index).is_none for index in range(len(self.designs)))


class JointScores(ForceScores):
    """What noisy measurements of an arm say of one joint against forces.

    Parameters
    ----------
    index : int
        Of the joint.
    by_angle : list of list of LoadChange
        Of each angle, how it changes the loads of the joints; see `PushedArm.by_angle`.
    gains : sequence of (float, float)
        By how much the pair of the joint's tensions grows with the tension of each cable that
        crosses it.
    """

    def __init__(
        self,
        pushed: PushedArm,
        index: int,
        noise: ArmNoise,
        by_angle: list[list[LoadChange]],
        gains: Sequence[tuple[float, float]],
    ) -> None:
        super().__init__(
            pushed.units[index],
            noise.of_joint(index),
            functools.partial(pushed.with_design, index),
        )
        self._gains = gains
        stddevs = noise.bend_angle_stddevs
        self._before = math.hypot(*stddevs[:index])
        """rad, deviation of the tilt of the unit before the joint"""
        # One angle before the joint turns its load as any other does.
        turns = [(0, self._before)] if index else []
        turns += [(joint, stddevs[joint]) for joint in range(index + 1, len(stddevs))]
        self._by_turns = [
            (NOTHING.plus(dead, stddev), NOTHING.plus(push, stddev))
            for joint, stddev in turns
            if stddev
            for dead, push in (by_angle[joint][index],)
        ]
        """What one deviation of each other angle changes of the load"""
        self._by_weights = [
            (uncertainty, pushed.by_weight(index, unit, uncertainty.parameters))
            for unit, uncertainty in enumerate(noise.designs)
            if unit > index and uncertainty is not None
        ]
        """What the uncertain parameters of each unit beyond change of it"""

    def _of_measured(self, force: float, slip: Slip, point: SlipPoint) -> float:
        unit, noise = self._unit, self._noise
        by_pair = slip_by_tensions(slip, point, unit.design.relative_lever)[:: int(slip.side)]
        variance: float = noise.tension_stddev**2 * sum(
            [(by_pair[0] * left + by_pair[1] * right) ** 2 for left, right in self._gains]
        )
        variance += (noise.bend_angle_stddev * float(point.slope)) ** 2
        radius = unit.design.ball_radius
        for dead, push in self._by_turns:
            variance += slip_by_load(slip, point, dead.plus(push, force), radius) ** 2
        for uncertainty, changes in self._by_weights:
            variance += uncertainty.variance(
                {
                    name: slip_by_load(slip, point, change, radius)
                    for name, change in changes.items()
                }
            )
        return variance

    def _of_measured_lift(self, force: float) -> float:
        noise = self._noise
        variance = noise.tension_stddev**2 * sum(
            [(one + other) ** 2 for one, other in self._gains]
        )
        if noise.bend_angle_stddev or self._before:
            stddev = math.hypot(noise.bend_angle_stddev, self._before)
            variance += (stddev * self._lift_by_angle(force)) ** 2
        for uncertainty, changes in self._by_weights:
            variance += uncertainty.variance(
                {name: self._lift_by_load(force, change) for name, change in changes.items()}
            )
        return variance

    def _lift_by_load(self, force: float, change: DeadLoad) -> float:
        unit, size = self._unit, change.size
        if not size:
            return 0.0
        step = STEP * unit.total / size
        more = unit._replace(dead=unit.dead.plus(change, step))
        by_load: float = (more.lift(force) - unit.lift(force)) / step
        return by_load


class ArmDoubt:
    """How much speaks against a force at the tip of an arm, by what holds each of its joints.

    Parameters
    ----------
    of_joints : list of Doubt
    """

    def __init__(self, of_joints: list[Doubt]) -> None:
        self.of_joints = of_joints
        self._order = list(range(len(of_joints)))
        """Of the joints, the one first that has excluded a force last"""

    def beyond(self, force: float, level: float) -> float:
        """Return by how much the doubt, as a score, is beyond that of a level.

        A joint that excludes a force whatever the others say is not asked with them, which saves
        two thirds of the time of an arm of ten units.
        """
        sure = level ** (1.0 / len(self.of_joints))
        near, doubt = 0, 0.0
        for place, index in enumerate(self._order):
            most, least = self.of_joints[index].bounds(force)
            near += most > NEAR
            doubt = max(doubt, NORMAL.cdf(most) - NORMAL.cdf(least))
            if doubt > sure:
                self._order.insert(0, self._order.pop(place))
                return as_score(doubt) - as_score(sure)
        return as_score(doubt) - as_score(level ** (1.0 / max(1, near)))

    def probability(self, force: float) -> float:
        """Return the probability that the sets of all joints have a force, as if independent.

        While a joint slips it is that of readings as far off: 1 − level at the ends of the
        intervals of that level.
        """
        if not any(one.slips_to for one in self.of_joints):
            return math.prod(one.probability(force) for one in self.of_joints)
        bounds = [one.bounds(force) for one in self.of_joints]
        near = max(1, sum([most > NEAR for most, _ in bounds]))
        doubt = max([NORMAL.cdf(most) - NORMAL.cdf(least) for most, least in bounds])
        return float(1.0 - doubt**near)

    def bounding(self, force: float) -> int | None:
        """Return the joint, counted from 1, that bounds the set there; None for infinity."""
        if math.isinf(force):
            return None

        def doubt(index: int) -> tuple[float, float]:
            most, least = self.of_joints[index].bounds(force)
            return NORMAL.cdf(most) - NORMAL.cdf(least), most

        return max(range(len(self.of_joints)), key=doubt) + 1


def joint_scores(pushed: PushedArm, noise: ArmNoise) -> list[JointScores]:
    """Return what noisy measurements of an arm say of each joint."""
    arm, count = pushed.arm, len(pushed.units)
    by_angle = [pushed.by_angle(joint) for joint in range(count)]
    return [
        JointScores(pushed, index, noise, by_angle, _gains_at(arm, here, pushed.at_joints, index))
        for index, here in enumerate(crossings(arm))
    ]


def _gains_at(
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
