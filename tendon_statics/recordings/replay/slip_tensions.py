"""At which tension a unit would slip where it was measured to be."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...physics import JointDesign
from ...physics.calibration.boundary_distance import Noise, boundary_distance
from ..session import Floats
from .result import Replay

NO_NOISE = Noise(1.0, 0.0, 0.0)
"""Only the excess itself is asked for"""


class SlipTensions(NamedTuple):
    """Tensions in N at slip, arrays of shape ``(n,)``; NaN but of the cable that drives."""

    tension_l: Floats
    tension_s: Floats


def slip_tensions(design: JointDesign, replay: Replay) -> SlipTensions | None:
    """Return the tension of the driving cable at which the unit slips at its measured angle.

    It is that of the same sum of tensions, on which the capacity depends; where the measured
    tension meets it, the unit is to slip. There is none against a stop, which holds by itself, and
    None at all without measured angles.
    """
    recording = replay.recording
    if recording.bend_angle is None:
        return None
    found = boundary_distance(
        design,
        recording.tension_l,
        recording.tension_s,
        recording.bend_angle,
        np.full(len(recording), np.nan),
        NO_NOISE,
        recording.sample_loads(replay.load),
    )
    # M is linear in the difference of the tensions, by r_l / r of each.
    missing = -design.friction_coefficient * found.excess / (2.0 * design.relative_lever)
    inside = abs(recording.bend_angle) < design.max_bend_angle - 2.0 * replay.measured_stddev
    return SlipTensions(
        np.where(inside & (found.side < 0.0), recording.tension_l + missing, np.nan),
        np.where(inside & (found.side > 0.0), recording.tension_s + missing, np.nan),
    )
