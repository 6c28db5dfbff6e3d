"""The slip equation for many pairs of tensions of one design at once, as NumPy arrays.

What `roots` does for one pair, with the same bounds: intervals between quarter turns are cut until
each is shown to hold one root or none. Pairs that take more than a few cuts or steps are marked
as unresolved; they are few, and left to `roots`.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .design import JointDesign
from .equations import NormalForces, weight_excess
from .roots import BEND_ANGLE_TOLERANCE, NEGLIGIBLE_WEIGHT

CUTS = 12
"""How often an interval is halved at the most"""

STEPS = 20
"""Steps towards a root at the most; Newton's method takes six or so"""

STILL = 1e-12
"""Step in tan(θ/2) after which the next is not worth taking"""

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

Points = NDArray[np.float64]
"""Five rows, those of `Point`, with a column for each pair"""


class Brackets(NamedTuple):
    """What is known of the roots of each pair."""

    root_count: NDArray[np.int64]
    low: Floats
    """Lower end of the bracket of the root nearest to 0; infinite where there is none"""
    high: Floats
    slips_at_zero: Flags
    """Whether g(0) > 0"""
    unresolved: Flags


class Roots(NamedTuple):
    """One root of each pair."""

    bend_angle: Floats
    steps: NDArray[np.int64]
    unresolved: Flags


class ArraySlipEquation(NormalForces):
    """`SlipEquation` with one-dimensional arrays for all that depends on the tensions."""

    __slots__ = ()

    @staticmethod
    def _weight_excess(design: JointDesign, tension_l: Any, tension_s: Any) -> Any:
        # Few pairs are so near the weight that they need the exact sum.
        excess = tension_l + tension_s - design.weight
        for index in np.flatnonzero(np.abs(excess) <= 0.01 * design.weight):
            excess[index] = weight_excess(design, float(tension_l[index]), float(tension_s[index]))
        return excess

    def of(self, index: NDArray[Any]) -> ArraySlipEquation:
        """Return the equations of some of the pairs."""
        part = object.__new__(ArraySlipEquation)
        for name in NormalForces.__slots__:
            value = getattr(self, name)
            setattr(part, name, value if name == 'geometry' else value[index])
        return part

    def points(self, bend_angle: Floats) -> Points:
        """Return `point` at an angle of each pair."""
        sin_theta, cos_theta = np.sin(bend_angle), np.cos(bend_angle)
        geometry = self.geometry
        sin_phi = geometry.sine * cos_theta + geometry.cosine * sin_theta
        cos_phi = geometry.cosine * cos_theta - geometry.sine * sin_theta
        below_one = 1.0 - sin_phi
        steep = sin_phi > 0.0
        np.divide(cos_phi * cos_phi, 1.0 + sin_phi, out=below_one, where=steep)
        friction = geometry.friction
        spare = 1.0 - friction + friction * below_one
        return self.points_at(
            (bend_angle, sin_theta, spare, friction * cos_phi, cos_phi / cos_theta)
        )

    def points_at(self, attitude: Any) -> Points:
        """Return `point_at` at one attitude, or one of each pair."""
        angle, sin_theta, spare, slide, direction = attitude
        points = np.empty((5, np.size(self.offset)))
        b = self.excess + self.weight * spare
        lift = spare - self.excess
        root = np.sqrt(lift * lift + self.product * slide * slide)
        points[0] = angle
        points[1] = self.offset + self.gain * sin_theta
        points[2] = self.product / (b + root)
        points[3] = root
        points[4] = direction
        if self.geometry.friction_excess > 0.0:
            np.divide(root - b, self.geometry.friction_excess, out=points[2], where=b <= 0.0)
        return points

    def slopes(self, points: Points) -> tuple[Floats, Floats]:
        """∂N_m/∂θ and ∂N_f/∂θ in N/rad; the latter not finite where R = 0."""
        angle, _, force, root, direction = points
        cosine = np.cos(angle)
        of_force = self.total * self.friction_weight * force / root
        of_force *= direction
        of_force *= cosine
        cosine *= self.geometry.weight_gain
        return cosine, of_force

    def brackets(self, stop: float) -> Brackets:
        """Bracket the roots between 0 and the stop."""
        size = np.size(self.offset)
        count, low, high = np.zeros(size, np.int64), np.full(size, np.inf), np.full(size, np.inf)
        knots = [self.points_at(knot) for knot in self.geometry.knots(0.0, stop)]
        unresolved = knots[0][1] == knots[0][2]
        determined = self.geometry.weight_influence >= NEGLIGIBLE_WEIGHT * self.total
        open_at = [np.flatnonzero(_may_vanish(*ends) & determined) for ends in pairwise(knots)]
        index = np.concatenate(open_at)
        left, right = (
            np.hstack([ends.take(at, axis=1) for ends, at in zip(side, open_at, strict=True)])
            for side in (knots[:-1], knots[1:])
        )
        for _ in range(CUTS):
            if not len(index):
                break
            settled = self.of(index)._are_monotonic(left, right)
            crossing = settled & _change_sign(left, right)
            at, ends = index[crossing], (left[0, crossing], right[0, crossing])
            np.add.at(count, at, 1)
            np.minimum.at(low, at, ends[0])
            nearest = low[at] == ends[0]
            high[at[nearest]] = ends[1][nearest]
            index, left, right = index[~settled], left[:, ~settled], right[:, ~settled]
            middle = self.of(index).points(0.5 * (left[0] + right[0]))
            index = np.concatenate([index, index])
            left, right = np.hstack([left, middle]), np.hstack([middle, right])
            still_open = _may_vanish(left, right)
            index, left, right = index[still_open], left[:, still_open], right[:, still_open]
        unresolved[index] = True
        return Brackets(count, low, high, knots[0][1] > knots[0][2], unresolved)

    def roots(self, low: Floats, high: Floats) -> Roots:
        """Find the root in each bracket, and prove it as the bisection does.

        Newton's method on the quartic, kept within a shrinking bracket, comes close. Then g must
        change sign over a bracket as narrow as the bisection's last, and the root is where its
        chord is zero.
        """
        near, steps = self._newton(low, high)
        angle = 2.0 * np.arctan(near)
        low = np.maximum(angle - 0.5 * BEND_ANGLE_TOLERANCE, low)
        high = np.minimum(angle + 0.5 * BEND_ANGLE_TOLERANCE, high)
        (_, low_moment, low_force, _, _), (_, high_moment, high_force, _, _) = (
            self.points(low),
            self.points(high),
        )
        at_low, at_high = low_moment - low_force, high_moment - high_force
        proven = (at_low * at_high <= 0.0) & (at_low != at_high)
        root = high - at_high * (high - low) / (at_high - at_low)
        return Roots(np.clip(root, low, high), steps, ~proven)

    def _newton(self, low: Floats, high: Floats) -> tuple[Floats, NDArray[np.int64]]:
        """Return tan(θ/2) near the root in each bracket, and the steps taken."""
        c0, c1, c2, c3, c4 = self.quartic()
        low, high = np.tan(0.5 * low), np.tan(0.5 * high)
        sign = np.sign((((c4 * low + c3) * low + c2) * low + c1) * low + c0)
        t = 0.5 * (low + high)
        steps = np.zeros(len(t), np.int64)
        for _ in range(STEPS):
            value = c4 * t + c3
            slope = c4 * t + value
            value = value * t + c2
            slope = slope * t + value
            value = value * t + c1
            slope = slope * t + value
            value = value * t + c0
            below = value * sign > 0.0
            low, high = np.where(below, t, low), np.where(below, high, t)
            ahead = t - value / slope
            inside = (ahead >= low) & (ahead <= high)
            ahead = np.where(inside, ahead, 0.5 * (low + high))
            moving = np.abs(ahead - t) > STILL
            t = ahead
            if not moving.any():
                break
            steps += moving
        return t, steps

    def _are_monotonic(self, left: Points, right: Points) -> Flags:
        """Whether the slope is shown to keep one sign over each interval."""
        _, _, left_force, left_root, left_direction = left
        _, _, right_force, right_root, right_direction = right
        at_left = self.friction_weight * left_force / left_root
        at_right = self.friction_weight * right_force / right_root
        steep, flat = np.maximum(at_left, at_right), np.minimum(at_left, at_right)
        # cos φ / cos θ falls with θ, so the largest product is with the one at the left.
        most = left_direction * np.where(left_direction > 0.0, steep, flat)
        least = right_direction * np.where(right_direction > 0.0, flat, steep)
        smooth = (left_root > 0.0) & (right_root > 0.0)
        flags: Flags = smooth & ((most < self.gain) | (least > self.gain))
        return flags


def _may_vanish(left: Points, right: Points) -> Flags:
    """Whether the ranges of N_m and N_f over each interval overlap."""
    _, left_moment, left_force, _, _ = left
    _, right_moment, right_force, _, _ = right
    above = np.maximum(left_moment, right_moment) >= np.minimum(left_force, right_force)
    below = np.minimum(left_moment, right_moment) <= np.maximum(left_force, right_force)
    flags: Flags = above & below
    return flags


def _change_sign(left: Points, right: Points) -> Flags:
    """Whether g crosses zero after the left end of each interval, up to and with the right."""
    before, after = left[1] - left[2], right[1] - right[2]
    flags: Flags = ((before < 0.0) & (after >= 0.0)) | ((before > 0.0) & (after <= 0.0))
    return flags
