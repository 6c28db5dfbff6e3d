"""`StickSlipFilter`: where a unit is, from noisy tensions."""

from __future__ import annotations

import bisect
import math
from collections import deque
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from ..admissible import check_bend_angle
from ..design import JointDesign
from ..load import UPRIGHT, DeadLoad, Load
from ..state import Regime
from ..tensions import Tensions, check_tensions, taut_slip
from .consistency import Consistency
from .members import follow, slips_of
from .smoothing import REACH, SampleBuffer, Windows
from .state import FilterState

Floats = NDArray[np.float64]

MEMBERS = 17
"""Possible units that are followed; odd, so that the median is one of them"""

PATH = (0.75, 0.5, 0.375, 0.25, 0.18, 0.12, 0.08, 0.05, 0.03, 0.015, 0.0)
"""Places of the provisional path, as shares of the lag before the newest sample"""

CAUTION = 2.0
"""By how much the standard errors are taken for larger, since windows also are a little wrong"""

HISTORY = 5000
"""Committed states that are kept"""

SURE = 0.99
"""Probability of a stop from which on the angle is assured by it"""


@dataclass
class _Sample:
    time: float
    load: Load
    dead: DeadLoad


@dataclass
class _Reading:
    time: float
    bend_angle: float
    stddev: float
    age: int = 0


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
    lag : float
        Time in s after which what was found is committed.
    seed : int
        Of the biases of the members; the same seed gives the same results.

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
        self._stddev = tension_stddev
        self._lag = lag
        random = np.random.default_rng(seed)
        shares = (np.arange(MEMBERS) + 0.5) / MEMBERS
        self._scores = np.array([NormalDist().inv_cdf(share) for share in shares])
        self._other_scores = random.permutation(self._scores)
        self._biases = tension_bias_stddev * np.array(
            [random.permutation(self._scores), random.permutation(self._scores)]
        )
        self._bias_stddev = tension_bias_stddev
        self._windows: dict[tuple[int, tuple[int, ...]], Windows] = {}
        self.reset(bend_angle, bend_angle_stddev)

    def reset(self, bend_angle: float, stddev: float = 0.0) -> None:
        """Put the unit to an angle in rad that a homing move has told, with its deviation.

        Raises
        ------
        BendAngleError
            If the angle is not a number or lies beyond the stop; the old one then stays.
        """
        angle = check_bend_angle(self._design, bend_angle)
        stop = self._design.max_bend_angle
        self._committed = np.clip(angle + stddev * self._other_scores, -stop, stop)
        self._newest = self._committed
        self._assured = True
        self._consistency = Consistency(stop, self._design.relative_lever)
        self._forget_samples()
        self._history: deque[FilterState] = deque(maxlen=HISTORY)

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
        if self._samples and not time > self._samples[-1].time:
            raise ValueError(
                f'time is {time!r} s, which is not after {self._samples[-1].time!r} s'
            )
        if tensions.slack_cable:
            self.doubt()
            return FilterState.slack(self._design, load, time, tensions)
        taut_slip(self._design, tensions, load)
        if self._samples and time - self._samples[-1].time > self._lag:
            # What was before cannot tell what the tensions are now.
            self._committed = self._newest
            self._forget_samples()
        for reading in self._readings:
            reading.age += 1
        kept = max(len(self._samples), self._readings[0].age if self._readings else 0)
        self._buffer.append(tensions, REACH + kept)
        self._samples.append(_Sample(time, load, load.on(self._design)))
        self._judge_readings(time - self._lag, load)
        settled = sum(sample.time <= time - self._lag for sample in self._samples)
        ages = [*range(len(self._samples) - 1, len(self._samples) - 1 - settled, -1)]
        waiting = len(self._samples) - settled
        ages += [age for age in self._path(waiting) if age < waiting]
        return self._follow(tensions, settled, ages)

    @staticmethod
    def _path(waiting: int) -> list[int]:
        """Ages of the places of the provisional path, of so many samples that are not settled."""
        return sorted({round(share * (waiting - 1)) for share in PATH}, reverse=True)

    def _follow(self, tensions: Tensions, settled: int, ages: list[int]) -> FilterState:
        """Commit the samples that are settled, and follow the rest from there."""
        count = min(len(self._buffer), REACH + ages[0])
        windows = self._windows_at(count, tuple(ages))
        estimate = windows.estimate(self._buffer.newest(count), self._stddev)
        errors = estimate.error[:, :, None] * (CAUTION * self._scores)
        paths = estimate.value[:, :, None] + errors * _TOWARDS_S - self._biases[:, None, :]
        slips = slips_of(self._design, self._dead_loads(ages), paths)

        committed, _ = follow(self._design, slips.part(slice(settled)), self._committed)
        newest, moved = follow(self._design, slips.part(slice(settled, None)), committed)
        for _ in range(settled):
            sample = self._samples.popleft()
        if settled:
            self._history.append(
                FilterState(
                    self._design,
                    sample.load,
                    sample.time,
                    Tensions(*estimate.value[:, settled - 1].tolist()),
                    angles=committed,
                    moved=committed != self._committed,
                    slips=slips.part(settled - 1),
                    provisional=False,
                    angle_assured=self._assured,
                )
            )
        self._committed, self._newest = committed, newest
        last = self._samples[-1]
        state = FilterState(
            self._design,
            last.load,
            last.time,
            tensions,
            angles=newest,
            moved=moved,
            slips=slips.part(-1),
            provisional=True,
            angle_assured=self._assured,
        )
        if not self._assured and state.regime_probabilities[Regime.DRIVEN_TO_STOP] > SURE:
            self._assured = state.angle_assured = True
        return state

    def _dead_loads(self, ages: list[int]) -> DeadLoad:
        """The dead loads at samples of these ages; of one shape with their tensions."""
        samples = [self._samples[-1 - age] for age in ages]
        first = samples[0].dead
        if all(sample.dead == first for sample in samples):
            return first
        return DeadLoad(*np.array([sample.dead for sample in samples]).T[:, :, None])

    def _windows_at(self, count: int, ages: tuple[int, ...]) -> Windows:
        """The windows at these ages among so many samples; kept, since they seldom change."""
        windows = self._windows.get((count, ages))
        if windows is None:
            if len(self._windows) > 64:
                self._windows.clear()
            windows = self._windows[count, ages] = Windows(count, np.array(ages))
        return windows

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
        spread = float(np.var(self._newest))
        gain = spread / (spread + stddev * stddev)
        readings = angle + stddev * self._other_scores
        stop = self._design.max_bend_angle
        self._newest = np.clip(self._newest + gain * (readings - self._newest), -stop, stop)
        if not self._assured:
            self._newest = np.clip(readings, -stop, stop)
        self._committed = self._newest
        self._assured = True
        if self._samples:
            self._readings.append(_Reading(self._samples[-1].time, angle, stddev))
        self._samples.clear()

    def _judge_readings(self, until: float, load: Load) -> None:
        """Hold measured angles up to a time in s against tensions that are settled by now."""
        while self._readings and self._readings[0].time <= until:
            reading = self._readings.popleft()
            count = min(len(self._buffer), REACH + reading.age)
            if reading.age >= count:
                continue
            windows = self._windows_at(count, (reading.age,))
            estimate = windows.estimate(self._buffer.newest(count), self._stddev)
            tensions = Tensions(*estimate.value[:, 0].tolist())
            if min(tensions) <= 0.0:
                continue
            errors = np.hypot(CAUTION * estimate.error[:, 0], self._bias_stddev)
            error_l, error_s = errors.tolist()
            self._consistency.take(
                reading.bend_angle,
                reading.stddev,
                taut_slip(self._design, tensions, load),
                (error_l, error_s),
            )

    @property
    def consistency(self) -> float:
        """Probability of the newest measured angles under the model; NaN while there are none.

        Low where the model cannot explain them: a wrong friction coefficient, a bias, a sign. A
        unit that rests within the boundary of slip says nothing.
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
        self._samples: deque[_Sample] = deque()  # those that are not committed
        self._buffer = SampleBuffer(2)
        self._readings: deque[_Reading] = deque()  # that are not judged


_TOWARDS_S = np.array([-1.0, 1.0])[:, None, None]
"""Of the errors of T_l and T_s, so that a member of a higher score is driven more towards s"""
