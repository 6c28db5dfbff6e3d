"""How far readings of the angle are from the boundary of slip, in deviations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ..design import JointDesign
from ..design_gradients import excess_by_design
from ..design_uncertainty import DesignUncertainty
from ..gradients import slip_by_tensions
from ..load import Load
from ..tensions import Tensions, taut_slip

MOVED = 6.0
"""Deviations above which the unit has moved, from a mean at rest or within a group of readings"""


class Reading(NamedTuple):
    """A measured angle, with what is known of the tensions of then."""

    time: float
    bend_angle: float
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
    """One deviation, as a change in N of the tension of the cable ahead"""


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

    def score(
        self, places: Sequence[tuple[Reading, float]], side: float, angle_error: float
    ) -> Score:
        """Return the mean slip function of readings at angles in rad, in deviations."""
        stop, lever = self.design.max_bend_angle, self.design.relative_lever
        excess = noise = bias = slope = ahead = 0.0
        for reading, angle in places:
            slip = taut_slip(self.design, reading.tensions, reading.load, side)
            point = slip.at(min(max(side * angle, -stop), stop))
            by = slip_by_tensions(slip, point, lever)
            of_behind, of_ahead = reading.errors[:: int(side)]
            excess += point.excess
            slope += point.slope
            noise += math.hypot(by[0] * of_behind, by[1] * of_ahead)
            bias += math.hypot(*by)
            ahead += abs(by[1])
        # Tensions of one time have much of their noise in common, so that its mean is no smaller.
        own = noise**2 + (slope * angle_error) ** 2
        shared = (bias * self._bias_stddev) ** 2
        if self._uncertainty is not None and excess**2 > own + shared:
            shared += len(places) ** 2 * self._by_design(*places[-1], side)
        deviation = math.sqrt(own + shared)
        return Score(excess / deviation, shared / deviation**2, deviation / ahead)

    def _by_design(self, reading: Reading, angle: float, side: float) -> float:
        """Variance of the slip function from the design's own."""
        assert self._uncertainty is not None
        stop = self.design.max_bend_angle
        ahead = min(max(side * angle, -stop), stop)

        def excess(design: JointDesign) -> float:
            return float(taut_slip(design, reading.tensions, reading.load, side).value(ahead))

        names, covariance = self._uncertainty.parameters, self._uncertainty.covariance
        slopes = excess_by_design(excess, self.design, names, sum(reading.tensions))
        return sum(
            one * other * variance
            for one, row in zip(slopes, covariance, strict=True)
            for other, variance in zip(slopes, row, strict=True)
        )


def together(scores: Sequence[Score], signs: Sequence[float]) -> float:
    """Return the sum of scores in deviations of it; 0 where there are none."""
    own = sum(1.0 - score.shared for score in scores)
    shared = sum(math.sqrt(score.shared) for score in scores)
    total = sum(sign * score.value for sign, score in zip(signs, scores, strict=True))
    return total / math.sqrt(own + shared**2) if scores else 0.0
