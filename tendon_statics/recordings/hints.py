"""What in a recording looks wrong: units, spikes, noise, a clock."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..estimation.arm_settings import ArmSettings
from ..estimation.settings import Settings
from ..physics.calibration.sessions import follow_each_other
from .arm_recording import ArmRecording
from .recording import Recording
from .session import Floats, Session
from .spikes import spikes
from .unit_hints import Pulled, of_angles, of_tensions, of_tilt, of_time

SPIKE = 5.0
"""Times the weight by which a spike stands out of the samples around it at least"""

ENOUGH = 20
"""Samples that tell how noisy they are"""

LARGER = 3.0
"""Times the stated noise at which that is doubted"""

SMALL = 0.1
"""Share of a tension below which what changes from sample to sample is noise, and not a list"""

TO_STDDEV = 1.4826
"""Standard deviation of normal values by the median of their absolute deviations"""


def hints(recording: Recording, settings: Settings) -> list[str]:
    """Say what is probably in degrees, millinewtons, counts, milliseconds or the like.

    And what else of a recording is not as the settings say: spikes, unless rates are checked, and
    more noise.
    """
    angles = {} if recording.bend_angle is None else {'bend_angle': recording.bend_angle}
    pulled = Pulled(
        {'tension_l': recording.tension_l, 'tension_s': recording.tension_s},
        *('the unit', 'the design file', ('cable_l.gain', 'cable_s.gain'), settings),
        is_marked='tension_l' in recording.marked,
    )
    stops = [settings.design.max_bend_angle] * len(angles)
    return [
        *of_angles(angles, stops, recording.marked),
        *_of_recording(recording, pulled, are_in_order=bool(follow_each_other(recording))),
    ]


def arm_hints(recording: ArmRecording, settings: ArmSettings) -> list[str]:
    """Say the same of a recording of an arm."""
    cables, measured = dict(recording.cable_tensions), recording.bend_angles
    angles = {f'bend_angle_{joint}': of for joint, of in measured.items()}
    gains = [f'cables.{name}.gain' for name in cables]
    is_marked = bool(recording.marked & cables.keys())
    pulled = Pulled(cables, 'the arm', 'the parameter file', gains, settings, is_marked)
    stops = [settings.arm.stops[joint - 1] for joint in measured]
    return [
        *of_angles(angles, stops, recording.marked),
        *_of_recording(recording, pulled, are_in_order=recording.time is not None),
    ]


def _of_recording(recording: Session, pulled: Pulled, *, are_in_order: bool) -> Iterator[str]:
    yield from of_tilt(recording)
    yield from of_tensions(pulled)
    yield from of_time(recording, pulled.settings.input_timeout)
    yield from _of_clock(recording)
    yield from _of_spikes(recording, pulled)
    if are_in_order:
        yield from _of_noise(recording, pulled)


def _of_spikes(recording: Session, pulled: Pulled) -> Iterator[str]:
    if pulled.settings.plausibility.max_rate > 0.0 and recording.time is not None:
        return
    for (name, values), scale in zip(pulled.cables.items(), pulled.settings.scales, strict=True):
        believed = np.where(np.array(recording.known_faults) == '', values, math.nan)
        # What reads slack moves no unit that is followed.
        lowest = scale.slack_threshold
        there = spikes(believed, SPIKE * pulled.weight, recording.time, lowest)
        if there:
            place, width = there[0]
            within = 'one sample' if width == 1 else f'{width} samples'
            start = values[place - 1 if place else width]
            yield (
                f'{name} goes from {start:.4g} N to {values[place]:.4g} N and back '
                f'within {within}, {len(there)} times: if the cable does not, set its '
                f'max_tension, or max_tension_rate, in {pulled.file} (a rate needs times; '
                '--rate HZ makes those of a table), or a tracked unit is put where it is not'
            )


def _of_noise(recording: Session, pulled: Pulled) -> Iterator[str]:
    """Doubt a stated noise far below that of the data, of samples that follow each other."""
    sound = np.array(recording.known_faults) == ''
    stated, found = pulled.settings.tension_stddev, 0.0
    for values in pulled.cables.values():
        values = values[sound & np.isfinite(values)]
        if len(values) >= ENOUGH:
            noise = _noise(values)
            found = max(found, noise if noise < SMALL * np.median(abs(values)) else 0.0)
    if found > LARGER * stated:
        yield (
            f'the tensions scatter by about {found:.2g} N from one sample to the next, but '
            f'tension_stddev is {stated:g} N: what is said of their noise is too small by '
            f'{found / stated:.2g} times; --tension-stddev or {pulled.file} says it'
        )


def _noise(values: Floats) -> float:
    """Standard deviation of the noise, robustly: ramps and steps are in few second differences."""
    bends = np.diff(values, 2)
    return float(TO_STDDEV * np.median(abs(bends - np.median(bends))) / math.sqrt(6.0))


def _of_clock(recording: Session) -> Iterator[str]:
    if recording.unknown_times:
        yield (
            f'{recording.unknown_times}; as it is, gaps are not seen, and no angle of a unit that '
            'is followed is assured'
        )
