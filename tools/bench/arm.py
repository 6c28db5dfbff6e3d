"""An arm of ten joints: one update in which nothing slips, and those of a load cycle that slip."""

from __future__ import annotations

import dataclasses
import math
import time

from tendon_statics import (
    Arm,
    ArmTracker,
    ArmUnit,
    Cable,
    Regime,
    default_design_path,
    load_design,
)
from tendon_statics.physics.contact import CONTACT_LAWS

from .rows import Row, at_most
from .timing import best_times

JOINTS = 10
SAMPLES = 1000
"""Of the load cycle: one second at 1 kHz"""

CYCLES = 5
"""Of which the best is taken of each update: one alone is easily disturbed"""

CABLE_FRICTION = 0.1

HELD_LIMIT = 12e-6
"""s a joint"""
SLIP_LIMIT = 2e-3
"""s for all joints"""


def rows() -> list[Row]:
    """Measure."""
    found = []
    for law in CONTACT_LAWS:
        arm = arm_of_ten(law)
        held = best_times([_held(arm)], 200)[0] / JOINTS
        work = f'an arm of {JOINTS}, {law}'
        found.append(at_most(f'{work}: a joint, none slips', '12 µs', held / HELD_LIMIT, 1.0))
        slips = _slips(arm)
        for which, share in (
            ('half of the updates in which some slip', 0.5),
            ('nine tenths of the updates in which some slip', 0.9),
            ('99 in 100 of the updates in which some slip', 0.99),
            ('the worst, in which several run to their stops', 1.0),
        ):
            took = slips[int(share * (len(slips) - 1))]
            found.append(at_most(f'{work}: {which}', '2 ms', took / SLIP_LIMIT, 1.0))
    slips = _slips(arm_of_ten('merged', CABLE_FRICTION))
    for name, share in (('half of', 0.5), ('99 in 100 of', 0.99), ('all', 1.0)):
        what = f'an arm of {JOINTS}, merged, cables with friction: {name} the updates that slip'
        found.append(Row(what, '2 ms', slips[int(share * (len(slips) - 1))] / SLIP_LIMIT))
    return found


def arm_of_ten(law: str, cable_friction: float = 0.0) -> Arm:
    """Return ten units around a sheath, with a pair of cables for each."""
    design = dataclasses.replace(
        load_design(default_design_path()),
        contact_law=law,
        friction_coefficient=0.3,
        stiffness=0.05,
    )
    cables = [Cable(f'{side}{unit}', side, unit) for unit in range(1, JOINTS + 1) for side in 'ls']
    return Arm([ArmUnit(design, 0.02)] * JOINTS, cables, cable_friction)


def _held(arm: Arm):
    tracker, even = ArmTracker(arm), dict.fromkeys(arm.cable_names, 1.0)
    return lambda: tracker.update(even)


def _slips(arm: Arm) -> list[float]:
    """CPU times of the updates in which some joint slips, ascending, the best of `CYCLES` each."""
    best = [math.inf] * SAMPLES
    slips = [False] * SAMPLES
    for _ in range(CYCLES):
        tracker = ArmTracker(arm)
        for index in range(SAMPLES):
            pull = 0.8 * math.sin(2.0 * math.pi * index / SAMPLES)
            tensions = {
                cable.name: 1.0 + cable.sign * pull * (1.0 if cable.last_unit % 2 else 0.5)
                for cable in arm.cables
            }
            start = time.process_time()
            state = tracker.update(tensions)
            best[index] = min(best[index], time.process_time() - start)
            slips[index] = Regime.SLIPPING in state.regimes
    return sorted(took for took, slip in zip(best, slips, strict=True) if slip)
