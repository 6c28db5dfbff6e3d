"""M and K of all joints of many arms at once: the formulas of `excess`, in arrays.

Arms alike, under one load, each with tensions and angles of its own. The first axis of an array is
the arms, the last the joints or the cables.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...array_numbers import ARRAYS
from ...contact.law import ContactLaw, LoadedLaw
from ...load import DeadLoad
from ...stacked_design import StackedDesign
from ..arm import Arm
from ..cables import crossings
from ..carried import Carried
from ..excess import ULPS
from ..motion import ROUNDING

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


class ManyArms:
    """What there is of an arm beside load, tensions and angles: a number for each joint."""

    def __init__(self, arm: Arm) -> None:
        designs = arm.designs
        self.arm = arm
        self.crossing = crossings(arm)
        self.count = len(designs)
        self.friction = arm.cable_friction_coefficient
        self.ends = np.array([cable.last_unit for cable in arm.cables])
        self.stops = np.array(arm.stops)
        self.radii = np.array([design.ball_radius for design in designs])
        self.springs = np.array([design.stiffness for design in designs])
        self.levers = np.array([design.cable_lever for design in designs])
        self.adds: Floats = (self.ends[:, None] > np.arange(self.count)).astype(float)
        """Whether a cable crosses a joint, shape ``(cables, joints)``"""
        self.turns: Floats = np.array([cable.sign for cable in arm.cables])[:, None] * self.adds
        """Its lever to s as a share of the joint's own"""
        for joint, crossing in enumerate(self.crossing):
            for cable, lever in crossing.leverage:
                self.turns[cable, joint] = lever
        kinds: dict[str, list[int]] = {}
        for joint, design in enumerate(designs):
            kinds.setdefault(design.contact_law, []).append(joint)
        self.laws: list[tuple[Any, ContactLaw]] = [
            (
                slice(None) if len(joints) == self.count else np.array(joints),
                StackedDesign([designs[joint] for joint in joints]).law,
            )
            for joints in kinds.values()
        ]
        """Joints of one contact law, and that"""
        self.hangs = np.array([not design.law.carries_more_than_cables for design in designs])
        """Whether a dead load beyond the cable tensions cannot be carried"""
        self.before: Indices = np.arange(self.count)

    def transmitted(self, tensions: Floats, angles: Floats, was: Floats | None) -> Floats | None:
        """Return the tensions at the joints, as `cables.transmitted` does.

        Parameters
        ----------
        tensions : ndarray
            At the base in N, shape ``(arms, cables)``.
        was : ndarray, optional
            What they were at the joints, shape ``(arms, joints, cables)``.

        Returns
        -------
        ndarray or None
            None without friction: they are those at the base.
        """
        if self.friction == 0.0:
            return None
        reaching, found = tensions, []
        bands = np.exp(self.friction * np.abs(angles))
        for joint in range(self.count):
            old = reaching if was is None else was[:, joint]
            band = bands[:, joint, None]
            here = np.minimum(np.maximum(old, reaching / band), reaching * band)
            reaching = np.where(self.ends > joint, here, reaching)
            found.append(reaching)
        return np.stack(found, axis=1)


class Dead(NamedTuple):
    """What the joints carry, as `Carried` has it, in the base's frame."""

    carried: Carried
    size: Floats
    """|P| in N"""
    cosine: Floats
    """Of the tilt of each joint from it at zero bend"""
    sine: Floats
    turning: NDArray[np.complex128]
    """c in N m"""

    @classmethod
    def of(cls, carried: Carried) -> Dead:
        """Return it in arrays."""
        upright = carried.upright
        return cls(
            carried,
            np.array([joint.size for joint in upright]),
            np.array([joint.tilt[0] for joint in upright]),
            np.array([joint.tilt[1] for joint in upright]),
            np.array(carried.turning),
        )

    def frozen(self, index: int, angles: Floats) -> DeadLoad:
        """Return the dead load of one joint of each arm, in the frame of the unit before it.

        As `frozen_loads` does.
        """
        turns = np.exp(1j * np.cumsum(angles, axis=1))
        before = turns[:, index - 1] if index else 1.0
        dead = self.carried.dead[index]
        force = complex(dead.force_x, dead.force_z) * np.broadcast_to(before, len(angles))
        beyond = turns[:, index + 1 :] @ self.turning[index + 1 :]
        moment = self.turning[index] * before + beyond * np.exp(-1j * angles[:, index])
        return DeadLoad(force.real, force.imag, moment.real, moment.imag)


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


class Drawn:
    """What tensions at the joints do there."""

    def __init__(
        self, arms: ManyArms, dead: Dead, tensions: Floats, at: Floats | None = None
    ) -> None:
        self.arms, self.at = arms, at
        if at is None:
            total, turning = tensions @ arms.adds, tensions @ arms.turns
        else:
            total = np.einsum('ajc,cj->aj', at, arms.adds)
            turning = np.einsum('ajc,cj->aj', at, arms.turns)
        self.total, self.moment = total, turning * arms.levers
        self.scale = arms.radii * total
        with np.errstate(all='ignore'):
            self.share = share = dead.size / total
            excess = total - dead.size
            excess_share = excess / total
            product = excess_share * (1.0 + share)
            self._laws: list[tuple[Any, LoadedLaw]] = []
            unseated = (excess <= 0.0) & arms.hangs
            if unseated.any():  # nothing is known
                product = np.where(unseated, np.nan, product)
            for joints, law in arms.laws:
                of_law = (share[:, joints], excess_share[:, joints], product[:, joints])
                self._laws.append((joints, law.under(of_law, (1.0, 0.0), ARRAYS)))

    def capacity(self, cosine: Floats, sine: Floats) -> tuple[Floats, Floats]:
        """Return K in N m and its derivative by the tilt ahead, of which these are cos and sin."""
        found = []
        for joints, law in self._laws:
            state = law.at(cosine[:, joints], sine[:, joints])
            found.append((joints, state[0], state[1]))
        return self._put_together(found, 0), self._put_together(found, 1)

    def by_tension(self, cosine: Floats, sine: Floats) -> Floats:
        """Return ∂K/∂T in m."""
        found = []
        for joints, law in self._laws:
            state = law.at(cosine[:, joints], sine[:, joints])
            found.append((joints, state[0] - self.share[:, joints] * law.by_share(state)))
        return self._put_together(found, 0) / self.total

    def _put_together(self, parts: list[tuple[Any, ...]], place: int) -> Floats:
        """Put what is known of the joints of each law side by side, times r T."""
        if len(parts) == 1:
            return np.asarray(self.scale * parts[0][1 + place])
        found = np.empty_like(self.scale)
        for joints, *values in parts:
            found[:, joints] = values[place]
        found *= self.scale
        return found


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
