"""What in a recording looks as if it were in another unit than it is taken to be in."""

from __future__ import annotations

import math

import numpy as np

from ..estimation.settings import MANY_WEIGHTS, Settings
from ..physics import JointDesign
from ..physics.calibration.sessions import follow_each_other
from ..tensions.cable_scale import DEFAULT_MAX_TENSION
from .recording import Floats, Recording
from .spikes import spikes

BEYOND = 0.2
"""Share of angles beyond the stop above which their unit is doubted: a unit rests against its stop
and does not pass it, but for noise"""

SLACK_OF_STOP = 0.05
"""Share of the stop by which noise or a rough drawing may put an angle beyond it"""

SPIKE = 5.0
"""Times the unit's weight by which a spike stands out of the samples around it at least"""

HEAVY = 40.0
"""Times the unit's weight that both its cables pull seldom"""

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


def hints(recording: Recording, settings: Settings) -> list[str]:
    """Say what is probably in degrees, millinewtons, counts, milliseconds or the like.

    And what else of a recording is not as the settings say: spikes, unless rates are checked, and
    more noise.
    """
    return [
        hint
        for hint in (
            _of_angle(recording, settings.design),
            _of_tilt(recording),
            _of_tensions(recording, settings),
            _of_time(recording, settings),
            _of_clock(recording),
            *_of_spikes(recording, settings),
            _of_noise(recording, settings),
        )
        if hint
    ]


def _of_angle(recording: Recording, design: JointDesign) -> str:
    if recording.bend_angle is None:
        return ''
    angles = abs(recording.bend_angle[np.isfinite(recording.bend_angle)])
    stop = design.max_bend_angle
    beyond = angles[angles > (1.0 + SLACK_OF_STOP) * stop]
    if not len(beyond) or len(beyond) < BEYOND * len(angles):
        return ''
    text = (
        f'{100.0 * len(beyond) / len(angles):.3g} % of the measured angles lie beyond the stop, '
        f'{stop:.4g} rad, in the middle by {np.median(beyond) / stop:.3g} times'
    )
    if np.median(beyond) > 2.0 * stop:
        return (
            f'{text}: if they are degrees, the column has to be named bend_angle [deg], or say '
            '--units bend_angle=deg'
        )
    return f'{text}: the design may have too small a max_bend_angle, or the angles a wrong zero'


def _of_tilt(recording: Recording) -> str:
    for name in ('base_tilt', 'base_roll'):
        tilts = getattr(recording, name)
        if tilts is not None and (abs(tilts[np.isfinite(tilts)]) > 2.0 * np.pi).any():
            return (
                f'{name} is beyond a full turn: if it is in degrees, the column has to be named '
                f'{name} [deg], or say --units {name}=deg'
            )
    return ''


def _of_tensions(recording: Recording, settings: Settings) -> str:
    """Doubt tensions that no such unit has; readings of load cells are not looked at."""
    weight = settings.design.weight
    tensions = np.stack([recording.tension_l, recording.tension_s])
    pulled = abs(tensions[np.isfinite(tensions) & (tensions != 0.0)])
    if not len(pulled):
        return ''
    middle = float(np.median(pulled))
    if middle > MANY_WEIGHTS * weight:
        return (
            f'the tensions, {middle:.4g} N in the middle, are {middle / weight:.3g} times '
            'the weight of the unit: if they are mN or gf, say so, tension_l [mN] or '
            '--units tension=mN; if they are the counts of an amplifier, the design file has to '
            'have cable_l.gain and cable_s.gain'
        )
    lesser = tensions.min(axis=0)
    lesser = lesser[np.isfinite(lesser) & (lesser > 0.0)]
    least = float(np.median(lesser)) if len(lesser) else 0.0
    limits = (settings.cable_l.max_tension, settings.cable_s.max_tension)
    if least > HEAVY * weight and DEFAULT_MAX_TENSION in limits:
        return (
            f'even the lesser of the two tensions, {least:.4g} N in the middle, is '
            f'{least / weight:.3g} times the weight of the unit: if they are gf, say so, '
            'tension_l [gf] or --units tension=gf; if they are right, give max_tension of the '
            'cables in the design file'
        )
    total = tensions.sum(axis=0)
    total = total[np.isfinite(total) & (total > 0.0)]
    if len(total) and np.median(total) < 0.1 * weight:
        return (
            f'the two tensions together, {np.median(total):.4g} N in the middle, are far below '
            f'the weight of the unit, {weight:.4g} N: if they are kgf or kN, say so, '
            'tension_l [kgf] or --units tension=kgf'
        )
    return ''


def _of_spikes(recording: Recording, settings: Settings) -> list[str]:
    if settings.plausibility.max_rate > 0.0 and recording.time is not None:
        return []
    found = []
    for name, values in (('tension_l', recording.tension_l), ('tension_s', recording.tension_s)):
        believed = np.where(np.array(recording.known_faults) == '', values, math.nan)
        there = spikes(believed, SPIKE * settings.design.weight, recording.time)
        if there:
            place, width = there[0]
            within = 'one sample' if width == 1 else f'{width} samples'
            found.append(
                f'{name} goes from {values[place - 1]:.4g} N to {values[place]:.4g} N and back '
                f'within {within}, {len(there)} times: if the cable does not, set its '
                'max_tension, or max_tension_rate, in the design file (a rate needs times; '
                '--rate HZ makes those of a table), or a tracked unit is put where it is not'
            )
    return found


def _of_time(recording: Recording, settings: Settings) -> str:
    if recording.time is None:
        return ''
    times = recording.time[np.isfinite(recording.time)]
    steps = abs(np.diff(times))
    steps = steps[steps > 0.0]
    if len(steps) < 2:
        return ''
    step, timeout = float(np.median(steps)), settings.input_timeout
    if step > SLOWEST or (step > timeout and len(times) >= LONG):
        unit = 'ms' if step < 1e4 else 'us' if step < 1e5 else 'ns'
        gaps = f', longer than input_timeout, {timeout:g} s, so that each is a gap'
        return (
            f'there are {step:.4g} s from one sample to the next{gaps * (step > timeout)}: if the '
            f'time is in ms, us or ns, say so, time [{unit}] or --units time={unit}'
        )
    if step < FASTEST:
        first, last = _DAYS
        is_of_days = recording.time_origin == 0 and (first < times).all() and (times < last).all()
        return (
            f'there are only {step:.4g} s from one sample to the next: the unit of the time may '
            'be a larger one'
            + (', as days of a spreadsheet are: --units time=d says so' if is_of_days else '')
        )
    return ''


def _of_noise(recording: Recording, settings: Settings) -> str:
    """Doubt a stated noise far below that of the data, if samples follow each other."""
    if len(recording) < ENOUGH or not follow_each_other(recording):
        return ''
    faults = np.array(recording.known_faults) == ''
    stated, found = settings.tension_stddev, 0.0
    for values in (recording.tension_l, recording.tension_s):
        values = values[faults & np.isfinite(values)]
        noise = _noise(values)
        if len(values) >= ENOUGH and noise < SMALL * np.median(abs(values)):
            found = max(found, noise)
    if not found > LARGER * stated:
        return ''
    return (
        f'the tensions scatter by about {found:.2g} N from one sample to the next, but '
        f'tension_stddev is {stated:g} N: what is said of their noise is too small by '
        f'{found / stated:.2g} times; --tension-stddev or the design file says it'
    )


def _noise(values: Floats) -> float:
    """Standard deviation of the noise, robustly: ramps and steps are in few second differences."""
    if len(values) < ENOUGH:
        return 0.0
    bends = np.diff(values, 2)
    return float(TO_STDDEV * np.median(abs(bends - np.median(bends))) / math.sqrt(6.0))


def _of_clock(recording: Recording) -> str:
    if not recording.unknown_times:
        return ''
    return (
        f'{recording.unknown_times}; as it is, gaps are not seen, and no angle of a unit that is '
        'followed is assured'
    )
