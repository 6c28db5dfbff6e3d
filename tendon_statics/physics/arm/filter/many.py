"""Many arms alike at once, in arrays: what is the same of all, and what tensions do at joints.

They are under one load, each with tensions and angles of its own. The first axis of an array is
the arms, the last the joints or the cables. With `look` these are the formulas of `excess`.
"""

from __future__ import annotations

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
        self.ends = np.array(arm.cable_ends)
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
