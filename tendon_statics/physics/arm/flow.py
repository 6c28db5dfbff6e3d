"""How the joints of an arm slip, together, until all are at rest.

The rule for several joints at once: equal viscosity in every joint, taken to zero. A joint beyond
its limit moves with

    θ' = f = ±(|M| − K),

to the side to which it is driven, all others rest. How fast is of no account, only where it ends.
The cables and the dead load do the work ∫ M dθ, of which friction takes up at least K all along,
so the way of all joints together is bounded, and the arm comes to rest.

The motion is smooth while it is the same joints that move. It is followed so, leg by leg, and a
leg ends where another joint comes to its limit, one falls below it, or one meets its stop; see
`legs`. A long way is gone in `strides` instead, for as long as these are long. Where no other
joint moves before all are at rest, and that is near, M = K of those that move is solved by
Newton's method; see `rest`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..errors import ArmError
from .excess import Excess, Look
from .legs import FAR, Leg
from .motion import Motion
from .rest import TINY, come_to_rest
from .strides import SHORT, go_strides, suits_strides

MOST_LEGS = 3000


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
        if may_stride and suits_strides(leg):
            go_strides(motion, leg.linear.far(SHORT))
            may_stride = False
            continue
        may_stride = True
        if not _rests(motion, leg):
            far = leg.go()
            if not far:
                break
    raise ArmError('the arm is not followed to rest: its numbers are out of all proportion')


def _rests(motion: Motion, leg: Leg) -> bool:
    """Go to rest if it is near and a leg goes there; return whether it was gone."""
    way = leg.linear.to_rest
    return (
        leg.may_rest
        and bool(leg.time == math.inf or abs(way).max() <= TINY)
        and come_to_rest(motion, way, leg.jacobian)
    )
