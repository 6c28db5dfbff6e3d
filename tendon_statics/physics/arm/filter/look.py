"""Many arms at bend angles: M and K of all their joints, and their derivatives."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..excess import ULPS
from ..motion import ROUNDING
from .many import Dead, Drawn, ManyArms

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


class Pulled:
    """Many arms under a load, each with its tensions.

    Parameters
    ----------
    tensions : ndarray
        At the base in N, shape ``(arms, cables)``.
    was : ndarray, optional
        What they were at the joints, of cables with friction.
    """

    def __init__(
        self, arms: ManyArms, dead: Dead, tensions: Floats, was: Floats | None = None
    ) -> None:
        self.arms, self.dead, self.tensions, self.was = arms, dead, tensions, was
        self._drawn = None if arms.friction else Drawn(arms, dead, tensions)

    def drawn(self, angles: Floats) -> Drawn:
        """Return what the tensions at the joints do at bend angles."""
        if self._drawn is not None:
            return self._drawn
        at = self.arms.transmitted(self.tensions, angles, self.was)
        return Drawn(self.arms, self.dead, self.tensions, at)

    def part(self, which: Any, was: Floats | None = None) -> Pulled:
        """Return some of the arms, with what the friction of all cables remembers by now."""
        if was is None:
            if len(which) == len(self.tensions) and self.was is None:
                return self
            was = self.was
        was = None if was is None else was[which]
        return Pulled(self.arms, self.dead, self.tensions[which], was)

    def look(self, angles: Floats, sides: Floats | None = None) -> Look:
        """Look at bend angles in rad; at slipping to some sides, or for 0 to that of M."""
        return Look(self, angles, sides)


class Look:
    """The joints of many arms at bend angles.

    Attributes
    ----------
    sides : ndarray
        To which side each joint slips, 1 or −1.
    moment, capacity : ndarray
        M, and K for that side, in N m.
    """

    def __init__(self, pulled: Pulled, angles: Floats, sides: Floats | None) -> None:
        arms, dead = pulled.arms, pulled.dead
        self.arms, self.angles, self.pulled = arms, angles, pulled
        self.drawn = drawn = pulled.drawn(angles)
        tilts = np.cumsum(angles, axis=1)
        cosine, sine = np.cos(tilts), np.sin(tilts)
        x, z = dead.turning.real, dead.turning.imag
        moment = _from_the_tip(x * cosine - z * sine)
        moment += drawn.moment
        moment -= arms.springs * angles
        self._turns = cosine, sine
        self.moment = moment
        by_moment = np.where(moment < 0.0, -1.0, 1.0)
        self.sides = by_moment if sides is None else np.where(sides == 0.0, by_moment, sides)
        self._ahead = (
            dead.cosine * cosine - dead.sine * sine,
            self.sides * (dead.sine * cosine + dead.cosine * sine),
        )
        self.capacity, self._slope = drawn.capacity(*self._ahead)
        self._jacobian: tuple[Indices, Floats] | None = None

    @cached_property
    def excess(self) -> Floats:
        """|M| − K in N m, or of M to the side in question."""
        found: Floats = self.sides * self.moment - self.capacity
        return found

    @cached_property
    def rounding(self) -> Floats:
        """What M of each joint may be wrong by in N m, from the size of all that it is made of."""
        arms = self.arms
        beyond = _from_the_tip(np.abs(self.pulled.dead.turning)[None])
        pull = arms.levers * np.abs(self.drawn.total)
        found: Floats = ULPS * (pull + beyond + arms.springs * arms.stops)
        return found

    @property
    def leans(self) -> NDArray[np.bool_]:
        """Whether a joint is at the stop to its side."""
        found: NDArray[np.bool_] = self.sides * self.angles >= self.arms.stops
        return found

    def beyond(self, share: float | Floats = ROUNDING) -> NDArray[np.bool_]:
        """Return which joints neither friction nor a stop holds, by more than a share of K."""
        too_much = np.maximum(share * self.capacity, self.rounding)
        found: NDArray[np.bool_] = (self.excess > too_much) & ~self.leans
        return found

    def jacobian(self, by: Indices) -> Floats:
        """∂(M − side K)/∂θ in N m/rad of all joints, by some: shape ``(arms, joints, by)``."""
        kept = self._jacobian
        if kept is not None and np.array_equal(kept[0], by):
            return kept[1]
        arms = self.arms
        x, z = self.pulled.dead.turning.real, self.pulled.dead.turning.imag
        cosine, sine = self._turns
        turned = _from_the_tip(x * sine + z * cosine)
        joints = arms.before[:, None]
        found: Floats = -turned[:, np.maximum(joints, by)]
        found -= self._slope[:, :, None] * (by <= joints)
        found -= arms.springs[:, None] * (by == joints)
        if self.drawn.at is not None:
            found += self._by_cables(self.drawn.at)[:, :, by]
        self._jacobian = by, found
        return found

    def _by_cables(self, at: Floats) -> Floats:
        """What of the jacobian the friction of the cables makes, as `cables.by_angles` has it."""
        arms, angles = self.arms, self.angles
        by_sum = (self.sides * self.drawn.by_tension(*self._ahead))[:, None] * arms.adds
        gains = arms.turns * arms.levers - by_sum  # arms, cables, joints
        bands = np.exp(arms.friction * np.abs(angles))
        ahead = np.where(angles < 0.0, -arms.friction, arms.friction)
        found = np.zeros((*angles.shape, arms.count))
        pushed = np.zeros((len(angles), len(arms.ends), arms.count))  # ∂ ln T'/∂θ
        reaching = self.pulled.tensions
        for joint in range(arms.count):
            here, band = at[:, joint], bands[:, joint, None]
            up, down = here == reaching * band, here == reaching / band
            slope = np.where(up, 1.0, -1.0) * ahead[:, joint, None]
            crosses = arms.ends > joint
            pushed[~(up | down) & crosses] = 0.0
            pushed[:, :, joint] = np.where((up | down) & crosses, slope, 0.0)
            found[:, joint] = np.einsum('ac,acj->aj', gains[:, :, joint] * here, pushed)
            reaching = here
        return found


def _from_the_tip(values: Floats) -> Floats:
    """Return sums over each joint and all beyond it."""
    return np.cumsum(values[:, ::-1], axis=1)[:, ::-1]
