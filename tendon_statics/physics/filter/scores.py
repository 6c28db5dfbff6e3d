"""How far readings of the angle are from the boundary of slip, in deviations."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import NamedTuple

from ..design import JointDesign
from ..design_gradients import excess_by_design
from ..design_uncertainty import DesignUncertainty
from ..gradients import slip_by_tensions
from ..load import Load
from ..slip import Probe, Slip, SlipPoint
from ..tensions import Tensions, taut_slip

MOVED = 6.0
"""Deviations above which the unit has moved, from a mean at rest or within a group of readings"""

MOST = 4.0
"""Deviations at which a score counts in a sum, if it is that or more"""


class Reading(NamedTuple):
    """A measured angle, with what is known of the tensions of then."""

    time: float
    bend_angle: float
    """In rad; NaN where only the tensions were measured"""
    stddev: float
    tensions: Tensions
    errors: tuple[float, float]
    """Standard errors of T_l and T_s in N, from noise"""
    load: Load


class Score(NamedTuple):
    """How far something is from what the model says, in deviations."""

    value: float = 0.0
    shared: float = 0.0
    """Share of the variance that all scores have in common: of bias and design"""
    deviation: float = math.nan
    """One deviation, as a change in N of the tension of the cable ahead; of an onset together with
    what is not seen between two samples"""

    @property
    def force(self) -> float:
        """The score in N of the tension of the cable ahead."""
        return self.value * self.deviation

    def up_to(self, force: float) -> Score:
        """Return the score of something that is anywhere from here to a force in N, as likely."""
        step = force - self.force
        deviation = math.hypot(self.deviation, step / math.sqrt(12.0))
        shared = self.shared * (self.deviation / deviation) ** 2
        return Score((self.force + 0.5 * step) / deviation, shared, deviation)


class Group(NamedTuple):
    """Readings in a row."""

    readings: tuple[Reading, ...]
    mean: float
    error: float
    """Standard error of the mean"""

    @property
    def is_steady(self) -> bool:
        """Whether the unit did not jump in between, so that the mean is a place where it was."""
        angles = [one.bend_angle for one in self.readings]
        return max(angles) - min(angles) <= MOVED * self.readings[0].stddev

    @classmethod
    def of(cls, readings: Sequence[Reading]) -> Group:
        """Return a group of readings."""
        count = len(readings)
        mean = sum(one.bend_angle for one in readings) / count
        square = sum(one.stddev**2 for one in readings)
        return cls(tuple(readings), mean, math.sqrt(square) / count)


class Excess(NamedTuple):
    """The slip function of one reading, or its sum over some, with what its errors come from."""

    value: float
    noise: float
    """Standard deviation from the noise of the tensions, which readings in a row share"""
    bias: float
    """Derivative by the bias of the tensions, per N"""
    angle_variance: float
    """From that of the angle"""
    ahead: float
    """Derivative by the tension of the cable ahead, per N"""
    readings: float = 1.0

    def plus(self, other: Excess) -> Excess:
        """Return the sum of both."""
        return Excess(*(one + more for one, more in zip(self, other, strict=True)))


class Boundary:
    """The boundary of slip of a design, as far as bias and design are known.

    Parameters
    ----------
    design : JointDesign
    bias_stddev : float
        Standard deviation of the constant error of each tension in N.
    uncertainty : DesignUncertainty, optional
        Of the design.
    """

    def __init__(
        self, design: JointDesign, bias_stddev: float, uncertainty: DesignUncertainty | None
    ) -> None:
        self.design = design
        self._bias_stddev = bias_stddev
        self._uncertainty = uncertainty

    def is_at_stop(self, reading: Reading, side: float) -> bool:
        """Whether a unit may lie against a stop, beyond which nothing is seen."""
        return side * reading.bend_angle > self.design.max_bend_angle - MOVED * reading.stddev

    def driving(self, reading: Reading, place: float) -> tuple[Slip, Probe]:
        """Return the slip function to the side to which a reading's tensions drive, and there."""
        stop = self.design.max_bend_angle
        slip = taut_slip(self.design, reading.tensions, reading.load)
        return slip.driving(min(max(place, -stop), stop))

    def push(self, reading: Reading, place: float, side: float) -> tuple[float, float]:
        """Return by how much a reading's tensions drive a unit at a place, and the error, in N."""
        found = self.excess(reading, place, 0.0, side)
        total = sum(reading.tensions)
        return found.value * total, found.noise * total

    def jumps(self, reading: Reading, place: float, side: float) -> bool:
        """Whether a unit that slips to a side does not stop at once: what drives it grows."""
        _, point = self._at(reading, place, side)
        return bool(point.slope > 0.0)

    def excess(self, reading: Reading, angle: float, error: float, side: float) -> Excess:
        """Return the slip function at an angle in rad, which has an error."""
        slip, point = self._at(reading, angle, side)
        by_behind, by_ahead = slip_by_tensions(slip, point, self.design.relative_lever)
        of_behind, of_ahead = reading.errors[:: int(side)]
        return Excess(
            point.excess,
            math.hypot(by_behind * of_behind, by_ahead * of_ahead),
            math.hypot(by_behind, by_ahead),
            (point.slope * error) ** 2,
            abs(by_ahead),
        )

    def _at(self, reading: Reading, angle: float, side: float) -> tuple[Slip, SlipPoint]:
        """Return the slip function to a side, and what it is at an angle in rad."""
        stop = self.design.max_bend_angle
        slip = taut_slip(self.design, reading.tensions, reading.load, side)
        return slip, slip.at(min(max(side * angle, -stop), stop))

    def score(self, found: Excess, reading: Reading, angle: float, side: float) -> Score:
        """Return an excess in deviations; reading and angle are where the design's own is seen."""
        # Tensions of one time have much of their noise in common, so that its mean is no smaller.
        own = found.noise**2 + found.angle_variance
        shared = (found.bias * self._bias_stddev) ** 2
        if self._uncertainty is not None and found.value**2 > own + shared:
            shared += found.readings**2 * self._by_design(reading, angle, side)
        deviation = math.sqrt(own + shared)
        return Score(found.value / deviation, shared / deviation**2, deviation / found.ahead)

    def score_of(self, readings: Sequence[Reading], side: float) -> Score:
        """Return the mean slip function of readings, each at its own angle, in deviations."""
        total = functools.reduce(
            Excess.plus, (self.excess(one, one.bend_angle, one.stddev, side) for one in readings)
        )
        return self.score(total, readings[-1], readings[-1].bend_angle, side)

    def _by_design(self, reading: Reading, angle: float, side: float) -> float:
        """Variance of the slip function from the design's own."""
        assert self._uncertainty is not None
        stop = self.design.max_bend_angle
        ahead = min(max(side * angle, -stop), stop)

        def excess(design: JointDesign) -> float:
            return float(taut_slip(design, reading.tensions, reading.load, side).value(ahead))

        names = self._uncertainty.parameters
        slopes = excess_by_design(excess, self.design, names, sum(reading.tensions))
        return self._uncertainty.variance(dict(zip(names, slopes, strict=True)))


def together(scores: Sequence[Score], signs: Sequence[float]) -> float:
    """Return the sum of scores in deviations of it; 0 where there are none.

    Each counts `MOST` at the most, so that no single slip refutes the model.
    """
    own = sum(1.0 - score.shared for score in scores)
    shared = sum(math.sqrt(score.shared) for score in scores)
    total = sum(
        sign * min(max(score.value, -MOST), MOST)
        for sign, score in zip(signs, scores, strict=True)
    )
    return total / math.sqrt(own + shared**2) if scores else 0.0
