"""Arms with one pair of cables along all units, and a unit for them."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

from designs import PRELIMINARY

from tendon_statics import Arm, ArmUnit, Cable

SHEATHED = ArmUnit(
    dataclasses.replace(PRELIMINARY, friction_coefficient=0.3, stiffness=0.04), 0.02
)
"""Comes to rest between the stops"""


def arm_of(units: Sequence[ArmUnit], **more: Any) -> Arm:
    """Return an arm of units, all of which cables l and s pull."""
    count = len(units)
    return Arm(units, [Cable('l', 'l', count), Cable('s', 's', count)], **more)


def pull(tension_l: float, tension_s: float) -> dict[str, float]:
    """Return the tensions in N of its cables."""
    return {'l': tension_l, 's': tension_s}
