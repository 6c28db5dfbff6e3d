"""How the joints of an arm slip, together, until all are at rest.

The rule for several joints at once: equal viscosity in every joint, taken to zero. A joint beyond
its limit moves with

    θ' = f = ±(|M| − K),

to the side to which it is driven, all others rest. How fast is of no account, only where it ends.
The cables and the dead load do the work ∫ M dθ, of which friction takes up at least K all along,
so the way of all joints together is bounded, and the arm comes to rest.

The motion is smooth while it is the same joints that move. It is followed so, step by step, and
each step ends where another joint comes to its limit, one falls below it, or one meets its stop.
Where what is left to go is as good as linear, it is gone in one go: up to the next such event, or
if there is none, to rest, where M = K of those that move is solved by Newton's method.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import ArmError
from .excess import Excess, Look
from .motion import Motion
from .one_go import go_on
from .steps import step_on

Floats = NDArray[np.float64]

FIRST_WAY = 1e-2
"""Way in rad of the fastest joint in the first step that is tried"""

MOST_STEPS = 3000


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
        If it is not followed to rest in `MOST_STEPS`, a hundred times as many as it takes.
    """
    motion = Motion(excess, angles)
    step = 0.0
    for _ in range(MOST_STEPS):
        if not motion.moving:
            pairs = zip(angles, motion.look.angles, strict=True)
            moved = {joint for joint, (old, new) in enumerate(pairs) if old != new}
            return Settled(motion.look, motion.at_limit, moved)
        velocity, jacobian = motion.velocity(motion.look), motion.jacobian(motion.look)
        growth = _growth(jacobian)
        if growth and go_on(motion, velocity, jacobian, growth):
            continue
        step = step or FIRST_WAY / float(abs(velocity).max())
        if growth > 0.0:  # a longer one would take what grows for what has died away
            step = min(step, 1.0 / growth)
        step = step_on(motion, velocity, jacobian, step)
    raise ArmError(
        f'the arm is not at rest after {MOST_STEPS} steps: its numbers are out of all proportion'
    )


def _growth(jacobian: Floats) -> float:
    """The fastest rate at which the motion grows; below zero where it dies away."""
    # No eigenvalue is to the right of the discs about the diagonal.
    diagonal = np.asarray(np.diagonal(jacobian))
    bound = float((diagonal + abs(jacobian).sum(axis=1) - abs(diagonal)).max())
    if bound < 0.0 or len(jacobian) == 1:
        return bound
    return float(np.linalg.eigvals(jacobian).real.max())
