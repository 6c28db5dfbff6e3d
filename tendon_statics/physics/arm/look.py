"""An arm at given bend angles, and what its joints do there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..contact.law import State
from ..tensions import Tensions
from .cables import AtJoints

if TYPE_CHECKING:
    from .excess import Excess


class Look:
    """The joints of an arm at given bend angles.

    Attributes
    ----------
    moments : list of float
        M of each in N m.
    """

    __slots__ = (
        *('_capacities', '_excess', 'angles', 'at_joints', 'moments', 'pairs', 'turned', 'turns'),
    )

    def __init__(
        self,
        excess: Excess,
        angles: list[float],
        turns: list[complex],
        turned: list[complex],
        moments: list[float],
        pairs: list[Tensions],
        at_joints: AtJoints,
    ) -> None:
        self._excess, self.angles = excess, angles
        self._capacities: dict[tuple[int, float], tuple[float, float, State]] = {}
        self.turns, self.turned, self.moments = turns, turned, moments
        self.pairs, self.at_joints = pairs, at_joints

    def capacity(self, joint: int, side: float) -> tuple[float, float, State]:
        """K in N m for slipping to a side, side ∂K/∂Θ, and what else the contact law knows."""
        known = self._capacities.get((joint, side))
        if known is None:
            law, scale, _, _ = self._excess.law(joint, side, self.pairs[joint])
            turn = self.turns[joint]
            state = law.at(turn.real, side * turn.imag)
            known = self._capacities[joint, side] = scale * state[0], scale * state[1], state
        return known

    def velocities(self, sides: dict[int, float]) -> list[float]:
        """Return f = M − side K in N m of some joints, by their sides."""
        return [
            self.moments[joint] - side * self.capacity(joint, side)[0]
            for joint, side in sides.items()
        ]

    def drive(self, joint: int) -> tuple[float, float, float]:
        """Side to which M drives, the excess |M| − K in N m, and K."""
        moment = self.moments[joint]
        side = -1.0 if moment < 0.0 else 1.0
        capacity = self.capacity(joint, side)[0]
        return side, side * moment - capacity, capacity
