"""`StickSlipFilter`: where a unit is, from noisy tensions."""

from __future__ import annotations

import bisect
import math
from collections import deque

import numpy as np
from numpy.typing import NDArray

from ..admissible import check_bend_angle
from ..design import JointDesign
from ..design_uncertainty import DesignUncertainty
from ..errors import TensionError
from ..load import UPRIGHT, Load
from ..regime import Regime
from ..tensions import Tensions, check_tensions, taut_slip
from .consistency import Consistency
from .ensemble import Ensemble
from .members import follow
from .recent import RecentSamples, Sample
from .scores import Boundary, Reading
from .smoothing import Estimate
from .state import FilterState

Floats = NDArray[np.float64]

HISTORY = 5000
"""Committed states that are kept"""

SURE = 0.99
"""Probability of a stop from which on the angle is assured by it"""

LOST = 6.0
"""Deviations of a measured angle from all members above which they are where it says"""


class StickSlipFilter:
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
        for name, value, least in (
            ('bend_angle_stddev', bend_angle_stddev, 0.0),
            ('tension_stddev', tension_stddev, 1e-12),
            ('tension_bias_stddev', tension_bias_stddev, 0.0),
            ('lag', lag, 0.0),
        ):
            if not least <= value < math.inf:
                raise ValueError(f'{name} is {value!r}, allowed is {least:g} or more')
        self._design = design
        self._lag = lag
        self._boundary = Boundary(design, tension_bias_stddev, design_covariance)
        self._ensemble = Ensemble(design, tension_bias_stddev, design_covariance, seed)
        self._samples = RecentSamples(tension_stddev)
        self.reset(bend_angle, bend_angle_stddev)

    def reset(self, bend_angle: float, stddev: float = 0.0) -> None:
        """Put the unit to an angle in rad that a homing move has told, with its deviation.

        Raises
        ------
        BendAngleError
            If the angle is not a number or lies beyond the stop; the old one then stays.
        """
        angle = check_bend_angle(self._design, bend_angle)
        self._committed = self._newest = self._ensemble.angles(angle, stddev)
        self._assured = True
        self._consistency = Consistency(self._boundary)
        self._history: deque[FilterState] = deque(maxlen=HISTORY)
        self._forget_samples()

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
            If the time is not later than that before. What was known stays in both cases.
        """
        tensions = check_tensions(tension_l, tension_s)
        last = self._samples.time
        if last is not None and not time > last:
            raise ValueError(f'time is {time!r} s, which is not after {last!r} s')
        if tensions.slack_cable:
            self.doubt()
            return FilterState.slack(self._design, load, time, tensions)
        taut_slip(self._design, tensions, load)
        if last is not None and time - last > self._lag:
            # What was before cannot tell what the tensions are now.
            self._committed = self._newest
            self._forget_samples()
        self._samples.append(tensions, Sample(time, load))
        return self._follow(tensions, self._samples.settled(time - self._lag))

    def _follow(self, tensions: Tensions, settled: int) -> FilterState:
        """Commit the samples that are settled, and follow the newer ones from there."""
        samples, ensemble = self._samples.waiting, self._ensemble
        ages = self._samples.path(settled, self._measured)
        estimate = self._samples.smoothed(ages)
        for row in range(settled):
            self._judge(samples[row], Estimate(*(part[:, row] for part in estimate)))
        # Those up to a measured angle are in what it was committed to.
        first = min(settled, self._measured)
        loads = [samples[-1 - age].load for age in ages[first:]]
        paths = ensemble.tensions(Estimate(*(part[:, first:] for part in estimate)))
        slips = ensemble.slips(paths, loads)
        path = follow(slips, self._committed, ensemble.stop)
        committed = settled - first
        for row in range(committed):
            self._history.append(
                self._state(
                    samples[first + row],
                    Tensions(*estimate.value[:, first + row].tolist()),
                    *(path[row : row + 2], paths[:, row].copy()),
                    estimate.error[:, first + row].copy(),
                    provisional=False,
                )
            )
        self._committed, self._newest = path[committed], path[-1]
        state = self._state(
            *(samples[-1], tensions, path[-2:], paths[:, -1].copy()),
            estimate.error[:, -1].copy(),
            provisional=True,
        )
        for _ in range(settled):
            samples.popleft()
        self._measured -= first
        if not self._assured and state.regime_probabilities[Regime.DRIVEN_TO_STOP] > SURE:
            self._assured = state.assured = True
        self._last = state
        return state

    def _state(
        self,
        sample: Sample,
        tensions: Tensions,
        path: Floats,
        member_tensions: Floats,
        tension_errors: Floats,
        *,
        provisional: bool,
    ) -> FilterState:
        """The state at a sample; `path` is where the members were before it and are at it."""
        return FilterState(
            *(self._design, sample.load, sample.time, tensions),
            angles=path[1].copy(),
            moved=path[1] != path[0],
            ensemble=self._ensemble,
            member_tensions=member_tensions,
            tension_errors=tension_errors,
            provisional=provisional,
            assured=self._assured,
            consistency=self.consistency,
        )

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
        if not 0.0 < stddev < math.inf:
            raise ValueError(f'stddev is {stddev!r} rad, which must be above 0')
        # Each member is drawn to a reading of its own, by what it is worth beside their spread.
        readings = self._ensemble.angles(angle, stddev)
        spread = float(np.std(self._newest))
        farthest = float(np.abs(self._newest - angle).min())
        gain = spread**2 / (spread**2 + stddev**2)
        if not self._assured or farthest > LOST * stddev:
            gain = 1.0
        self._committed = self._newest = self._newest + gain * (readings - self._newest)
        self._assured = True
        waiting = self._samples.waiting
        if waiting:
            waiting[-1].reading = angle, stddev
            self._measured = len(waiting)
            self._history.append(self._last.measured(self._newest))

    def _judge(self, sample: Sample, estimate: Estimate) -> None:
        """Hold the angle that was measured at a sample, if it was, against its tensions."""
        if sample.reading is None:
            return
        tensions = Tensions(*estimate.value.tolist())
        try:
            taut_slip(self._design, tensions, sample.load)
        except TensionError:
            return
        of_l, of_s = estimate.error.tolist()
        self._consistency.take(
            Reading(sample.time, *sample.reading, tensions, (of_l, of_s), sample.load)
        )

    @property
    def consistency(self) -> float:
        """Probability of the newest measured angles under the model; NaN while there are none.

        Low where the model cannot explain them: a wrong friction coefficient, a bias, a sign. A
        unit that rests within the boundary of slip says nothing. Below 1e-9 is an alarm that is
        false less than once in a day at 500 Hz.
        """
        return self._consistency.probability

    @property
    def committed(self) -> FilterState | None:
        """The newest state that will not be taken back; None before there is one."""
        return self._history[-1] if self._history else None

    def history(self, time: float) -> FilterState | None:
        """Return the newest committed state that is not after a time in s, if it is kept."""
        index = bisect.bisect_right(self._history, time, key=lambda state: state.time)
        return self._history[index - 1] if index else None

    def _forget_samples(self) -> None:
        self._samples.forget()
        self._measured = 0  # how many of those waiting there were at the last measured angle
