"""Samples as the estimator takes them: which are believed, and which cables are slack."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, TypeVar

import numpy as np

from ..estimation.estimate import AnyEstimate, KnownLoad
from ..estimation.measuring import Measuring
from ..estimation.reading_estimator import ReadingEstimator
from ..estimation.settings import Settings
from ..physics import Load
from ..physics.tensions import MAX_TENSION
from ..tensions.cable_scale import scaled_arrays
from ..tensions.reason import ReadingError, Reason
from ..tensions.watch import TensionWatch
from .recording import Recording
from .scaling import worse_reasons
from .session import Session

E = TypeVar('E', bound=AnyEstimate)


class Samples:
    """Samples as the estimator takes them, one after the other."""

    def __init__(self, recording: Session, settings: Measuring) -> None:
        self.settings = settings
        self.tensions = recording.tensions()
        self.times = _times(recording)
        self.faults = _faults(recording, settings)
        """Why each holds no tensions, in the node's words; more may be found later on"""
        self._watch = TensionWatch()

    def judged(self, place: int) -> tuple[float, ...]:
        """Return the tensions of a unit's sample, 0 of a slack cable, NaN if not plausible."""
        if not self.faults[place]:
            try:
                return self._watch.take(
                    self.tensions[place],
                    self.times[place][1],
                    self.settings.scales,
                    self.settings.plausibility,
                )
            except ReadingError as error:
                self.faults[place] = error.reason.value
        return math.nan, math.nan

    def followed(
        self, unit: ReadingEstimator[Any, E], loads: Load | list[Load], place: int
    ) -> E | None:
        """Hand a sample to an estimator; return what that says, None if it is not taken."""
        known = KnownLoad(loads if isinstance(loads, Load) else loads[place])
        now, measured = self.times[place]
        fault = self.faults[place]
        if fault:
            unit.drop(Reason(fault), fault)
            return None
        try:
            return unit.take_sample(self.tensions[place], known, now, measured)
        except ReadingError as error:
            self.faults[place] = error.reason.value
            return None


def _times(recording: Session) -> list[tuple[float, float]]:
    """The present at each sample in s, and when it was measured; NaN where that is not known.

    Where a recording has a clock, and a sample no time, there may have been a gap before it. One
    without a clock is taken to have none.
    """
    if recording.time is None:
        return [(math.nan if recording.unknown_times else 0.0, math.nan)] * len(recording)
    return [(time, time) for time in recording.time.tolist()]


def _faults(recording: Session, settings: Measuring) -> list[str]:
    """Why each sample holds no tensions, as far as that is seen of it alone."""
    found = worse_reasons(
        *(
            scaled_arrays(of, scale._replace(gain=1.0, bias=0.0, max_tension=MAX_TENSION))[1]
            for of, scale in zip(recording.cables(), settings.scales, strict=True)
        )
    )
    known = recording.known_faults
    return [before or now for before, now in zip(known, found.tolist(), strict=True)]


def usable(recording: Recording, settings: Settings) -> Recording:
    """Return the recording with 0 N for a slack cable, and NaN where no tension is believed.

    Parameters
    ----------
    settings : Settings
        How the unit is measured and what is believed.
    """
    samples = Samples(recording, settings)
    judged = [samples.judged(place) for place in range(len(recording))]
    tension_l, tension_s = np.array(judged).reshape(-1, 2).T
    return dataclasses.replace(recording, tension_l=tension_l, tension_s=tension_s)
