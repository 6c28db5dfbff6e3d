"""Whether the model explains the angles that are measured.

Under the model a unit is never driven beyond the boundary of slip, g ≤ 0, and it is at the
boundary, g = 0, while it slips. How far readings are from that, in deviations, is a score:

- Of a slip there are two. At its onset the boundary was reached where the unit had rested, and not
  passed before. From then on the unit is on the boundary, until the drive recedes (see `sliding`).
  The scores of the newest slips are added up, once as they are, since a wrong coefficient of
  friction shows the same to both sides, and once by side, since a bias does not.
- Of a rest, how far the unit is driven beyond the boundary, if it is for a while.

A unit that rests within the boundary is consistent with most models, and says nothing. Readings
are judged by fives, each at the tensions of its own time.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from statistics import NormalDist
from typing import NamedTuple

from .scores import MOVED, Boundary, Group, Reading, Score, together
from .sliding import Slide

SLIPS = 10
"""Newest slips that are judged together"""

TOGETHER = 5
"""Readings that are judged as one group"""

SAME_SLIP = 0.5
"""Time in s within which motion to the same side is one slip"""

REST_GROUPS = 4
"""Groups that tell the mean of a rest, and so many in a row tell that it is beyond the boundary"""

STATISTICS = 5
"""Sums of scores of slips, and the score of rest, of which the worst counts"""

_NORMAL = NormalDist()


class _Sample(NamedTuple):
    """A reading, measured or not, with how hard its tensions drive the unit, and to which side."""

    reading: Reading
    side: float
    drive: float
    """Slip function times the sum of the tensions, in N"""

    @property
    def is_measured(self) -> bool:
        return not math.isnan(self.reading.bend_angle)


class _Slipping(NamedTuple):
    """A slip: to which side, its onset, and how the unit slid from there."""

    side: float
    onset: Score
    slide: Slide


class Consistency:
    """Judges measured angles by the slip function at the tensions of then.

    Parameters
    ----------
    boundary : Boundary
        Of slip, as far as it is known.
    """

    def __init__(self, boundary: Boundary) -> None:
        self._boundary = boundary
        self._slips: deque[_Slipping] = deque(maxlen=SLIPS)
        self.probability = math.nan
        """Probability of readings as bad as the newest under the model; NaN while there are none.

        Of several kinds the worst, counted as often as there are kinds."""
        self.interrupt()

    def interrupt(self) -> None:
        """Take it that the unit may have moved unseen; what slips have told stays."""
        self._place = math.nan
        self._readings: list[Reading] = []
        self._newest: list[_Sample] = []
        self._groups: deque[Group] = deque(maxlen=REST_GROUPS)
        self._samples: deque[list[_Sample]] = deque(maxlen=REST_GROUPS)
        self._rest: list[Group] = []
        self._hardest: dict[float, _Sample] = {}
        self._driven: deque[float] = deque(maxlen=REST_GROUPS)
        self._last_motion = -math.inf
        self._slide: Slide | None = None

    @property
    def has_place(self) -> bool:
        """Whether an angle was measured, so that samples without one count too."""
        return not math.isnan(self._place)

    def take(self, reading: Reading) -> None:
        """Take a sample later than those before, whether its angle was measured or not.

        The first has to be measured.
        """
        if not self.has_place:
            self._place = reading.bend_angle
        self._append(reading)
        if self._slide is not None:
            self._slide.take(reading)
        if math.isnan(reading.bend_angle):
            return
        self._readings.append(reading)
        if len(self._readings) < TOGETHER:
            return
        self._close_group()
        self._judge_rest(self._groups[-1])
        if len(self._groups) > 1:
            self._judge_motion()
        self.probability = min(1.0, STATISTICS * min(self._probabilities()))

    def _append(self, reading: Reading) -> None:
        """Keep a sample; between two measured ones the hardest to each side."""
        slip, probe = self._boundary.driving(reading, self._place)
        sample = _Sample(reading, slip.side, probe[1] * slip.total)
        if not sample.is_measured:
            for index in range(len(self._newest) - 1, -1, -1):
                other = self._newest[index]
                if other.is_measured:
                    break
                if other.side == sample.side:
                    self._newest[index] = max(other, sample, key=_drive)
                    return
        self._newest.append(sample)

    def _close_group(self) -> None:
        """Make a group of the newest readings; of the oldest only the hardest drives are kept."""
        if len(self._samples) == REST_GROUPS:
            for sample in self._samples[0]:
                hardest = self._hardest.get(sample.side, sample)
                self._hardest[sample.side] = max(hardest, sample, key=_drive)
        self._groups.append(Group.of(self._readings))
        self._samples.append(self._newest)
        self._place = self._groups[-1].mean
        self._readings, self._newest = [], []

    def _probabilities(self) -> list[float]:
        onsets = [(slip.side, slip.onset) for slip in self._slips]
        slides = [(slip.side, slip.slide.score) for slip in self._slips]
        sums = []
        for found in (onsets, slides):
            told = [(side, score) for side, score in found if score is not None]
            scores = [score for _, score in told]
            sums += [together(scores, [1.0] * len(told)), together(scores, [s for s, _ in told])]
        driven = min(self._driven) if len(self._driven) == REST_GROUPS else 0.0
        return [2.0 * _NORMAL.cdf(-abs(value)) for value in sums] + [
            _NORMAL.cdf(-max(driven, 0.0))
        ]

    def _judge_rest(self, group: Group) -> None:
        """Hold that a unit is not driven beyond the boundary, unless against a stop."""
        slip, _ = self._boundary.driving(group.readings[0], group.mean)
        self._driven.append(self._beyond(group.readings, slip.side).value)

    def _beyond(self, readings: Sequence[Reading], side: float) -> Score:
        """How far beyond the boundary readings are; nothing against a stop, or while it jumps."""
        if any(self._boundary.is_at_stop(one, side) for one in readings):
            return Score()
        if not Group.of(readings).is_steady:
            return Score()
        return self._boundary.score_of(readings, side)

    def _judge_motion(self) -> None:
        """Find out whether the unit has moved, as the newest two groups both say."""
        group, newest = self._groups[-2], self._groups[-1]
        if not self._rest and not group.is_steady:
            self._wait_for_rest()  # It moved within the group, whose mean is no place of rest.
            return
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
        last = self._slips[-1] if self._slips else None
        if not (last and last.side == side and time - self._last_motion < SAME_SLIP):
            self._slips.append(self._slipping(rest, side))
            self._slide = self._slips[-1].slide
        self._last_motion = time
        self._wait_for_rest()

    def _wait_for_rest(self) -> None:
        """Take it that a rest begins with the newest group, unless the unit slides on."""
        newest, samples = self._groups[-1], self._samples[-1]
        self._groups.clear()
        self._samples.clear()
        self._groups.append(newest)
        self._samples.append(samples)
        self._rest, self._hardest = [], {}

    def _slipping(self, rest: Group, side: float) -> _Slipping:
        """Judge where a unit slipped that had rested."""
        samples = [one for part in self._samples for one in part]
        left = [
            one.is_measured
            and side * (one.reading.bend_angle - rest.mean)
            > MOVED * math.hypot(one.reading.stddev, rest.error)
            for one in samples
        ]
        # A unit that jumps is seen to leave; of one that slides away it is not sure when it left.
        is_seen = True in left
        first = left.index(True) if is_seen else len(samples) - 1
        earlier = [*self._hardest.values(), *samples[:first]]
        pushes = [self._boundary.push(one.reading, rest.mean, side)[0] for one in earlier]
        slide = Slide(self._boundary, side, rest.mean, max(pushes, default=-math.inf))
        for one in samples[first:]:
            slide.take(one.reading)
        resting = [index for index in range(first) if samples[index].is_measured]
        last = samples[resting[-1]].reading if resting and is_seen else None
        if last is not None and self._boundary.jumps(last, rest.mean, side):
            between = samples[resting[-1] + 1 : first + 1]
            onset = self._of_jump(last, [one.reading for one in between], rest, side)
            return _Slipping(side, onset, slide)
        onset = Score() if last is None else self._beyond([last], side)
        if not onset.value > 0.0:
            tried = [self._score_at(one.reading, rest, side) for one in (*earlier, samples[first])]
            onset = max(tried)
            onset = onset._replace(value=min(onset.value, 0.0))
        return _Slipping(side, onset, slide)

    def _of_jump(
        self, last: Reading, between: Sequence[Reading], rest: Group, side: float
    ) -> Score:
        """Judge where a unit jumped: at a drive between that of its last reading and the hardest.

        Nothing tells at which of them.
        """
        least = self._score_at(last, rest, side)
        most = max(self._score_at(one, rest, side) for one in between)
        return least.up_to(most.force)

    def _score_at(self, reading: Reading, place: Group, side: float) -> Score:
        """How far beyond the boundary a unit at a place is at the tensions of a reading."""
        found = self._boundary.excess(reading, place.mean, place.error, side)
        return self._boundary.score(found, reading, place.mean, side)


def _drive(sample: _Sample) -> float:
    return sample.drive
