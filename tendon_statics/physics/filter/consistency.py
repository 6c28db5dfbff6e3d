"""Whether the model explains the angles that are measured.

Two things speak against a model, its friction coefficient, a load cell or a sign:

- A unit slips where it should not. At a slip the boundary lies between the drive at the angle
  where it rested and that at the angle where it is seen to move; how far beyond, in deviations, is
  the score of the slip. The scores of several slips add up.
- A unit rests where it should slip: how far it is driven beyond the boundary, in deviations.

A unit that rests within the boundary is consistent with most models, and says nothing.
"""

from __future__ import annotations

import math
from collections import deque
from statistics import NormalDist

from ..gradients import slip_by_tensions
from ..slip import Slip

SLIPS = 10
"""Newest slips that are judged together"""

MOVED = 5.0
"""Deviations of the angle from its mean while at rest, above which it has moved"""

AT_REST = 5
"""Readings whose mean, beside that of as many before them, tells whether a unit rests"""

STILL = 2.0
"""Deviations that the two means may differ by"""

_NORMAL = NormalDist()


class Consistency:
    """Judges measured angles by the slip function at the tensions of then.

    Parameters
    ----------
    stop : float
        θ_max in rad.
    lever : float
        (r + δ) / r.
    """

    def __init__(self, stop: float, lever: float) -> None:
        self._stop = stop
        self._lever = lever
        self._scores: deque[float] = deque(maxlen=SLIPS)
        self._overdriven = -math.inf
        self._mean = math.nan
        self._count = 0
        self._newest: deque[float] = deque(maxlen=2 * AT_REST)
        self._moves = False

    @property
    def probability(self) -> float:
        """Probability of readings as bad as the newest under the model; NaN while there are none.

        Of the two kinds the worse, counted twice since there are two.
        """
        if not self._count:
            return math.nan
        together = sum(self._scores) / math.sqrt(max(len(self._scores), 1))
        of_slips = 2.0 * _NORMAL.cdf(-abs(together))
        of_rest = _NORMAL.cdf(-max(self._overdriven, 0.0))
        return min(1.0, 2.0 * min(of_slips, of_rest))

    def take(
        self, bend_angle: float, stddev: float, slip: Slip, errors: tuple[float, float]
    ) -> None:
        """Take an angle that was measured.

        Parameters
        ----------
        bend_angle, stddev : float
            In rad.
        slip : Slip
            Towards cable s, at the tensions of then.
        errors : tuple of float
            Standard errors of T_l and T_s in N.
        """
        if not self._count:
            self._mean, self._count = bend_angle, 1
            return
        change = bend_angle - self._mean
        if abs(change) > MOVED * stddev * math.sqrt(1.0 + 1.0 / self._count):
            if not self._moves:
                self._scores.append(self._slip_score(slip, errors, stddev, bend_angle))
            self._moves = True
            self._mean, self._count, self._overdriven = bend_angle, 1, -math.inf
            self._newest.clear()
            return
        self._count += 1
        self._mean += change / self._count
        self._newest.append(bend_angle)
        if len(self._newest) < 2 * AT_REST:
            return
        # Of the newest alone, since a unit that slides slowly seems to rest where it was.
        newest = list(self._newest)
        before, angle = sum(newest[:AT_REST]) / AT_REST, sum(newest[AT_REST:]) / AT_REST
        rest = stddev / math.sqrt(AT_REST)
        if abs(angle - before) <= STILL * math.sqrt(2.0) * rest:
            self._moves = False
            self._overdriven = max(
                self._excess(slip.facing(side), errors, rest, side * angle)
                for side in (1.0, -1.0)
                if side * angle < self._stop - MOVED * stddev
            )

    def _slip_score(
        self, slip: Slip, errors: tuple[float, float], stddev: float, bend_angle: float
    ) -> float:
        """How far beyond the boundary a slip from the mean to an angle was; 0 if across it."""
        side = math.copysign(1.0, bend_angle - self._mean)
        facing = slip.facing(side)
        ends = [
            self._excess(facing, errors, stddev, side * min(max(angle, -self._stop), self._stop))
            for angle in (self._mean, bend_angle)
        ]
        low, high = min(ends), max(ends)
        return 0.0 if low <= 0.0 <= high else low if low > 0.0 else high

    def _excess(
        self, facing: Slip, errors: tuple[float, float], stddev: float, ahead: float
    ) -> float:
        """The slip function at an angle ahead in rad, in deviations."""
        point = facing.at(ahead)
        behind, in_front = slip_by_tensions(facing, point, self._lever)
        of_behind, of_front = errors if facing.side > 0.0 else errors[::-1]
        deviation = math.hypot(behind * of_behind, in_front * of_front, point.slope * stddev)
        return float(point.excess) / deviation
