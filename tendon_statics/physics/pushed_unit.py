"""A unit at a known angle, pushed by an unknown force along a known line.

All that the force F does is in proportion to it: the moment M, and P_a and P_t, with which the
dead load presses the unit on its ball and drives it aside. So the forces at which friction is at
its limit, |M| = K, are roots of quadratics for every contact law; see
`ContactLaw.forces_at_slip`.

A joint is known by its dead load, and the force by what each newton of it adds to that, so that a
force that acts on several joints in series is asked of each; what all explain is common to them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

from .admissible import Interval
from .contact.quadratic import Line
from .design import JointDesign
from .load import DeadLoad
from .loaded_joint import LoadedJoint
from .slip import Slip
from .tensions import Tensions

BOTH_SIDES = (1.0, -1.0)
"""Towards cable s and towards cable l"""

FARTHEST = 1e9
"""Times the tensions beyond which a force is no end: along a line across the unit's axis, or past
the ball at just the friction's lever, rounding alone has the set end, at some 1e16 times"""

AT_LIMIT = 1e-9
"""|M| / K − 1 within which a root is one of M = K, and not of the squared equation alone"""


class PushedUnit(NamedTuple):
    """One joint, whose dead load is known but for one force."""

    design: JointDesign
    tensions: Tensions
    """N, both above 0"""
    bend_angle: float
    """θ in rad"""
    dead: DeadLoad
    """All that acts beside cables, contact and the force"""
    push: DeadLoad
    """What each newton of the force adds to it"""

    @property
    def total(self) -> float:
        """T in N."""
        return sum(self.tensions)

    def loaded(self, force: float) -> DeadLoad:
        """Return the dead load with a force in N."""
        return self.dead.plus(self.push, force)

    def slip(self, force: float, side: float = 1.0) -> Slip:
        """Return the slip function under a force in N, for slipping to a side, 1 or −1."""
        joint = LoadedJoint.of(self.design, self.loaded(force))
        left, right = self.tensions
        return Slip(joint, left + right - joint.size, left, right, side)

    def excess(self, force: float, side: float) -> float:
        """Return g in units of r T at the angle under a force in N, for slipping to a side."""
        value: float = self.slip(force, side).value(side * self.bend_angle)
        return value

    def lift(self, force: float) -> float:
        """Return by how much in N the tensions fall short of seating the joint at the angle."""
        needed = self.design.law.seating_tension(*self.loaded(force).at(self.bend_angle))
        return needed - self.total

    def forces_held(self, sides: Sequence[float] = BOTH_SIDES) -> list[Interval]:
        """Return the forces in N with which friction keeps the unit from slipping.

        Parameters
        ----------
        sides : sequence of float
            To which it is not to slip. At its stop it cannot to the side of that.
        """
        ends = [*self.forces_at_lift(), *(f for side in sides for f in self.forces_at_slip(side))]

        def holds(force: float) -> bool:
            return self.lift(force) < 0.0 and all(
                self.excess(force, side) <= 0.0 for side in sides
            )

        return intervals_where(holds, ends, self.total)

    def forces_at_limit(self, side: float) -> list[float]:
        """Return the forces in N at which friction is at its limit against slipping to a side."""
        return [
            force
            for force in self.forces_at_slip(side)
            if self.lift(force) < 0.0 and self._is_at_limit(force, side)
        ]

    def _is_at_limit(self, force: float, side: float) -> bool:
        slip = self.slip(force, side)
        probe = slip.probe(side * self.bend_angle)
        scale = abs(probe[5]) + probe[8][0] + slip.share
        return bool(abs(probe[1]) <= AT_LIMIT * scale)

    def forces_at_slip(self, side: float) -> list[float]:
        """Return the forces in N at which the unit may be about to slip to a side, 1 or −1.

        There may be others among them; see `ContactLaw.forces_at_slip`.
        """
        (at_rest, by_force), axial, (across, across_by) = self._lines
        shares = self.design.law.forces_at_slip(
            (side * at_rest, side * by_force), axial, (side * across, side * across_by)
        )
        return self._near(shares)

    def forces_at_lift(self) -> list[float]:
        """Return the forces in N at which the joint comes off its seat, or on it."""
        _, axial, across = self._lines
        return self._near(self.design.law.forces_at_lift(axial, across))

    def _near(self, shares: Iterable[float]) -> list[float]:
        """Return forces in N from their shares of T, but for those that count as infinite."""
        return [self.total * share for share in shares if abs(share) <= FARTHEST]

    @property
    def _lines(self) -> tuple[Line, Line, Line]:
        """M / (r T), P_a / T and P_t / T towards cable s, by the force in shares of T."""
        angle, total = self.bend_angle, self.total
        axial, across = self.dead.at(angle)
        axial_by, across_by = self.push.at(angle)
        turning = self.push.moment_x * math.cos(angle) - self.push.moment_z * math.sin(angle)
        return (
            (self.slip(0.0).moment_at(angle), turning / self.design.ball_radius),
            (axial / total, axial_by),
            (across / total, across_by),
        )


def intervals_where(
    holds: Callable[[float], bool], ends: Iterable[float], scale: float
) -> list[Interval]:
    """Return where a condition holds that changes at some of the ends alone: closed intervals.

    Parameters
    ----------
    scale : float
        How far beyond the last end it may be looked at.
    """
    found: list[Interval] = []
    for low, high in pairwise([-math.inf, *sorted(set(ends)), math.inf]):
        if holds(_inside(low, high, scale)):
            if found and found[-1][1] == low:
                low = found.pop()[0]
            found.append((low, high))
    return found


def _inside(low: float, high: float, scale: float) -> float:
    """Return a place well inside an interval that may be a ray, or everything."""
    if math.isfinite(low) and math.isfinite(high):
        return 0.5 * (low + high)
    if math.isfinite(high):
        return high - scale - abs(high)
    return low + scale + abs(low) if math.isfinite(low) else 0.0
