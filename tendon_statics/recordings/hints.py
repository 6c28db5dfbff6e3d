"""What in a recording looks as if it were in another unit than it is taken to be in."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..estimation.settings import MANY_WEIGHTS
from ..physics import JointDesign
from ..physics.arm import Arm
from ..tensions.watch import Plausibility
from .arm_recording import ArmRecording
from .recording import Recording
from .session import Floats, Session

_ALL_BELIEVED = Plausibility()

_COUNTS = {2: 'two'}

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
    cables = {'tension_l': recording.tension_l, 'tension_s': recording.tension_s}
    angles = {} if recording.bend_angle is None else {'bend_angle': recording.bend_angle}
    return [
        *_of_angles(angles, [design.max_bend_angle] * len(angles)),
        *_of_tilt(recording),
        *_of_tensions(cables, design.weight, 'the unit', ('cable_l.gain', 'cable_s.gain')),
        *_of_time(recording),
        *_of_clock(recording),
        *_of_spikes(recording, cables, design.weight, believed),
    ]


def arm_hints(
    recording: ArmRecording, arm: Arm, believed: Plausibility = _ALL_BELIEVED
) -> list[str]:
    """Say the same of a recording of an arm."""
    cables, measured = dict(recording.cable_tensions), recording.bend_angles
    angles = {f'bend_angle_{joint}': of for joint, of in measured.items()}
    weight = sum(design.weight for design in arm.designs)
    gains = tuple(f'cables.{name}.gain' for name in cables)
    return [
        *_of_angles(angles, [arm.stops[joint - 1] for joint in measured]),
        *_of_tilt(recording),
        *_of_tensions(cables, weight, 'the arm', gains),
        *_of_time(recording),
        *_of_clock(recording),
        *_of_spikes(recording, cables, weight, believed),
    ]


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


def _of_tensions(
    cables: Mapping[str, Floats], weight: float, whose: str, gains: Sequence[str]
) -> Iterator[str]:
    """Doubt tensions that nothing so heavy has; readings of load cells are not looked at."""
    tensions = np.concatenate([*cables.values()])
    pulled = abs(tensions[np.isfinite(tensions) & (tensions != 0.0)])
    if not len(pulled):
        return
    first, middle = next(iter(cables)), float(np.median(pulled))
    if middle > MANY_WEIGHTS * weight:
        yield (
            f'the tensions, {middle:.4g} N in the middle, are {middle / weight:.3g} times '
            f'the weight of {whose}: if they are mN or gf, say so, {first} [mN] or '
            '--units tension=mN; if they are the counts of an amplifier, the design file has to '
            f'have {", ".join(gains[:-1])} and {gains[-1]}'
        )
        return
    total = np.sum([*cables.values()], axis=0)
    total = total[np.isfinite(total) & (total > 0.0)]
    if len(total) and np.median(total) < 0.1 * weight:
        yield (
            f'the {_COUNTS.get(len(cables), len(cables))} tensions together, '
            f'{np.median(total):.4g} N in the middle, are far below '
            f'the weight of {whose}, {weight:.4g} N: if they are kgf or kN, say so, '
            f'{first} [kgf] or --units tension=kgf'
        )


def _of_spikes(
    recording: Session, cables: Mapping[str, Floats], weight: float, believed: Plausibility
) -> Iterator[str]:
    if believed.max_rate > 0.0 and recording.time is not None:
        return
    for name, values in cables.items():
        believed_ones = np.where(np.array(recording.known_faults) == '', values, math.nan)
        places = _spikes(believed_ones, SPIKE * weight)
        if len(places):
            place = int(places[0])
            yield (
                f'{name} goes from {values[place - 1]:.4g} N to {values[place]:.4g} N and back '
                f'within one sample, {len(places)} times: if the cable does not, set its '
                'max_tension, or max_tension_rate, in the design file (a rate needs times; '
                '--rate HZ makes those of a table), or a tracked unit is put where it is not'
            )


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


def _of_time(recording: Session) -> Iterator[str]:
    if recording.time is None:
        return
    times = recording.time[np.isfinite(recording.time)]
    steps = abs(np.diff(times))
    steps = steps[steps > 0.0]
    if len(steps) < 2:
        return
    step = float(np.median(steps))
    if step > SLOWEST:
        unit = 'ms' if step < 1e4 else 'us' if step < 1e5 else 'ns'
        yield (
            f'there are {step:.4g} s from one sample to the next: if the time is in ms, us or ns, '
            f'say so, time [{unit}] or --units time={unit}'
        )
    if step < FASTEST:
        yield (
            f'there are only {step:.4g} s from one sample to the next: the unit of the time may '
            'be a larger one'
        )


def _of_clock(recording: Session) -> Iterator[str]:
    if recording.unknown_times:
        yield (
            f'{recording.unknown_times}; as it is, gaps are not seen, and no angle of a unit that '
            'is followed is assured'
        )
