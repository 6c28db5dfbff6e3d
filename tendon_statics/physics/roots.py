"""All angles at which the slip equation changes sign, shown to be all."""

from __future__ import annotations

import math
from itertools import pairwise

from .design import JointDesign
from .equations import normal_force_ratios

BEND_ANGLE_TOLERANCE = 1e-10
"""Width in rad of the bracket at which the bisection ends; the paper's."""

NEGLIGIBLE_WEIGHT = 1e-9
"""Share of the tensions below which the weight moves g too little to determine an angle"""

FLAT_WIDTH = 1e-8
"""Width in rad of an interval in which the rounding of g hides its slope, if it got this narrow"""

MOST_CUTS = 2000
"""Intervals that are halved before the rest is taken as too flat to resolve; a few suffice for
any unit but one made up to be flat"""


class SlipEquation:
    """g(θ) = N_m(θ) − N_f(θ) = 0 for one design and one pair of tensions.

    N_f and N_f / R both grow with sin φ: their derivatives by it are μ W N_f / R and
    μ W N_f (R + B) / R³, and neither is negative. So between two quarter turns of φ, values at
    the ends of an interval bound g and its slope inside, and an interval can be shown to hold
    no root, or one at the most.
    """

    def __init__(self, design: JointDesign, tension_l: float, tension_s: float) -> None:
        self._ratios = normal_force_ratios(design, tension_l, tension_s)
        self._total = tension_l + tension_s
        self._beta = design.contact_centre_angle
        # Slope of N_m by sin θ and factor of the slope of N_f, in units of T.
        weight = design.weight / self._total
        self._moment_gain = (
            weight * design.com_distance / (design.friction_coefficient * design.ball_radius)
        )
        self._friction_weight = design.friction_coefficient * weight

    def residual(self, bend_angle: float) -> float:
        """Return g in N at an angle in rad."""
        moment, force, _ = self._ratios(bend_angle)
        return self._total * (moment - force)

    def slope(self, bend_angle: float) -> float:
        """∂g/∂θ in N/rad; not finite at the kink that N_f has where R = 0."""
        _, force, root = self._ratios(bend_angle)
        return self._total * math.cos(bend_angle) * self._scaled_slope(bend_angle, force, root)

    def brackets(self, low: float, high: float) -> list[tuple[float, float]]:
        """Ascending, disjoint intervals in [low, high] that hold one root each and all together.

        A root at `low` itself comes as ``(low, low)``. Where two roots merge, within about
        1e-7 rad, rounding decides whether they are seen as two or as none.

        Parameters
        ----------
        low, high : float
            Angles in rad, within ±π/2.
        """
        if max(abs(self._moment_gain), self._friction_weight) < NEGLIGIBLE_WEIGHT:
            return []
        knots = self._quarter_turns(low, high)
        ends = [(angle, *self._ratios(angle)) for angle in knots]
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
                    middle = 0.5 * (left[0] + right[0])
                    cut = (middle, *self._ratios(middle))
                    pending += [(left, cut), (cut, right)]
                    cuts += 1
        for cluster in _clusters(unresolved):
            found += _brackets_in(cluster)
        return sorted(found)

    def bisect(self, low: float, high: float) -> tuple[float, int]:
        """Halve a bracket down to `BEND_ANGLE_TOLERANCE`; return the root and the halvings.

        The root is where the chord over the last bracket is zero, which makes it as exact as g.
        """
        ratios = self._ratios
        # The sign at `low`; at `high` g may be zero.
        moment, force, _ = ratios(low)
        rising = moment < force
        iterations = 0
        while high - low > BEND_ANGLE_TOLERANCE:
            middle = 0.5 * (low + high)
            moment, force, _ = ratios(middle)
            if (moment < force) if rising else (moment > force):
                low = middle
            else:
                high = middle
            iterations += 1
        at_low, at_high = self.residual(low), self.residual(high)
        if at_low == at_high:
            return high, iterations
        root = high - at_high * (high - low) / (at_high - at_low)
        return min(max(root, low), high), iterations

    def _quarter_turns(self, low: float, high: float) -> list[float]:
        """`low`, `high` and the angles between at which sin φ, cos φ or cos θ has an extreme."""
        turns = (0.0, -self._beta, 0.5 * math.pi - self._beta, math.pi - self._beta)
        return [low, *sorted(angle for angle in set(turns) if low < angle < high), high]

    def _scaled_slope(self, bend_angle: float, force: float, root: float) -> float:
        """(∂g/∂θ) / (T cos θ): of the slope's sign, with cos φ / cos θ as a factor."""
        return self._moment_gain - self._friction_slope(force, root) * self._direction(bend_angle)

    def _friction_slope(self, force: float, root: float) -> float:
        """μ W N_f / R in units of T: the slope of N_f by sin φ."""
        return self._friction_weight * force / root if root > 0.0 else math.inf

    def _direction(self, bend_angle: float) -> float:
        """Return cos φ / cos θ = cos β − sin β tan θ, which falls with θ."""
        return math.cos(self._beta) - math.sin(self._beta) * math.tan(bend_angle)

    def _is_monotonic(self, left: _Point, right: _Point) -> bool:
        """Whether the slope is shown to keep one sign over an interval."""
        if left[3] == 0.0 or right[3] == 0.0:
            return False
        products = [
            self._friction_slope(force, root) * self._direction(angle)
            for _, _, force, root in (left, right)
            for angle, _, _, _ in (left, right)
        ]
        return max(products) < self._moment_gain or min(products) > self._moment_gain


_Point = tuple[float, float, float, float]
"""Angle, N_m / T, N_f / T and R / T."""
_Interval = tuple[_Point, _Point]


def _clusters(intervals: list[_Interval]) -> list[list[_Point]]:
    """Join intervals that lie close together; return the points of each run, ascending."""
    clusters: list[list[_Point]] = []
    for left, right in sorted(intervals):
        if clusters and left[0] - clusters[-1][-1][0] <= 10.0 * FLAT_WIDTH:
            clusters[-1] += [left, right]
        else:
            clusters.append([left, right])
    return clusters


def _brackets_in(cluster: list[_Point]) -> list[tuple[float, float]]:
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


def _changes_sign(left: _Point, right: _Point) -> bool:
    """Whether g crosses zero after `left`, up to and with `right`."""
    before, after = left[1] - left[2], right[1] - right[2]
    return before < 0.0 <= after or before > 0.0 >= after


def _may_vanish(left: _Point, right: _Point) -> bool:
    """Whether the ranges of N_m and N_f over an interval overlap."""
    return max(left[1], right[1]) >= min(left[2], right[2]) and (
        min(left[1], right[1]) <= max(left[2], right[2])
    )
