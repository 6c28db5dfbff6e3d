"""How the joints of an arm slip, together, until all are at rest.

The rule for several joints at once: equal viscosity in every joint, taken to zero. A joint beyond
its limit moves with

    θ' = f = ±(|M| − K),

to the side to which it is driven, all others rest. How fast is of no account, only where it ends.
The cables and the dead load do the work ∫ M dθ, of which friction takes up at least K all along,
so the way of all joints together is bounded, and the arm comes to rest.

The motion is smooth while it is the same joints that move. It is followed so, leg by leg, and a
leg ends where another joint comes to its limit, one falls below it, or one meets its stop; see
`legs`. A long way is gone in `strides` instead, for as long as these are long, and one past where
the arm lingers is gone at once; see `creep`. Where no other joint moves before all are at rest,
and that is near, M = K of those that move is solved by Newton's method; see `rest`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..errors import ArmError
from .creep import creep
from .excess import Excess
from .legs import FAR, Leg
from .linear_motion import largest
from .look import Look
from .motion import Motion
from .rest import TINY, come_to_rest
from .strides import first_stride, go_strides

MOST_LEGS = 3000

NO_REST = 0.25
"""Share of the way to rest, were the motion linear, beyond which it is missed for good: if f is
quadratic there is none"""


@dataclass
class Settled:
    """Where an arm has come to rest."""

    look: Look
    at_limit: dict[int, float] = field(default_factory=dict)
    """Joints that came to rest with M = K → the side to which they were driven"""
    moved: set[int] = field(default_factory=set)
    """All joints that have slipped"""


def settle(excess: Excess, angles: list[float]) -> Settled:
    """Let an arm slip from bend angles in rad until it is at rest.

    Raises
    ------
    ArmError
        If it is not followed to rest in `MOST_LEGS`, a hundred times as many as it takes.
    """
    motion, far, may_stride = Motion(excess, angles), FAR, True
    for _ in range(MOST_LEGS):
        if not motion.moving:
            pairs = zip(angles, motion.look.angles, strict=True)
            moved = {joint for joint, (old, new) in enumerate(pairs) if old != new}
            return Settled(motion.look, motion.at_limit, moved)
        try:
            leg = Leg(motion, far)
        except np.linalg.LinAlgError:
            break
        stride = first_stride(leg, len(angles)) if may_stride else None
        may_stride = stride is None
        if stride:
            go_strides(motion, stride)
            continue
        missed = _missed(motion, leg)
        if missed and not (missed > NO_REST and creep(motion, leg.linear)):
            far = leg.go()
            if not far:
                break
    raise ArmError('the arm is not followed to rest: its numbers are out of all proportion')


def _missed(motion: Motion, leg: Leg) -> float:
    """Go to rest if it is near and a leg goes there; return by how much it was missed.

    As `come_to_rest` has it: zero if it was gone, infinite if none is near.
    """
    if not leg.may_rest:
        return math.inf
    way = leg.linear.to_rest
    if leg.rest_time < math.inf and largest(way) > TINY:
        return NO_REST
    return come_to_rest(motion, way, leg.jacobian)
