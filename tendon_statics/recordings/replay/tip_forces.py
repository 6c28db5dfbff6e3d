"""What every sample of a recording tells of a force at the tip, beside one that was measured."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from contextlib import suppress
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...estimation.settings import Settings
from ...estimation.tip_force_watch import TipForceWatch
from ...physics import (
    BendAngleError,
    DesignUncertainty,
    Load,
    LoadError,
    TensionError,
    TipForce,
    tip_force,
)
from ...physics.arm import ArmTipForce
from ...physics.load import push_along
from ...physics.tip_force import may_be_at_stop
from ..errors import RecordingError
from ..progress import Progress, unseen
from ..recording import Recording
from ..samples import usable
from ..session import Floats, Session

BEYOND = 5.0
"""Deviations by which noise may put a measured angle beyond a stop"""

SLIPPING = 'slipping'


Row = tuple[float, float, float, bool]
"""Lowest and highest force in N, the probability of a free tip, whether at the limit"""

UNKNOWN: Row = (math.nan, math.nan, math.nan, False)


class TipForces(NamedTuple):
    """What samples tell of the tip force; arrays of one length, NaN where nothing is known."""

    places: NDArray[np.int64]
    """Of the samples in the recording"""
    low: Floats
    """Lowest force in N along the direction, −∞ where it is not bounded"""
    high: Floats
    """Highest, likewise; between the two there may be a gap"""
    probability_free: Floats
    at_limit: NDArray[np.bool_]
    """Whether the unit was slipping, so that friction was at its limit"""
    measured: Floats | None
    """What was measured along the direction, in N; None if nothing was"""
    level: float

    @classmethod
    def of(
        cls,
        places: NDArray[np.int64],
        rows: Sequence[Row],
        measured: Floats | None,
        level: float,
    ) -> TipForces:
        """Return what is known of samples, a row of each."""
        low, high, free, at_limit = np.array(rows, dtype=np.float64).reshape(-1, 4).T
        return cls(places, low, high, free, at_limit > 0.0, measured, level)

    @property
    def known(self) -> NDArray[np.bool_]:
        """Of which samples there is an interval."""
        return ~np.isnan(self.low)

    @property
    def holds_measured(self) -> NDArray[np.bool_] | None:
        """Whether the interval holds what was measured, of those that have both."""
        if self.measured is None:
            return None
        both = self.known & np.isfinite(self.measured)
        measured = self.measured[both]
        return (self.low[both] <= measured) & (measured <= self.high[both])

    def columns(self) -> dict[str, Floats | NDArray[np.bool_]]:
        """Return them by name, for a table of all samples."""
        return {
            'tip_force_low': self.low,
            'tip_force_high': self.high,
            'tip_force_probability_free': self.probability_free,
            'tip_force_at_limit': self.at_limit,
        }


def tip_forces(
    recording: Recording,
    settings: Settings,
    *,
    direction: Sequence[float],
    distance: float,
    load: Load,
    bend_angle_stddev: float,
    design_covariance: DesignUncertainty | None = None,
    level: float = 0.95,
    most: int | None = None,
    progress: Progress = unseen,
) -> TipForces:
    """Ask of every sample that has a measured angle what pushes at the tip.

    A recorded tip force is not taken for known; it is what the answer is held against. Samples
    with the state ``slipping`` are at the limit of friction to the side to which the angle goes
    next; without states those are whose angle moves steadily, as for the node. Next to a stop the
    stop is taken to carry what friction does not.

    Parameters
    ----------
    direction, distance, bend_angle_stddev, design_covariance, level
        As of `tip_force`.
    settings : Settings
        The unit, how it is measured, and what is believed.
    load : Load
        What acts beside the cables and was not recorded.
    most : int, optional
        Samples that are looked at, evenly chosen; by default all.

    Raises
    ------
    RecordingError
        If there is no measured angle: an estimated one takes the force for known.
    LoadError
        If the direction is no unit vector in the plane of bending, or the distance no number.
    """
    if recording.bend_angle is None:
        raise RecordingError(
            'there is no measured bend angle in the data, without which nothing can be told of '
            'a force at the tip: an estimated angle takes it for known'
        )
    x, z, _, _ = push_along(direction, distance)
    design, stop = settings.design, settings.design.max_bend_angle
    measured = measured_along(recording, x, z)
    bare = dataclasses.replace(recording, tip_force_x=None, tip_force_z=None)
    loads = bare.loads(load)
    tensions = usable(bare, settings).tensions()
    sides = _sides(recording, settings, bend_angle_stddev)
    places = chosen_places(recording, most)
    rows = []
    for place in progress(places.tolist(), 'solving'):
        angle = float(recording.bend_angle[place])
        row = UNKNOWN
        if abs(angle) - stop <= BEYOND * bend_angle_stddev:  # never of a NaN
            at_stop = may_be_at_stop(design, angle, bend_angle_stddev)
            try:
                found = tip_force(
                    *(design, *tensions[place]),
                    bend_angle=min(max(angle, -stop), stop),
                    direction=direction,
                    distance=distance,
                    load=loads if isinstance(loads, Load) else loads[place],
                    tension_stddev=settings.tension_stddev,
                    bend_angle_stddev=bend_angle_stddev,
                    design_covariance=design_covariance,
                    level=level,
                    slipping='' if at_stop else sides[place],
                    at_stop=at_stop,
                )
            except (TensionError, LoadError):
                pass
            else:
                row = row_of(found)
        rows.append(row)
    return TipForces.of(places, rows, None if measured is None else measured[places], level)


def chosen_places(recording: Session, most: int | None) -> NDArray[np.int64]:
    """Return the places of samples that are looked at: all, or so many, evenly chosen."""
    count = len(recording) if most is None else min(most, len(recording))
    return np.unique(np.linspace(0, len(recording) - 1, count).round().astype(np.int64))


def row_of(found: TipForce | ArmTipForce) -> Row:
    """Return what is known of one sample."""
    ends = [end for interval in found.intervals for end in interval]
    hull = (min(ends), max(ends)) if ends else (math.nan, math.nan)
    return (*hull, found.probability_free, found.at_limit)


def measured_along(recording: Session, x: float, z: float) -> Floats | None:
    """Return what was measured of the tip force along a direction, in N."""
    parts = [
        (share, values)
        for share, values in ((x, recording.tip_force_x), (z, recording.tip_force_z))
        if values is not None
    ]
    if not parts:
        return None
    along: Floats = np.sum([share * values for share, values in parts], axis=0)
    return along


def _sides(recording: Recording, settings: Settings, bend_angle_stddev: float) -> list[str]:
    """Return towards which cable each sample is slipping, empty of those that are not."""
    sides = [''] * len(recording)
    assert recording.bend_angle is not None
    known = np.flatnonzero(np.isfinite(recording.bend_angle)).tolist()
    angles = recording.bend_angle.tolist()
    if recording.state is not None:
        for place, after in pairwise(known):
            if recording.state[place] == SLIPPING:
                step = angles[after] - angles[place]
                sides[place] = 's' if step > 0.0 else 'l' if step < 0.0 else ''
    elif recording.time is not None and not recording.disorder:
        settings = dataclasses.replace(settings, measured_bend_angle_stddev=bend_angle_stddev)
        watch = TipForceWatch()
        for place in known:
            time = float(recording.time[place])
            with suppress(BendAngleError):
                watch.note_angle(angles[place], time, settings)
                sides[place] = watch.motion(time, settings)
    return sides
