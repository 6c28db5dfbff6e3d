"""What noise does to a unit whose tensions are believed sample by sample."""

from __future__ import annotations

import math
from typing import NamedTuple

from .gradients import slip_by_tensions
from .regime import Regime
from .state import Equilibrium

LARGEST = 4.0
"""Deviations by which the largest of many readings is off: of 30 000, a minute at 500 Hz"""

HARM = math.radians(1.0)
"""Error in rad from which on it counts"""


class NoiseRisk(NamedTuple):
    """How near noise alone is to slipping a unit, and how far it would then put it off."""

    short_of_slip: float
    """Deviations of the noise by which the unit is driven less than it takes to slip"""
    error: float
    """Standard deviation in rad of where one reading puts it; infinite where it would slide on"""

    @property
    def is_unsafe(self) -> bool:
        """Whether within a minute or so one reading slips the unit farther than `HARM`."""
        return self.short_of_slip < LARGEST and LARGEST * self.error > HARM


def noise_risk(result: Equilibrium, tension_stddev: float) -> NoiseRisk | None:
    """Return what noise can do to a unit at its angle; None where it cannot move it farther.

    To first order the slip function is off by σ_g, its gradient by the tensions times their noise,
    and the angle at which it is zero by σ_g / |∂g/∂θ|. A unit that is pushed past a rising root
    slides on.

    Parameters
    ----------
    tension_stddev : float
        Standard deviation of each tension in N, the two independent.
    """
    if result.bend_angle is None or result.regime is Regime.DRIVEN_TO_STOP:
        return None
    slip, probe = result._slip_and_probe
    point = slip.point(probe)
    deviation = tension_stddev * math.hypot(
        *slip_by_tensions(slip, point, result.design.relative_lever)
    )
    if not deviation > 0.0:
        return None
    error = deviation / -point.slope if point.slope < 0.0 else math.inf
    return NoiseRisk(-point.excess / deviation, error)
