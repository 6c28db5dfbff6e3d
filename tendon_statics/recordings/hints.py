"""What in a recording looks as if it were in another unit than it is taken to be in."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..estimation.arm_settings import ArmSettings
from ..estimation.measuring import Measuring
from ..estimation.settings import MANY_WEIGHTS, Settings
from ..physics.calibration.sessions import follow_each_other
from ..tensions.cable_scale import DEFAULT_MAX_TENSION
from .arm_recording import ArmRecording
from .recording import Recording
from .session import Floats, Session
from .spikes import spikes

BEYOND = 0.2
"""Share of angles beyond the stop above which their unit is doubted: a unit rests against its stop
for a while, but not beyond it"""

SLACK_OF_STOP = 0.05
"""Share of the stop by which a measured angle may lie beyond it"""

SPIKE = 5.0
"""Times the weight by which a spike stands out of the samples around it at least"""

HEAVY = 40.0
"""Times the weight that all cables pull seldom"""

SLOWEST, FASTEST = 2.5, 5e-5
"""s from one sample to the next, in the median"""

LONG = 10
"""Samples of a table that is not a list made by hand"""

_DAYS = (2e4, 8e4)
"""Days since 1900 in which a spreadsheet writes times of today"""

ENOUGH = 20
"""Samples that tell how noisy they are"""

LARGER = 3.0
"""Times the stated noise at which that is doubted"""

SMALL = 0.1
"""Share of a tension below which what changes from sample to sample is noise, and not a list"""

TO_STDDEV = 1.4826
"""Standard deviation of normal values by the median of their absolute deviations"""

_COUNTS = {2: 'two'}


class _Pulled(NamedTuple):
    """What is pulled, and by which cables."""

    cables: Mapping[str, Floats]
    """Name → tensions in N"""
    what: str
    """For people"""
    file: str
    """What has its parameters"""
    gains: Sequence[str]
    """Those parameters that make tensions of counts"""
    settings: Measuring

    @property
    def weight(self) -> float:
        """Weight in N."""
        return self.settings.weight


def hints(recording: Recording, settings: Settings) -> list[str]:
    """Say what is probably in degrees, millinewtons, counts, milliseconds or the like.

    And what else of a recording is not as the settings say: spikes, unless rates are checked, and
    more noise.
    """
    angles = {} if recording.bend_angle is None else {'bend_angle': recording.bend_angle}
    pulled = _Pulled(
        {'tension_l': recording.tension_l, 'tension_s': recording.tension_s},
        *('the unit', 'the design file', ('cable_l.gain', 'cable_s.gain'), settings),
    )
    return [
        *_of_angles(angles, [settings.design.max_bend_angle] * len(angles)),
        *_of_recording(recording, pulled, are_in_order=bool(follow_each_other(recording))),
    ]


def arm_hints(recording: ArmRecording, settings: ArmSettings) -> list[str]:
    """Say the same of a recording of an arm."""
    cables, measured = dict(recording.cable_tensions), recording.bend_angles
    angles = {f'bend_angle_{joint}': of for joint, of in measured.items()}
    gains = [f'cables.{name}.gain' for name in cables]
    pulled = _Pulled(cables, 'the arm', 'the parameter file', gains, settings)
    return [
        *_of_angles(angles, [settings.arm.stops[joint - 1] for joint in measured]),
        *_of_recording(recording, pulled, are_in_order=recording.time is not None),
    ]


def _of_recording(recording: Session, pulled: _Pulled, *, are_in_order: bool) -> Iterator[str]:
    yield from _of_tilt(recording)
    yield from _of_tensions(pulled)
    yield from _of_time(recording, pulled.settings.input_timeout)
    yield from _of_clock(recording)
    yield from _of_spikes(recording, pulled)
    if are_in_order:
        yield from _of_noise(recording, pulled)


def _of_angles(measured: Mapping[str, Floats], stops: Sequence[float]) -> Iterator[str]:
    for (name, values), stop in zip(measured.items(), stops, strict=True):
        angles = abs(values[np.isfinite(values)])
        beyond = angles[angles > (1.0 + SLACK_OF_STOP) * stop]
        if not len(beyond) or len(beyond) < BEYOND * len(angles):
            continue
        of = '' if name == 'bend_angle' else f' of {name}'
        text = (
            f'{100.0 * len(beyond) / len(angles):.3g} % of the measured angles{of} lie beyond the '
            f'stop, {stop:.4g} rad, in the middle by {np.median(beyond) / stop:.3g} times'
        )
        if np.median(beyond) > 2.0 * stop:
            yield (
                f'{text}: if they are degrees, the column has to be named {name} [deg], or say '
                f'--units {name}=deg'
            )
        else:
            yield (
                f'{text}: the design may have too small a max_bend_angle, or the angles a wrong '
                'zero'
            )


def _of_tilt(recording: Session) -> Iterator[str]:
    for name in ('base_tilt', 'base_roll'):
        tilts = getattr(recording, name)
        if tilts is not None and (abs(tilts[np.isfinite(tilts)]) > 2.0 * np.pi).any():
            yield (
                f'{name} is beyond a full turn: if it is in degrees, the column has to be named '
                f'{name} [deg], or say --units {name}=deg'
            )
            return


def _of_tensions(pulled: _Pulled) -> Iterator[str]:
    """Doubt tensions that nothing so heavy has; readings of load cells are not looked at."""
    weight, what, first = pulled.weight, pulled.what, next(iter(pulled.cables))
    tensions = np.stack([*pulled.cables.values()])
    count = _COUNTS.get(len(tensions), len(tensions))
    taut = abs(tensions[np.isfinite(tensions) & (tensions != 0.0)])
    if not len(taut):
        return
    middle = float(np.median(taut))
    if middle > MANY_WEIGHTS * weight:
        yield (
            f'the tensions, {middle:.4g} N in the middle, are {middle / weight:.3g} times '
            f'the weight of {what}: if they are mN or gf, say so, {first} [mN] or '
            f'--units tension=mN; if they are the counts of an amplifier, {pulled.file} has to '
            f'have {" and ".join(pulled.gains)}'
        )
        return
    least, total = (
        _middle(of[np.isfinite(of) & (of > 0.0)])
        for of in (tensions.min(axis=0), tensions.sum(axis=0))
    )
    limits = [scale.max_tension for scale in pulled.settings.scales]
    if least > HEAVY * weight and DEFAULT_MAX_TENSION in limits:
        yield (
            f'even the least of the {count} tensions, {least:.4g} N in the middle, is '
            f'{least / weight:.3g} times the weight of {what}: if they are gf, say so, '
            f'{first} [gf] or --units tension=gf; if they are right, give max_tension of the '
            f'cables in {pulled.file}'
        )
    elif 0.0 < total < 0.1 * weight:
        yield (
            f'the {count} tensions together, {total:.4g} N in the middle, are far below '
            f'the weight of {what}, {weight:.4g} N: if they are kgf or kN, say so, '
            f'{first} [kgf] or --units tension=kgf'
        )


def _middle(values: Floats) -> float:
    """Median of those above 0, if there are any."""
    known = values[np.isfinite(values) & (values > 0.0)]
    return float(np.median(known)) if len(known) else 0.0


def _of_spikes(recording: Session, pulled: _Pulled) -> Iterator[str]:
    if pulled.settings.plausibility.max_rate > 0.0 and recording.time is not None:
        return
    for name, values in pulled.cables.items():
        believed = np.where(np.array(recording.known_faults) == '', values, math.nan)
        there = spikes(believed, SPIKE * pulled.weight, recording.time)
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


def _of_time(recording: Session, timeout: float) -> Iterator[str]:
    if recording.time is None:
        return
    times = recording.time[np.isfinite(recording.time)]
    steps = abs(np.diff(times))
    steps = steps[steps > 0.0]
    if len(steps) < 2:
        return
    step = float(np.median(steps))
    if step > SLOWEST or (step > timeout and len(times) >= LONG):
        unit = 'ms' if step < 1e4 else 'us' if step < 1e5 else 'ns'
        gaps = f', longer than input_timeout, {timeout:g} s, so that each is a gap'
        yield (
            f'there are {step:.4g} s from one sample to the next{gaps * (step > timeout)}: if the '
            f'time is in ms, us or ns, say so, time [{unit}] or --units time={unit}'
        )
    if step < FASTEST:
        first, last = _DAYS
        is_of_days = recording.time_origin == 0 and (first < times).all() and (times < last).all()
        yield (
            f'there are only {step:.4g} s from one sample to the next: the unit of the time may '
            'be a larger one'
            + (', as days of a spreadsheet are: --units time=d says so' if is_of_days else '')
        )


def _of_noise(recording: Session, pulled: _Pulled) -> Iterator[str]:
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
