"""``estimation: filtering``: with the memory of a `StickSlipFilter`, for load cells with noise."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, Any, TypeVar

from .estimate import Estimate, KnownLoad, Sample
from .filtered_estimate import FilteredEstimate
from .measuring import Measuring
from .method import Method, within_stop
from .settings import Settings

if TYPE_CHECKING:
    from ..physics import FilterState, StickSlipFilter
    from ..physics.filter.lagged import LaggedFilter, Timed

State = TypeVar('State', bound='Timed')

MOST_WAITING = 100_000
"""Samples whose times are kept until they are committed; at 10 kHz those of the longest lag"""

FIRST_STEP = 0.001
"""Time in s between two samples of which nothing is known"""

BEYOND_STOP = 4.0
"""Deviations by which a sensor may read beyond the stop of a unit that is there"""


class Filtering(Method):
    """Follows the unit, and takes each pair of tensions for a noisy reading."""

    remembers = True

    def __init__(self, settings: Settings) -> None:
        super().__init__(settings)
        self._here: FilterState | tuple[float, float] = (settings.initial_bend_angle, 0.0)
        """Where the unit is: as the filter said, or angle and deviation that it was told"""
        self._assured = True
        self._filter = self._new_filter()
        self._clock = ForwardClock()
        self._newest: FilteredEstimate | None = None
        self._waiting = Waiting()

    @classmethod
    def refusal(cls, settings: Settings) -> str:
        """Return why it cannot work with settings: noise is what it is made for."""
        return refused_without_noise(settings)

    def _new_filter(self) -> StickSlipFilter:
        """Return a filter of a unit that is where it was last."""
        from ..physics import StickSlipFilter  # Here, for who only solves needs no NumPy.

        settings, (angle, stddev) = self.settings, self._place
        found = StickSlipFilter(
            settings.design,
            bend_angle=angle,
            bend_angle_stddev=stddev,
            tension_stddev=settings.tension_stddev,
            tension_bias_stddev=settings.tension_bias_stddev,
            design_covariance=settings.design_uncertainty,
            lag=settings.filter_lag,
        )
        if not self._assured:
            found.doubt()
        return found

    @property
    def _place(self) -> tuple[float, float]:
        """Angle in rad and deviation of where the unit is."""
        if isinstance(self._here, tuple):
            return self._here
        assert self._here.bend_angle is not None
        return self._here.bend_angle, float(self._here.members.std())

    def update(self, sample: Sample) -> FilteredEstimate:
        """Follow the unit through a pair of tensions."""
        self._waiting.take_committed(self._filter)  # by the sample before; nobody wanted it
        time = self._clock.time(sample)
        state = self._filter.update(*sample.pair, time, sample.known.load)
        if state.bend_angle is not None:
            self._here = state
            self._waiting.add(time, sample.measured)
        self._assured = state.assured
        self._newest = self._estimate(state, sample.known, sample.measured)
        return self._newest

    def imagine(self, sample: Sample) -> FilteredEstimate:
        """Work out where a pair of tensions would take the unit."""
        state = self._new_filter().update(*sample.pair, 0.0, sample.known.load)
        return self._estimate(state, sample.known, sample.measured)

    def again(self, sample: Sample) -> Estimate:
        """Return the newest estimate, which has the samples before it in it."""
        return self._newest or self.imagine(sample)

    def _estimate(self, state: FilterState, known: KnownLoad, measured: float) -> FilteredEstimate:
        return FilteredEstimate(state, known, self.settings, measured)

    def take_committed(self) -> list[Estimate]:
        """Return the estimates that will not be taken back, each once; tensions are smoothed."""
        return [
            self._estimate(state, KnownLoad(state.load), measured)
            for state, measured in self._waiting.take_committed(self._filter)
        ]

    def change_settings(self, settings: Settings) -> str:
        """Go on with other settings, from where the unit is; the samples before are forgotten."""
        before, self.settings = self.settings, settings
        if _made_of(settings) == _made_of(before):
            return ''
        angle, stddev = self._place
        angle, said = within_stop(angle, settings.design)
        self._here = (angle, stddev)
        self._assured = self._assured and not said
        self._begin_anew(self._new_filter())
        return said

    def doubt(self) -> None:
        """Take it that the unit may have moved unseen."""
        self._filter.doubt()
        self._assured = False
        self._waiting.clear()  # They will not be committed.

    def put(self, bend_angle: float) -> None:
        """Put the unit to an angle in rad."""
        self._filter.reset(bend_angle)
        self._here, self._assured = (bend_angle, 0.0), True
        self._begin_anew(self._filter)

    def measure(self, bend_angle: float) -> None:
        """Take an angle in rad that a sensor says; a little beyond the stop is at the stop."""
        stddev = self.settings.measured_bend_angle_stddev
        stop = self.settings.design.max_bend_angle
        if stop < abs(bend_angle) <= stop + BEYOND_STOP * stddev:
            bend_angle = math.copysign(stop, bend_angle)
        self._filter.measure(bend_angle, stddev)
        if not self._assured or self._place[1] > stddev:
            self._here = (bend_angle, stddev)
        self._assured = True
        self._newest = None

    def _begin_anew(self, found: StickSlipFilter) -> None:
        self._filter = found
        self._newest = None
        self._waiting.clear()


def refused_without_noise(settings: Measuring) -> str:
    """Say why nothing can be filtered with settings, a unit or an arm; empty if it can."""
    if settings.tension_stddev > 0.0:
        return ''
    return (
        f'tension_stddev is {settings.tension_stddev!r}, and estimation is filtering, which '
        'needs the noise of each tension, above 0 N; tracking is for tensions without noise'
    )


class Waiting:
    """Samples that a filter has not committed yet."""

    def __init__(self) -> None:
        self._times: deque[tuple[float, float]] = deque(maxlen=MOST_WAITING)

    def add(self, time: float, measured: float) -> None:
        """Let a sample wait: its time for the filter, and when it was measured, in s."""
        self._times.append((time, measured))

    def clear(self) -> None:
        """Forget those that will not be committed."""
        self._times.clear()

    def take_committed(self, found: LaggedFilter[State, Any]) -> list[tuple[State, float]]:
        """Return the states of samples that wait no longer, with when these were measured."""
        newest, states = found.committed, []
        while newest is not None and self._times and self._times[0][0] <= newest.time:
            time, measured = self._times.popleft()
            state = found.history(time)
            if state is not None and state.time == time:
                states.append((state, measured))
        return states


class ForwardClock:
    """Times of samples for a filter, which only go forward, whatever their stamps do."""

    def __init__(self) -> None:
        self._time = 0.0
        self._step = FIRST_STEP
        self._before = (math.nan, math.nan)

    def time(self, sample: Sample) -> float:
        """Return the time of a sample in s: by its stamp, else by its arrival, else as before."""
        now, measured = sample.time, sample.measured
        now_before, measured_before = self._before
        self._before = (now, measured)
        for step in (measured - measured_before, now - now_before):
            if step > 0.0:
                self._step = step
                break
        self._time += self._step
        return self._time


def _made_of(settings: Settings) -> tuple[Any, ...]:
    """What of the settings a filter is made of, or its samples are."""
    return (
        *(settings.design, settings.design_uncertainty, settings.scales, settings.filter_lag),
        *(settings.tension_stddev, settings.tension_bias_stddev),
    )
