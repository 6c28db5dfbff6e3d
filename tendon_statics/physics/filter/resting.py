"""Whether all members rest, as is seen from the extremes of their tensions alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..loaded_joint import LoadedJoint
from ..slip import Slip


def hold_all(joint: LoadedJoint, tensions: NDArray[np.float64], angle: float, stop: float) -> bool:
    """Whether it is plain that no pair of tensions moves a unit from where it is.

    The moment M that drives a unit grows with the tension of the cable ahead and falls with the
    other's; the capacity K of every law grows with either, since they press the joint. So no pair
    moves it if the least tensions of all give the capacity for the largest moment of all, to
    either side, but that of a stop against which the unit lies. Where they do not, some pair may.

    Parameters
    ----------
    joint : LoadedJoint
        Of one design under one load.
    tensions : ndarray
        T_l and T_s in N, shape ``(2, ...)``.
    angle, stop : float
        Where the unit is, and θ_max, in rad.
    """
    both = tensions.reshape(2, -1)
    least_l, least_s = np.minimum.reduce(both, axis=1).tolist()
    most_l, most_s = np.maximum.reduce(both, axis=1).tolist()
    excess = least_l + least_s - joint.size
    if not min(least_l, least_s, excess) > 0.0:
        return False
    for side, more in ((-1.0, most_l - least_l), (1.0, most_s - least_s)):
        if side * angle < stop:
            slip = Slip(joint, excess, least_l, least_s, side)
            if slip.value(side * angle) * slip.total + more * joint.lever > 0.0:
                return False
    return True
