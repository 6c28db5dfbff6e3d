"""Random arms that are pushed at the tip, and which forces their joints hold, by brute force."""

from __future__ import annotations

import math
from typing import NamedTuple

import arm_brute
import brute
import numpy as np

from tendon_statics import Arm, Load, arm_tip_force


class Pushed(NamedTuple):
    """An arm at some angles, and a line along which it is pushed."""

    arm: Arm
    load: Load
    tensions: dict
    angles: list
    direction: np.ndarray

    @property
    def scale(self):
        """Of the forces, in N."""
        return sum(np.max(one) for one in self.tensions.values())

    def found(self, **changed):
        asked = {'bend_angles': self.angles, 'load': self.load, **changed}
        arm, tensions = asked.pop('arm', self.arm), asked.pop('tensions', self.tensions)
        direction = tuple(asked.pop('direction', self.direction))
        return arm_tip_force(arm, tensions, direction=direction, **asked)


def random_pushed(draw, friction=True):
    arm = arm_brute.random_arm(draw, friction=friction)
    load = arm_brute.random_load(draw)
    tensions = arm_brute.random_pull(draw, arm, load)
    for pair in range(len(arm.cables) // 2):  # half of them nearly even, which more joints hold
        if draw.random() < 0.7:
            total = tensions[f'l{pair}'] + tensions[f's{pair}']
            share = draw.uniform(0.45, 0.55)
            tensions[f'l{pair}'], tensions[f's{pair}'] = total * share, total * (1.0 - share)
    bent = draw.choice((1.0, 0.3, 0.03))
    angles = [bent * draw.uniform(-stop, stop) for stop in arm.stops]
    # Anywhere, across the base, along the last unit.
    of = draw.choice((draw.uniform(-math.pi, math.pi), 0.5 * math.pi, sum(angles)))
    return Pushed(arm, load, tensions, angles, np.array([math.sin(of), math.cos(of)]))


def with_used_friction(draw, case):
    """The same with tensions at all joints, of which friction has let each be anything allowed."""
    friction, tensions = case.arm.cable_friction_coefficient, {}
    for cable in case.arm.cables:
        along, tension = [], case.tensions[cable.name]
        for angle in case.angles[: cable.last_unit]:
            tension *= math.exp(draw.uniform(-1.0, 1.0) * friction * abs(angle))
            along.append(tension)
        tensions[cable.name] = along
    return case._replace(tensions=tensions)


def joints_held(case, force):
    """Whether friction can hold each joint under forces in N, from vectors: a row for each."""
    found = []
    for is_seated, *excesses in joint_excesses(case, force):
        found.append(is_seated & (excesses[0] <= 0.0) & (excesses[1] <= 0.0))
    return np.array(found)


def joint_excesses(case, force):
    """Of each joint whether it is seated, and its excess over friction in N m, to s and to l."""
    reference = arm_brute.BruteArm(case.arm, case.angles)
    if any(isinstance(of, list) for of in case.tensions.values()):  # at all joints
        pulls = [case.tensions[cable.name] for cable in case.arm.cables]
    else:
        pulls = reference.pulls(case.tensions, case.angles)
    push = force * case.direction[0], force * case.direction[1]
    for joint, design in enumerate(case.arm.designs):
        moment, *state = reference.at_joint(joint, case.load, case.angles, pulls, push)
        total, axial, across = state
        with np.errstate(all='ignore'):
            yield (
                brute.seats(design, total, axial, across),
                *(
                    side * moment - brute.capacity_under(design, total, axial, side * across)
                    for side in (1.0, -1.0)
                ),
            )
