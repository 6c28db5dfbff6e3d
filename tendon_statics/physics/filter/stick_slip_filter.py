"""`StickSlipFilter`: where a unit is, from noisy tensions."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..admissible import check_bend_angle
from ..design import JointDesign
from ..design_uncertainty import DesignUncertainty
from ..errors import TensionError
from ..load import UPRIGHT, Load
from ..tensions import Tensions, check_tensions, taut_slip
from .consistency import Consistency
from .ensemble import Ensemble, MemberSlips
from .lagged import LaggedFilter, check_least, check_stddev, drawn_to
from .recent import Sample
from .scores import Boundary, Reading
from .smoothing import Estimate
from .state import FilterState

Floats = NDArray[np.float64]


class StickSlipFilter(LaggedFilter[FilterState, Floats]):
    """Follows a unit as `StickSlipTracker` does, where each tension is noisy.

    A unit slips at the largest drive so far, and the largest of many noisy readings is always too
    large. So slips are committed only from smoothed tensions, `lag` behind, when samples from
    before and after tell what the tensions were; see `smoothing`. What is newer is provisional: it
    is followed from the committed state anew with every sample, and taken back when more is known.

    What remains unsure is carried by members: possible units, each followed exactly. A member's
    errors of the smoothed tensions, its load cells' bias and its design differ from the nominal
    ones by so many deviations, the same all the time; since stick and slip keeps the order of its
    inputs, the members of the extreme errors enclose what is in between.

    Parameters
    ----------
    design : JointDesign
    bend_angle, bend_angle_stddev : float
        Where the unit is at first in rad, and the standard deviation of that.
    tension_stddev : float
        Standard deviation of the noise of each tension in N, from sample to sample.
    tension_bias_stddev : float
        Standard deviation of the constant error of each tension in N.
    design_covariance : DesignUncertainty, optional
        Of parameters of the design; without it the design is exact.
    lag : float
        Time in s after which what was found is committed.
    seed : int
        Of biases and designs of the members; the same seed gives the same results.

    Raises
    ------
    BendAngleError
        If the angle is not a number or lies beyond the stop.
    ValueError
        If a standard deviation or the lag is not allowed.
    """

    def __init__(
        self,
        design: JointDesign,
        *,
        bend_angle: float = 0.0,
        bend_angle_stddev: float = 0.0,
        tension_stddev: float,
        tension_bias_stddev: float = 0.0,
        design_covariance: DesignUncertainty | None = None,
        lag: float = 0.15,
        seed: int = 0,
    ) -> None:
        check_least('bend_angle_stddev', bend_angle_stddev, 0.0)
        self._design = design
        self._boundary = Boundary(design, tension_bias_stddev, design_covariance)
        self._consistency = Consistency(self._boundary)
        super().__init__(2, tension_stddev, tension_bias_stddev, lag)
        self._ensemble = Ensemble(design, tension_bias_stddev, design_covariance, seed)
        self.reset(bend_angle, bend_angle_stddev)

    def reset(self, bend_angle: float, stddev: float = 0.0) -> None:
        """Put the unit to an angle in rad that a homing move has told, with its deviation.

        Raises
        ------
        BendAngleError
            If the angle is not a number or lies beyond the stop; the old one then stays.
        ValueError
            If the deviation is not a number, or below 0; the old one then stays too.
        """
        angle = check_bend_angle(self._design, bend_angle)
        check_least('stddev', stddev, 0.0)
        self._committed = self._newest = self._ensemble.angles(angle, stddev)
        self._assured = True
        self._consistency = Consistency(self._boundary)
        self._begin_history()

    def doubt(self) -> None:
        """Take it that the unit may have moved unseen, say while no tensions came.

        The angle stays, but is not assured until a stop, a measurement or a reset tells it.
        """
        self._committed = self._newest
        self._assured = False
        self._forget_samples()

    @property
    def design(self) -> JointDesign:
        """The unit's design."""
        return self._design

    def update(
        self, tension_l: float, tension_s: float, time: float, load: Load = UPRIGHT
    ) -> FilterState:
        """Take a new pair of tensions; return where the unit is then, provisionally.

        Parameters
        ----------
        tension_l, tension_s : float
            Cable tensions in N.
        time : float
            When they were measured, in s; later than those before.
        load : Load
            What acts beside them.

        Raises
        ------
        TensionError
            As `solve` does.
        ValueError
            If the time is not finite, or not later than that before. What was known stays in both
            cases.
        """
        tensions = check_tensions(tension_l, tension_s)
        self._check_time(time)
        if tensions.slack_cable:
            self.doubt()
            return FilterState.slack(self._design, load, time, tensions)
        taut_slip(self._design, tensions, load)
        return self._take(tensions, Sample(time, load))

    def _followed(
        self, estimate: Estimate, loads: list[Load], start: Floats
    ) -> tuple[Floats, Sequence[Floats]]:
        paths = self._ensemble.tensions(estimate)
        return paths, self._ensemble.follow(paths, loads, start)

    def _state(
        self,
        sample: Sample,
        tensions: Sequence[float],
        path: Sequence[Floats],
        member_tensions: Floats,
        tension_errors: Floats,
        *,
        provisional: bool,
    ) -> FilterState:
        """The state at a sample; `path` is where the members were before it and are at it."""
        return FilterState(
            *(self._design, sample.load, sample.time, Tensions(*tensions)),
            angles=path[1].copy(),
            moved=path[1] != path[0],
            slips=MemberSlips(self._ensemble, sample.load, member_tensions, tension_errors),
            provisional=provisional,
            assured=self._assured,
            consistency=self.consistency,
        )

    def _take_for_sure(self, state: FilterState) -> None:
        if not self._assured and state.is_told_by_stop:
            self._assured = state.assured = True

    def measure(self, bend_angle: float, stddev: float) -> None:
        """Take what an encoder or a camera says of the angle at the newest sample.

        Parameters
        ----------
        bend_angle, stddev : float
            In rad; the deviation above 0.

        Raises
        ------
        BendAngleError
            If the angle is not a number or lies beyond the stop.
        ValueError
            If the deviation is not a number above 0.
        """
        angle = check_bend_angle(self._design, bend_angle)
        check_stddev(stddev)
        readings = self._ensemble.angles(angle, stddev)
        sample = self._put(drawn_to(readings, self._newest, angle, stddev, assured=self._assured))
        self._assured = True
        if sample is not None:
            sample.reading = angle, stddev
            self._history.append(self._last.measured(self._newest))

    def _judge(self, sample: Sample, estimate: Estimate) -> None:
        """Hold the angle that was measured at a sample, if it was, against its tensions."""
        if sample.reading is None and not self._consistency.has_place:
            return
        tensions = Tensions(*estimate.value.tolist())
        try:
            taut_slip(self._design, tensions, sample.load)
        except TensionError:
            self._consistency.interrupt()
            return
        of_l, of_s = estimate.error.tolist()
        angle, stddev = sample.reading or (math.nan, math.nan)
        self._consistency.take(
            Reading(sample.time, angle, stddev, tensions, (of_l, of_s), sample.load)
        )

    def _forget_samples(self) -> None:
        super()._forget_samples()
        self._consistency.interrupt()

    @property
    def consistency(self) -> float:
        """Probability of the newest measured angles under the model; NaN while there are none.

        Low where the model cannot explain them: a wrong friction coefficient, a bias, a sign. A
        unit that rests within the boundary of slip says nothing. Below 1e-9 is an alarm that is
        false less than once in a day at 500 Hz.
        """
        return self._consistency.probability
