"""How sure the answer for one pair of noisy tensions is: the distribution of the slip angle.

The slip angle is that at which the unit is about to slip to the side of the stronger cable. Where
the slip function G = T g rises with the angle through the range, it lies at or before x just where
G(x) ≥ 0. So to first order in the noise

    F(x) = P(slip angle ≤ x) = Φ(G(x) / σ_G(x)),

whatever the regime: F(0) is the probability of ``driven_to_stop``, 1 − F(θ_max) that of ``held``,
and in between lies an equilibrium. Where G falls, signs and ends change places. The gradient of
the root, on which deviations rest, says nothing of all this near the end of a regime.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from statistics import NormalDist
from typing import Any

from .design import JointDesign, design_parameters
from .gradients import slip_by_tensions
from .load import UPRIGHT, Load
from .roots import Bracket, refine
from .slip import Slip
from .solver import solve
from .state import Regime
from .tensions import Tensions, check_tensions, taut_slip

DRAWS = 4096
"""Pairs that are solved where there is no closed form"""

FAR = 5.0
"""Standard deviations that count as never"""

_NORMAL = NormalDist()


def slip_angle_distribution(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    *,
    tension_stddev: float,
    load: Load = UPRIGHT,
    design_covariance: DesignCovariance | None = None,
) -> SlipAngleDistribution:
    """Return the distribution of the slip angle of a pair of noisy tensions.

    In closed form where the slip function is monotonic and the side of slip is sure; by
    `DRAWS` draws, solved one by one, elsewhere. `SlipAngleDistribution.is_closed_form` tells.

    Parameters
    ----------
    tension_l, tension_s : float
        Measured cable tensions in N, both above 0.
    tension_stddev : float
        Standard deviation of each tension in N, above 0, the two independent.
    load : Load
        What acts beside them.
    design_covariance : DesignCovariance, optional
        Of parameters of the design; without it the design is exact.

    Raises
    ------
    TensionError
        As `solve` does, and for a slack cable.
    ValueError
        If the deviation is not a finite number above 0.
    """
    if not 0.0 < tension_stddev < math.inf:
        raise ValueError(f'tension_stddev is {tension_stddev!r} N, which must be above 0')
    tensions = check_tensions(tension_l, tension_s)
    slip = taut_slip(design, tensions, load)
    if tension_l > tension_s:
        slip = slip.mirrored()
    return SlipAngleDistribution(design, tensions, load, slip, tension_stddev, design_covariance)
