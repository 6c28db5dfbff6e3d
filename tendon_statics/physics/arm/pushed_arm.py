"""An arm at known angles, pushed at its tip by an unknown force along a known line.

With all others frozen each joint is a single unit, whose dead load the force adds to in
proportion; see `pushed_unit`. How that load changes with the angles of the other joints and with
the weights of the units beyond is linear too.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping, Sequence, Sized
from typing import Any, NamedTuple

from ..design import JointDesign
from ..errors import TensionError
from ..load import DeadLoad, Load, push_along
from ..pushed_unit import PushedUnit
from .arm import Arm
from .cables import AtJoints, crossings, pair_at, transmitted
from .carried import Carried, frozen_loads
from .joints import taut_pairs

STEP = 1e-6
"""rad, of differences by an angle"""

NOTHING = DeadLoad(0.0, 0.0, 0.0, 0.0)

LoadChange = tuple[DeadLoad, DeadLoad]
"""What changes of the dead load of a joint, and of what each newton at the tip adds to it"""


class PushedArm(NamedTuple):
    """An arm whose load is known but for one force at its tip."""

    arm: Arm
    load: Load
    """In the base's frame, without that force"""
    angles: list[float]
    """θ of each joint in rad"""
    at_joints: AtJoints
    """Tension in N of each cable at each joint"""
    dead: list[DeadLoad]
    """What each unit carries, in the base's frame; see `Carried`"""
    push: list[DeadLoad]
    """What each newton at the tip adds to it"""
    units: list[PushedUnit]
    """Each joint with all others frozen"""

    @classmethod
    def of(
        cls,
        arm: Arm,
        tensions: Mapping[str, Any],
        angles: list[float],
        direction: Sequence[float],
        load: Load,
    ) -> PushedArm:
        """Return an arm under the tensions of its cables, at the base or at all joints.

        Raises
        ------
        TensionError
            If a tension is missing or not allowed, or a joint has no tension on one side.
        LoadError
            If the direction is no unit vector in the plane of bending, or the load's own force
            is said to act elsewhere than at the tip.
        """
        at_joints = _at_joints(arm, tensions, angles)
        pairs = taut_pairs(arm, at_joints)
        dead = Carried(arm, load).dead
        push = [push_along(direction, unit.length) for unit in arm.units]
        frozen = frozen_loads(dead, angles), frozen_loads(push, angles)
        units = [
            PushedUnit(*joint) for joint in zip(arm.designs, pairs, angles, *frozen, strict=True)
        ]
        return cls(arm, load, angles, at_joints, dead, push, units)

    def with_design(self, index: int, design: JointDesign) -> PushedUnit:
        """Return a joint whose own unit has another design."""
        arm, old = self.arm, self.arm.designs[index]
        units = list(arm.units)
        units[index] = dataclasses.replace(units[index], design=design)
        crossing = crossings(dataclasses.replace(arm, units=tuple(units)))[index]
        before, after = (
            DeadLoad.of(one, self.load.gravity_direction, (0.0, 0.0), 0.0) for one in (old, design)
        )
        joint = self.units[index]
        change = self._at_joint(index, {index: after.plus(before, -1.0)})
        return joint._replace(
            design=design,
            tensions=pair_at(crossing, self.at_joints[index]),
            dead=joint.dead.plus(change),
        )

    def by_weight(self, index: int, of_unit: int, names: Iterable[str]) -> dict[str, DeadLoad]:
        """Return by how much a joint's dead load grows with parameters of a unit beyond it."""
        design, lengths = self.arm.designs[of_unit], [unit.length for unit in self.arm.units]
        x, _, z = self.load.gravity_direction
        # ∂W and ∂(l W)
        known = {
            'mass': (design.gravity, design.com_distance * design.gravity),
            'gravity': (design.mass, design.com_distance * design.mass),
            'com_distance': (0.0, design.weight),
        }
        found = {}
        for name in names:
            weight, moment = known.get(name, (0.0, 0.0))
            changes = {of_unit: DeadLoad(weight * x, weight * z, moment * x, moment * z)}
            for joint in range(index, of_unit):
                lever = lengths[joint] * weight
                changes[joint] = DeadLoad(weight * x, weight * z, lever * x, lever * z)
            found[name] = self._at_joint(index, changes)
        return found

    def by_angle(self, joint: int) -> list[LoadChange]:
        """Return by how much each joint's dead load, and the push, change with one angle."""
        turned = []
        for step in (-STEP, STEP):
            angles = [*self.angles]
            angles[joint] += step
            turned.append((frozen_loads(self.dead, angles), frozen_loads(self.push, angles)))
        before, after = (zip(*both, strict=True) for both in turned)
        return [
            (_slope(dead, other_dead), _slope(push, other_push))
            for (dead, push), (other_dead, other_push) in zip(before, after, strict=True)
        ]

    def _at_joint(self, index: int, changes: Mapping[int, DeadLoad]) -> DeadLoad:
        """Return what changes of the loads of units, in the base's frame, mean for a joint."""
        of_units = [changes.get(unit, NOTHING) for unit in range(len(self.angles))]
        return frozen_loads(of_units, self.angles)[index]


def _slope(before: DeadLoad, after: DeadLoad) -> DeadLoad:
    return NOTHING.plus(after.plus(before, -1.0), 0.5 / STEP)


def _at_joints(arm: Arm, tensions: Mapping[str, Any], angles: list[float]) -> AtJoints:
    """Return the tensions at the joints: as `transmitted` has them, or as they are given."""
    known = {
        cable.name: _of_cable(cable.name, tensions[cable.name], cable.last_unit)
        for cable in arm.cables
        if isinstance(tensions.get(cable.name), Sized)
    }
    at_base = {**tensions, **{name: values[0] for name, values in known.items()}}
    at_joints = transmitted(arm, arm.check_tensions(at_base), angles, None)
    if not known:
        return at_joints
    found = []
    for joint, here in enumerate(at_joints):
        derived = dict(zip(arm.cable_names, here, strict=True))
        given = {name: values[min(joint, len(values) - 1)] for name, values in known.items()}
        found.append(arm.check_tensions({**derived, **given}))
    return found


def _of_cable(name: str, values: Sequence[float], count: int) -> Sequence[float]:
    """Return the tensions of one cable, as they are given, if there is one for each joint."""
    if isinstance(values, str):
        raise TensionError(f'the tension of cable {name} is {values!r}, which is not a number')
    if len(values) != count:
        raise TensionError(
            f'cable {name} has {len(values)} tensions, but crosses {count} joints: one in N is '
            'needed for each, or one alone, at the base'
        )
    return values
