"""What the filters of a unit and of an arm share: what was found is committed a lag behind."""

from __future__ import annotations

import bisect
import math
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Sequence
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..load import Load
from .recent import RecentSamples, Sample
from .smoothing import Estimate

Floats = NDArray[np.float64]

HISTORY = 5000
"""Committed states that are kept"""

LOST = 6.0
"""Deviations of a measured angle from all members above which they are where it says"""


class Timed(Protocol):
    """A state of a time in s."""

    @property
    def time(self) -> float:
        """In s."""


State = TypeVar('State', bound=Timed)
Place = TypeVar('Place')
"""Where all members are"""


class LaggedFilter(ABC, Generic[State, Place]):
    """Follows members through smoothed tensions: for good a lag behind, provisionally up to now.

    Parameters
    ----------
    signals : int
        How many tensions a sample has.
    tension_stddev : float
        Standard deviation of the noise of each in N, from sample to sample.
    tension_bias_stddev, lag : float
        As the filters have them; here only to be checked.

    Raises
    ------
    ValueError
        If one of the three is not allowed.
    """

    _committed: Place
    _newest: Place
    _last: State

    def __init__(
        self, signals: int, tension_stddev: float, tension_bias_stddev: float, lag: float
    ) -> None:
        check_least('tension_stddev', tension_stddev, 1e-12)
        check_least('tension_bias_stddev', tension_bias_stddev, 0.0)
        check_least('lag', lag, 0.0)
        self._lag = lag
        self._samples = RecentSamples(signals, tension_stddev)
        self._begin_history()

    @abstractmethod
    def _followed(
        self, estimate: Estimate, loads: list[Load], start: Place
    ) -> tuple[Floats, Sequence[Place]]:
        """Follow the members through smoothed tensions, under a load each.

        Returns
        -------
        ndarray, sequence
            The tensions of each member in N, shape ``(signals, pairs, members)``; where the
            members are at first and after each pair.
        """

    @abstractmethod
    def _state(
        self,
        sample: Sample,
        tensions: Sequence[float],
        path: Sequence[Place],
        member_tensions: Floats,
        tension_errors: Floats,
        *,
        provisional: bool,
    ) -> State:
        """Return the state at a sample; `path` is where the members were before and are then."""

    @abstractmethod
    def _take_for_sure(self, state: State) -> None:
        """Take it that the unit is where a stop says, if a state is sure of one."""

    def _judge(self, sample: Sample, estimate: Estimate) -> None:
        """Hold what was measured at a sample against its tensions, when these are settled."""

    def _check_time(self, time: float) -> None:
        """Refuse a time that is not finite, or not after that of the newest sample.

        Raises
        ------
        ValueError
        """
        if not math.isfinite(time):
            raise ValueError(f'time is {time!r} s, which is not a finite number')
        last = self._samples.time
        if last is not None and not time > last:
            raise ValueError(f'time is {time!r} s, which is not after {last!r} s')

    def _take(self, tensions: Sequence[float], sample: Sample) -> State:
        """Take a sample that was checked; return the state there."""
        last = self._samples.time
        if last is not None and sample.time - last > self._lag:
            # What was before cannot tell what the tensions are now.
            self._committed = self._newest
            self._forget_samples()
        self._samples.append(tensions, sample)
        return self._follow(tensions, self._samples.settled(sample.time - self._lag))

    def _follow(self, tensions: Sequence[float], settled: int) -> State:
        """Commit the samples that are settled, and follow the newer ones from there."""
        samples = self._samples.waiting
        ages = self._samples.path(settled, self._measured)
        estimate = self._samples.smoothed(ages)
        for row in range(settled):
            self._judge(samples[row], estimate.part(row))
        # Those up to a measured angle are in what it was committed to.
        first = min(settled, self._measured)
        loads = [samples[-1 - age].load for age in ages[first:]]
        paths, path = self._followed(estimate.part(slice(first, None)), loads, self._committed)
        committed = settled - first
        for row in range(committed):
            self._history.append(
                self._state(
                    samples[first + row],
                    estimate.value[:, first + row].tolist(),
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
        self._take_for_sure(state)
        self._last = state
        return state

    def _put(self, place: Place) -> Sample | None:
        """Put the members where a measurement at the newest sample says; return the sample."""
        self._committed = self._newest = place
        waiting = self._samples.waiting
        self._measured = len(waiting)
        return waiting[-1] if waiting else None

    @property
    def committed(self) -> State | None:
        """The newest state that will not be taken back; None before there is one."""
        return self._history[-1] if self._history else None

    def history(self, time: float) -> State | None:
        """Return the newest committed state that is not after a time in s, if it is kept."""
        newest = self.committed
        if newest is None or newest.time <= time:
            return newest
        index = bisect.bisect_right(self._history, time, key=_time)
        return self._history[index - 1] if index else None

    def _begin_history(self) -> None:
        self._history: deque[State] = deque(maxlen=HISTORY)
        self._forget_samples()

    def _forget_samples(self) -> None:
        self._samples.forget()
        self._measured = 0  # how many of those waiting there were at the last measured angle


def drawn_to(
    readings: Floats, members: Floats, measured: float, stddev: float, *, assured: bool
) -> Floats:
    """Return where members are once an angle was measured: each is drawn to a reading of its own.

    By what it is worth beside their spread; all the way if they are lost.

    Parameters
    ----------
    readings, members : ndarray
        In rad, shape ``(members,)``.
    measured, stddev : float
        In rad.
    assured : bool
        Whether the members were known to be about where they are.
    """
    spread = float(np.std(members))
    farthest = float(np.abs(members - measured).min())
    gain = spread**2 / (spread**2 + stddev**2)
    if not assured or farthest > LOST * stddev:
        gain = 1.0
    found: Floats = members + gain * (readings - members)
    return found


def check_least(name: str, value: float, least: float) -> None:
    """Refuse a number that is less than allowed, or not finite.

    Raises
    ------
    ValueError
    """
    if not least <= value < math.inf:
        raise ValueError(f'{name} is {value!r}, allowed is {least:g} or more')


def check_stddev(stddev: float) -> None:
    """Refuse the deviation of a measured angle unless it is a number above 0.

    Raises
    ------
    ValueError
    """
    if not 0.0 < stddev < math.inf:
        raise ValueError(f'stddev is {stddev!r} rad, which must be above 0')


def _time(state: Timed) -> float:
    return state.time
