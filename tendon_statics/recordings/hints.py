"""What in a recording looks as if it were in another unit than it is taken to be in."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..estimation.settings import MANY_WEIGHTS
from ..physics import JointDesign
from ..tensions.watch import Plausibility
from .recording import Recording
from .session import Floats

_ALL_BELIEVED = Plausibility()

BEYOND = 0.2
"""Share of angles beyond the stop above which their unit is doubted: a unit rests against its stop
and does not pass it, but for noise"""

SLACK_OF_STOP = 0.05
"""Share of the stop by which noise or a rough drawing may put an angle beyond it"""

SPIKE = 5.0
"""Times the unit's weight by which a spike stands out of the samples around it at least"""

STANDS_OUT = 3.0
"""Times the largest other step, likewise"""

AGREE = 0.1
"""Share of a spike's height by which the samples before and after it differ at most"""

SLOWEST, FASTEST = 2.5, 1e-5
"""s from one sample to the next, in the median"""


def hints(
    recording: Recording, design: JointDesign, believed: Plausibility = _ALL_BELIEVED
) -> list[str]:
    """Say what is probably in degrees, millinewtons, counts, milliseconds or the like.

    And where tensions have spikes, unless `believed` has their rate checked.
    """
    return [
        hint
        for hint in (
            _of_angle(recording, design),
            _of_tilt(recording),
            _of_tensions(recording, design),
            _of_time(recording),
            _of_clock(recording),
            *_of_spikes(recording, design, believed),
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


def _of_tensions(recording: Recording, design: JointDesign) -> str:
    """Doubt tensions that no such unit has; readings of load cells are not looked at."""
    tensions = np.concatenate([recording.tension_l, recording.tension_s])
    pulled = abs(tensions[np.isfinite(tensions) & (tensions != 0.0)])
    if not len(pulled):
        return ''
    middle = float(np.median(pulled))
    if middle > MANY_WEIGHTS * design.weight:
        return (
            f'the tensions, {middle:.4g} N in the middle, are {middle / design.weight:.3g} times '
            'the weight of the unit: if they are mN or gf, say so, tension_l [mN] or '
            '--units tension=mN; if they are the counts of an amplifier, the design file has to '
            'have cable_l.gain and cable_s.gain'
        )
    total = recording.tension_l + recording.tension_s
    total = total[np.isfinite(total) & (total > 0.0)]
    if len(total) and np.median(total) < 0.1 * design.weight:
        return (
            f'the two tensions together, {np.median(total):.4g} N in the middle, are far below '
            f'the weight of the unit, {design.weight:.4g} N: if they are kgf or kN, say so, '
            'tension_l [kgf] or --units tension=kgf'
        )
    return ''


def _of_spikes(recording: Recording, design: JointDesign, believed: Plausibility) -> list[str]:
    if believed.max_rate > 0.0 and recording.time is not None:
        return []
    found = []
    for name, values in (('tension_l', recording.tension_l), ('tension_s', recording.tension_s)):
        believed_ones = np.where(np.array(recording.known_faults) == '', values, math.nan)
        places = _spikes(believed_ones, SPIKE * design.weight)
        if len(places):
            place = int(places[0])
            found.append(
                f'{name} goes from {values[place - 1]:.4g} N to {values[place]:.4g} N and back '
                f'within one sample, {len(places)} times: if the cable does not, set its '
                'max_tension, or max_tension_rate, in the design file (a rate needs times; '
                '--rate HZ makes those of a table), or a tracked unit is put where it is not'
            )
    return found


def _spikes(values: Floats, least: float) -> NDArray[np.intp]:
    """Places of single values that stand out of those before and after them; NaN is none."""
    if len(values) < 3:
        return np.array([], dtype=np.intp)
    before, at, after = values[:-2], values[1:-1], values[2:]
    height = np.minimum(at - before, at - after)
    places = np.flatnonzero((height > least) & (abs(after - before) <= AGREE * height)) + 1
    others = np.delete(abs(np.diff(values)), np.concatenate([places - 1, places]))
    others = others[np.isfinite(others)]
    largest = float(others.max()) if len(others) else math.inf
    return places[height[places - 1] > STANDS_OUT * largest]


def _of_time(recording: Recording) -> str:
    if recording.time is None:
        return ''
    times = recording.time[np.isfinite(recording.time)]
    steps = abs(np.diff(times))
    steps = steps[steps > 0.0]
    if len(steps) < 2:
        return ''
    step = float(np.median(steps))
    if step > SLOWEST:
        unit = 'ms' if step < 1e4 else 'us' if step < 1e5 else 'ns'
        return (
            f'there are {step:.4g} s from one sample to the next: if the time is in ms, us or ns, '
            f'say so, time [{unit}] or --units time={unit}'
        )
    if step < FASTEST:
        return (
            f'there are only {step:.4g} s from one sample to the next: the unit of the time may '
            'be a larger one'
        )
    return ''


def _of_clock(recording: Recording) -> str:
    if not recording.unknown_times:
        return ''
    return (
        f'{recording.unknown_times}; as it is, gaps are not seen, and no angle of a unit that is '
        'followed is assured'
    )
