"""What there is to say of a replay in a few numbers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..recording import Recording
from .result import VALID, Replay


class Pace(NamedTuple):
    """How the samples of a recording follow each other in time."""

    rate: float
    """Hz, in the median"""
    duration: float
    """s from the first sample to the last"""
    longest_gap: float
    """s"""


class AngleError(NamedTuple):
    """By how much assured angles differ from measured ones, in rad; None without such a pair."""

    samples: int
    """That have both"""
    root_mean_square: float | None
    median: float | None
    largest: float | None


class Band(NamedTuple):
    """The intervals that are to hold the angle."""

    width: float
    """rad, in the mean"""
    within: float | None
    """Share of the measured angles that lie within, give or take that; None without any"""
    sensor_spread: float
    """rad; two deviations of a measured angle"""


class ReplaySummary(NamedTuple):
    """What the model says of a recording."""

    samples: int
    untimed: int
    """Samples without a time in a recording that has times"""
    pace: Pace | None
    """None without times, or where they go back"""
    regimes: dict[str, int]
    """Samples of each, the most frequent first"""
    invalid: dict[str, int]
    """Invalid samples by their reason, in the node's words, likewise"""
    determined: int
    """Samples with an estimated angle"""
    unsure: int
    """Those of them whose angle is not assured"""
    error: AngleError | None
    """None if no angle was measured"""
    band: Band | None
    """None unless filtered"""
    noise_risks: int
    """Samples at which noise alone could have slipped a tracked unit"""


def summary_of(replay: Replay) -> ReplaySummary:
    """Count and average what a replay says."""
    recording = replay.recording
    known = np.isfinite(replay.bend_angle)
    times = recording.time
    return ReplaySummary(
        len(recording),
        0 if times is None else int((~np.isfinite(times)).sum()),
        _pace(recording),
        _counted(replay.regime),
        _counted(replay.validity[replay.validity != VALID]),
        int(known.sum()),
        int((known & ~replay.angle_assured).sum()),
        _angle_error(replay),
        _band(replay),
        replay.noise_risks,
    )


def _pace(recording: Recording) -> Pace | None:
    if recording.time is None or recording.disorder:
        return None
    steps = np.diff(recording.time[np.isfinite(recording.time)])
    if not len(steps) or not np.median(steps) > 0.0:
        return None
    return Pace(float(1.0 / np.median(steps)), float(steps.sum()), float(steps.max()))


def _counted(words: NDArray[np.str_]) -> dict[str, int]:
    names, counts = np.unique(words, return_counts=True)
    order = np.argsort(-counts, kind='stable').tolist()
    return {str(names[place]): int(counts[place]) for place in order}


def _angle_error(replay: Replay) -> AngleError | None:
    if replay.error is None:
        return None
    error = abs(replay.error[np.isfinite(replay.error)])
    if not len(error):
        return AngleError(0, None, None, None)
    return AngleError(
        len(error),
        float(np.sqrt(np.mean(error**2))),
        float(np.median(error)),
        float(error.max()),
    )


def _band(replay: Replay) -> Band | None:
    if replay.interval is None:
        return None
    low, high = replay.interval
    known = np.isfinite(low)
    if not known.any():
        return None
    measured = replay.recording.bend_angle
    within, spread = None, 2.0 * replay.measured_stddev
    if measured is not None and (both := known & np.isfinite(measured)).any():
        inside = (low - spread <= measured) & (measured <= high + spread)
        within = float(np.mean(inside[both]))
    return Band(float(np.mean((high - low)[known])), within, spread)
