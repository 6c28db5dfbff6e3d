"""All angles at which the slip equation changes sign, shown to be all."""

from __future__ import annotations

import math
from itertools import pairwise

from .equations import NormalForces, Point

BEND_ANGLE_TOLERANCE = 1e-10
"""Width in rad of the bracket at which the bisection ends; the paper's."""

NEGLIGIBLE_WEIGHT = 1e-9
"""Share of the tensions below which the weight moves g too little to determine an angle"""

FLAT_WIDTH = 1e-8
"""Width in rad of an interval in which the rounding of g hides its slope, if it got this narrow"""

MOST_CUTS = 2000
"""Intervals that are halved before the rest is taken as too flat to resolve; a few suffice for
any unit but one made up to be flat"""


class SlipEquation(NormalForces):
    """g(θ) = N_m(θ) − N_f(θ) = 0 for one design and one pair of tensions.

    N_f and N_f / R both grow with sin φ: their derivatives by it are μ W N_f / R and
    μ W N_f (R + B) / R³, and neither is negative. So between two quarter turns of φ, values at
    the ends of an interval bound g and its slope inside, and an interval can be shown to hold
    no root, or one at the most.
    """

    __slots__ = ()

    def residual(self, bend_angle: float) -> float:
        """Return g in N at an angle in rad."""
        return self.residual_at(self.point(bend_angle))

    def residual_at(self, point: Point) -> float:
        """Return g in N."""
        return self.total * (point[1] - point[2])

    def slope(self, bend_angle: float) -> float:
        """∂g/∂θ in N/rad; not finite at the kink that N_f has where R = 0."""
        of_moment, of_force = self.slopes_at(self.point(bend_angle))
        return of_moment - of_force

    def slopes_at(self, point: Point) -> tuple[float, float]:
        """∂N_m/∂θ = W l cos θ / (μ r) and ∂N_f/∂θ = μ W cos φ N_f / R in N/rad.

        The latter is not finite where R = 0.
        """
        angle, _, force, root, direction = point
        cosine = math.cos(angle)
        by_sine = self.friction_weight * force / root if root > 0.0 else math.inf
        return self.geometry.weight_gain * cosine, self.total * by_sine * cosine * direction

    def brackets(self, low: float, high: float) -> list[tuple[float, float]]:
        """Ascending, disjoint intervals in [low, high] that hold one root each and all together.

        A root at `low` itself comes as ``(low, low)``. Where two roots merge, within about
        1e-7 rad, rounding decides whether they are seen as two or as none.

        Parameters
        ----------
        low, high : float
            Angles in rad, within ±π/2.
        """
        if self.geometry.weight_influence < NEGLIGIBLE_WEIGHT * self.total:
            return []
        ends = [self.point_at(knot) for knot in self.geometry.knots(low, high)]
        found = [(low, low)] if ends[0][1] == ends[0][2] else []
        pending = list(pairwise(ends))
        unresolved: list[_Interval] = []
        cuts = 0
        # Level by level, so that at the limit what is left is of one width.
        while pending:
            level, pending = pending, []
            for left, right in level:
                if not _may_vanish(left, right):
                    continue
                if right[0] - left[0] < FLAT_WIDTH or cuts >= MOST_CUTS:
                    unresolved.append((left, right))
                elif self._is_monotonic(left, right):
                    if _changes_sign(left, right):
                        found.append((left[0], right[0]))
                else:
                    cut = self.point(0.5 * (left[0] + right[0]))
                    pending += [(left, cut), (cut, right)]
                    cuts += 1
        if unresolved:
            for cluster in _clusters(unresolved):
                found += _brackets_in(cluster)
        found.sort()
        return found

    def bisect(self, low: float, high: float) -> tuple[float, int]:
        """Halve a bracket down to `BEND_ANGLE_TOLERANCE`; return the root and the halvings.

        What is halved is tan(θ/2), in which a quartic tells the sign of g. The last bracket is
        then tried with g itself; should the quartic's rounding have misled, g is bisected. The
        root is where the chord over the last bracket is zero, which makes it as exact as g.
        """
        last_low, last_high, iterations = self._bisect_quartic(low, high)
        at_low, at_high = self._ratio(last_low), self._ratio(last_high)
        if at_low * at_high > 0.0:
            last_low, last_high, iterations = self._bisect_residual(low, high)
            at_low, at_high = self._ratio(last_low), self._ratio(last_high)
        if at_low == at_high:
            return last_high, iterations
        root = last_high - at_high * (last_high - last_low) / (at_high - at_low)
        return min(max(root, last_low), last_high), iterations

    def _ratio(self, bend_angle: float) -> float:
        """Return g / T at an angle in rad."""
        _, moment, force, _, _ = self.point_at(self.geometry.attitude(bend_angle))
        return moment - force

    def _bisect_quartic(self, low: float, high: float) -> tuple[float, float, int]:
        """Return the last bracket and the halvings; the innermost loop, with no call in it."""
        c0, c1, c2, c3, c4 = self.quartic()
        t_low, t_high = math.tan(0.5 * low), math.tan(0.5 * high)
        if (((c4 * t_low + c3) * t_low + c2) * t_low + c1) * t_low + c0 < 0.0:
            c0, c1, c2, c3, c4 = -c0, -c1, -c2, -c3, -c4
        # dθ/dt is 2 at the most. What frexp returns is the logarithm to base 2, rounded up.
        _, iterations = math.frexp(2.0 * (t_high - t_low) / BEND_ANGLE_TOLERANCE)
        iterations = max(iterations, 0)
        for _ in range(iterations):
            t = 0.5 * (t_low + t_high)
            if (((c4 * t + c3) * t + c2) * t + c1) * t + c0 > 0.0:
                t_low = t
            else:
                t_high = t
        # An end that has not moved stays as it was, to the last bit.
        return max(low, 2.0 * math.atan(t_low)), min(high, 2.0 * math.atan(t_high)), iterations

    def _bisect_residual(self, low: float, high: float) -> tuple[float, float, int]:
        # The sign at `low`; at `high` g may be zero.
        rising = self._ratio(low) < 0.0
        iterations = 0
        while high - low > BEND_ANGLE_TOLERANCE:
            middle = 0.5 * (low + high)
            at_middle = self._ratio(middle)
            if (at_middle < 0.0) if rising else (at_middle > 0.0):
                low = middle
            else:
                high = middle
            iterations += 1
        return low, high, iterations

    def _is_monotonic(self, left: Point, right: Point) -> bool:
        """Whether the slope is shown to keep one sign over an interval.

        The slope's sign is that of (∂g/∂θ) / cos θ, in which cos φ / cos θ falls with θ.
        """
        _, _, left_force, left_root, left_direction = left
        _, _, right_force, right_root, right_direction = right
        if left_root == 0.0 or right_root == 0.0:
            return False
        at_left = self.friction_weight * left_force / left_root
        at_right = self.friction_weight * right_force / right_root
        flat, steep = (at_left, at_right) if at_left < at_right else (at_right, at_left)
        # cos φ / cos θ falls with θ, so the largest product is with the one at the left.
        most = left_direction * (steep if left_direction > 0.0 else flat)
        least = right_direction * (flat if right_direction > 0.0 else steep)
        return most < self.gain or least > self.gain


_Interval = tuple[Point, Point]


def _clusters(intervals: list[_Interval]) -> list[list[Point]]:
    """Join intervals that lie close together; return the points of each run, ascending."""
    clusters: list[list[Point]] = []
    for left, right in sorted(intervals):
        if clusters and left[0] - clusters[-1][-1][0] <= 10.0 * FLAT_WIDTH:
            clusters[-1] += [left, right]
        else:
            clusters.append([left, right])
    return clusters


def _brackets_in(cluster: list[Point]) -> list[tuple[float, float]]:
    """Brackets where g is too flat to tell roots apart, and its sign may be rounding.

    Opposite signs at the two ends are one root. With like signs there are two roots if g is of
    the other sign anywhere between, and none if not.
    """
    first, last = cluster[0], cluster[-1]
    if _changes_sign(first, last):
        return [(first[0], last[0])]
    for point in cluster[1:-1]:
        if _changes_sign(first, point) and _changes_sign(point, last):
            return [(first[0], point[0]), (point[0], last[0])]
    return []


def _changes_sign(left: Point, right: Point) -> bool:
    """Whether g crosses zero after `left`, up to and with `right`."""
    before, after = left[1] - left[2], right[1] - right[2]
    return before < 0.0 <= after or before > 0.0 >= after


def _may_vanish(left: Point, right: Point) -> bool:
    """Whether the ranges of N_m and N_f over an interval overlap."""
    _, left_moment, left_force, _, _ = left
    _, right_moment, right_force, _, _ = right
    if left_moment < left_force:
        return right_moment >= min(left_force, right_force) or left_moment >= right_force
    return min(left_moment, right_moment) <= max(left_force, right_force)
