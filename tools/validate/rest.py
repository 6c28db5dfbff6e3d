"""Where the hanging unit rests by a capacity that is given: the root of M = K."""

from __future__ import annotations

import math
from collections.abc import Callable

from scipy.optimize import brentq

from . import foundation
from .constructions import HangingUnit
from .laws import capacity

Capacity = Callable[[float, float, float], float]
"""T, P_a and P_t in N → K in N·m"""


def rest_angle(unit: HangingUnit, tension_s: float, capacity_of: Capacity) -> float:
    """Return the angle in rad at which the moment, which falls, has come down to the capacity."""

    def excess(angle: float) -> float:
        axial, transverse = unit.weight * math.cos(angle), unit.weight * math.sin(angle)
        held = capacity_of(unit.tension_l + tension_s, axial, transverse)
        return unit.moment(tension_s, angle) - held

    root: float = brentq(excess, 0.0, 0.5 * math.pi)
    return root


def by_law(unit: HangingUnit, tension_s: float, law: str) -> float:
    """Return the angle in rad by one of the package's laws."""
    return rest_angle(
        unit, tension_s, lambda *forces: capacity(law, unit.seat, unit.friction, *forces)
    )


def by_foundation(unit: HangingUnit, tension_s: float) -> float:
    """Return the angle in rad by direct integration."""
    pads = unit.seat.pads(24, 96)
    return rest_angle(
        unit, tension_s, lambda *forces: foundation.capacity(pads, unit.friction, *forces)
    )
