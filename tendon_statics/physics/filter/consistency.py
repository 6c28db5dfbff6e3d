"""Whether the model explains the angles that are measured.

Under the model a unit is never driven beyond the boundary of slip, g ≤ 0, and it is at the
boundary, g = 0, while it slips. How far readings are from that, in deviations, is a score:

- Of a slip there are two. At its onset the boundary was reached where the unit had rested, and not
  passed before; at its landing it is reached where the unit is seen to stop, and not passed. The
  scores of the newest slips are added up, once as they are, since a wrong coefficient of friction
  shows the same to both sides, and once by side, since a bias does not.
- Of a rest, how far the unit is driven beyond the boundary, if it is for a while.

A unit that rests within the boundary is consistent with most models, and says nothing. Readings
are judged by fives, each at the tensions of its own time.
"""

from __future__ import annotations

import math
from collections import deque
from statistics import NormalDist
from typing import NamedTuple

from ..tensions import taut_slip
from .scores import MOVED, Boundary, Group, Reading, Score, together

SLIPS = 10
"""Newest slips that are judged together"""

TOGETHER = 5
"""Readings that are judged as one group"""

SLIDES = 3.0
"""Deviations from one group to the next above which a unit that has slipped slides on"""

SAME_SLIP = 0.5
"""Time in s within which motion to the same side is one slip"""

REST_GROUPS = 4
"""Groups that tell the mean of a rest, and so many in a row tell that it is beyond the boundary"""

STATISTICS = 5
"""Sums of scores of slips, and the score of rest, of which the worst counts"""

_NORMAL = NormalDist()


class _Slipping(NamedTuple):
    """A slip: to which side, its onset and its landing."""

    side: float
    onset: Score
    landing: Score


class Consistency:
    """Judges measured angles by the slip function at the tensions of then.

    Parameters
    ----------
    boundary : Boundary
        Of slip, as far as it is known.
    """

    def __init__(self, boundary: Boundary) -> None:
        self._boundary = boundary
        self._readings: list[Reading] = []
        self._groups: deque[Group] = deque(maxlen=4)
        self._rest: list[Group] = []
        self._slips: deque[_Slipping] = deque(maxlen=SLIPS)
        self._last_motion = -math.inf
        self._driven: deque[float] = deque(maxlen=REST_GROUPS)
        self.probability = math.nan
        """Probability of readings as bad as the newest under the model; NaN while there are none.

        Of several kinds the worst, counted as often as there are kinds."""

    def take(self, reading: Reading) -> None:
        """Take an angle that was measured, later than those before."""
        self._readings.append(reading)
        if len(self._readings) < TOGETHER:
            return
        self._groups.append(Group.of(self._readings))
        self._readings.clear()
        self._judge_rest(self._groups[-1])
        if len(self._groups) > 1:
            self._judge_motion()
        self.probability = min(1.0, STATISTICS * min(self._probabilities()))

    def _probabilities(self) -> list[float]:
        slips = self._slips
        sums = [
            together(scores, signs)
            for scores in ([slip.onset for slip in slips], [slip.landing for slip in slips])
            for signs in ([1.0] * len(slips), [slip.side for slip in slips])
        ]
        driven = min(self._driven) if len(self._driven) == REST_GROUPS else 0.0
        return [2.0 * _NORMAL.cdf(-abs(value)) for value in sums] + [
            _NORMAL.cdf(-max(driven, 0.0))
        ]

    def _judge_rest(self, group: Group) -> None:
        """Hold that a unit is not driven beyond the boundary, unless against a stop."""
        first = group.readings[0]
        slip, _ = taut_slip(self._boundary.design, first.tensions, first.load).driving(group.mean)
        self._driven.append(self._overdriven(group, slip.side).value)

    def _judge_motion(self) -> None:
        """Find out whether the unit has moved, as the newest two groups both say."""
        group, newest = self._groups[-2], self._groups[-1]
        rest = Group.of([one for part in self._rest or [group] for one in part.readings])
        changes = [
            (one.mean - rest.mean) / math.hypot(one.error, rest.error) for one in (group, newest)
        ]
        side = math.copysign(1.0, changes[-1])
        if min(side * change for change in changes) <= MOVED:
            if len(self._rest) < REST_GROUPS:
                self._rest.append(group)
            return
        time = newest.readings[-1].time
        landing = self._landing(newest, side)
        last = self._slips[-1] if self._slips else None
        if last and last.side == side and time - self._last_motion < SAME_SLIP:
            self._slips[-1] = last._replace(landing=landing)
        else:
            self._slips.append(_Slipping(side, self._onset(rest, side), landing))
        self._last_motion = time
        self._rest = [newest]

    def _onset(self, rest: Group, side: float) -> Score:
        """How far beyond the boundary a unit was before it slipped, or short of it until then."""
        readings = [one for group in self._groups for one in group.readings]
        left = [
            side * (one.bend_angle - rest.mean) > MOVED * math.hypot(one.stddev, rest.error)
            for one in readings
        ]
        # A unit that jumps is seen to leave; of one that slides away it is not sure when it left.
        first = left.index(True) if True in left else len(readings) - 1
        before = readings[max(first - 2, 0) : first] if True in left else readings[:TOGETHER]
        if before:
            group = Group.of(before)
            beyond = self._overdriven(group, side)
            if beyond.value > 0.0:
                return beyond
        return self._short(readings[: first + 1], rest, side)

    def _landing(self, group: Group, side: float) -> Score:
        """How far beyond the boundary a unit stops that has slipped, or short of it."""
        if not group.is_steady:
            return Score()
        beyond = self._overdriven(group, side)
        before = self._groups[-2]
        if side * (group.mean - before.mean) > SLIDES * math.hypot(group.error, before.error):
            return beyond  # It is on the boundary all the time.
        readings = [one for part in list(self._groups)[-3:] for one in part.readings]
        return beyond if beyond.value > 0.0 else self._short(readings, group, side)

    def _overdriven(self, group: Group, side: float) -> Score:
        """How far beyond the boundary a group is; nothing against a stop, or while it jumps."""
        spread = MOVED * group.readings[0].stddev
        if (
            not group.is_steady
            or side * group.mean > self._boundary.design.max_bend_angle - spread
        ):
            return Score()
        return self._boundary.score(
            [(one, one.bend_angle) for one in group.readings], side, group.error
        )

    def _short(self, readings: list[Reading], place: Group, side: float) -> Score:
        """How far short of the boundary a unit at a place remains at all of these readings."""
        nearest = max(
            self._boundary.score([(one, place.mean)], side, place.error) for one in readings
        )
        return nearest._replace(value=min(nearest.value, 0.0))
