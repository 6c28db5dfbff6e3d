"""What in a recording looks as if it were in another unit than it is taken to be in."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..estimation.measuring import Measuring
from ..estimation.settings import MANY_WEIGHTS
from ..tensions.cable_scale import DEFAULT_MAX_TENSION
from .session import Floats, Session

BEYOND = 0.2
"""Share of angles beyond the stop above which their unit is doubted: a unit rests against its stop
for a while, but not beyond it"""

SLACK_OF_STOP = 0.05
"""Share of the stop by which a measured angle may lie beyond it"""

MOST_DEGREES = 2.0 * math.degrees(1.0)
"""Times the stop that angles in degrees are at most, in the middle"""

HEAVY = 40.0
"""Times the weight that all cables pull seldom"""

SLOWEST, FASTEST = 2.5, 5e-5
"""s from one sample to the next, in the median"""

LONG = 10
"""Samples of a table that is not a list made by hand"""

_DAYS = (2e4, 8e4), (7e5, 8e5)
"""Days since 1900 in which a spreadsheet writes times of today, and since year 0 as MATLAB"""

_COUNTS = {2: 'two'}

_SAID = 'the unit that is said of them may be wrong'


class Pulled(NamedTuple):
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
    is_marked: bool
    """Whether the unit of the tensions was said"""

    @property
    def weight(self) -> float:
        """Weight in N."""
        return self.settings.weight


def of_angles(
    measured: Mapping[str, Floats], stops: Sequence[float], marked: Collection[str]
) -> Iterator[str]:
    """Doubt angles of which too many lie beyond the stops in rad."""
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
        other = 'the design may have too small a max_bend_angle, or the angles a wrong zero'
        if name in marked:
            yield f'{text}: {_SAID}, {other}'
        elif np.median(beyond) > 2.0 * stop:
            yield f'{text}: {_unit_of_angles(name, np.median(beyond) / stop)}'
        else:
            yield f'{text}: {other}'


def _unit_of_angles(name: str, times: float) -> str:
    """Say in which unit angles may be that exceed a stop, or full turn, by so many times."""
    units = ('degrees', 'deg'), ('mrad', 'mrad')
    (what, unit), *others = units[int(times > MOST_DEGREES) :]
    return (
        f'if they are {what}, the column has to be named {name} [{unit}], or say '
        f'--units {name}={unit}' + ''.join(f' ({of} likewise)' for _, of in others)
    )


def of_tilt(recording: Session) -> Iterator[str]:
    """Doubt a base that is tilted by more than a full turn."""
    for name in ('base_tilt', 'base_roll'):
        tilts = getattr(recording, name)
        if tilts is None or name in recording.marked:
            continue
        turns = abs(tilts[np.isfinite(tilts)]) / (2.0 * np.pi)
        beyond = turns[turns > 1.0]
        if len(beyond):
            unit = _unit_of_angles(name, np.median(beyond))
            yield f'{name} is beyond a full turn: {unit}'
            return


def of_tensions(pulled: Pulled) -> Iterator[str]:
    """Doubt tensions that nothing so heavy has; readings of load cells are not looked at."""
    weight, what, first = pulled.weight, pulled.what, next(iter(pulled.cables))
    tensions = np.stack([*pulled.cables.values()])
    count = _COUNTS.get(len(tensions), len(tensions))
    taut = abs(tensions[np.isfinite(tensions) & (tensions != 0.0)])
    if not len(taut):
        return
    middle = float(np.median(taut))
    if middle > MANY_WEIGHTS * weight:
        unit = f'if they are mN or gf, say so, {first} [mN] or --units tension=mN'
        yield (
            f'the tensions, {middle:.4g} N in the middle, are {middle / weight:.3g} times '
            f'the weight of {what}: {_SAID if pulled.is_marked else unit}; if they are the counts '
            f'of an amplifier, {pulled.file} has to have {" and ".join(pulled.gains)}'
        )
        return
    least, total = (
        _middle(of[np.isfinite(of) & (of > 0.0)])
        for of in (tensions.min(axis=0), tensions.sum(axis=0))
    )
    limits = [scale.max_tension for scale in pulled.settings.scales]
    if least > HEAVY * weight and DEFAULT_MAX_TENSION in limits:
        unit = f'if they are gf, say so, {first} [gf] or --units tension=gf'
        yield (
            f'even the least of the {count} tensions, {least:.4g} N in the middle, is '
            f'{least / weight:.3g} times the weight of {what}: '
            f'{_SAID if pulled.is_marked else unit}; if they are right, give max_tension of the '
            f'cables in {pulled.file}'
        )
    elif 0.0 < total < 0.1 * weight:
        unit = f'if they are kgf or kN, say so, {first} [kgf] or --units tension=kgf'
        yield (
            f'the {count} tensions together, {total:.4g} N in the middle, are far below '
            f'the weight of {what}, {weight:.4g} N: {_SAID if pulled.is_marked else unit}'
        )


def _middle(values: Floats) -> float:
    """Median of those above 0, if there are any."""
    known = values[np.isfinite(values) & (values > 0.0)]
    return float(np.median(known)) if len(known) else 0.0


def of_time(recording: Session, timeout: float) -> Iterator[str]:
    """Doubt times that are far apart, or hardly."""
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
        is_of_days = recording.time_origin == 0 and any(
            (first < times).all() and (times < last).all() for first, last in _DAYS
        )
        yield (
            f'there are only {step:.4g} s from one sample to the next: the unit of the time may '
            'be a larger one'
            + (
                ', as days of a spreadsheet or of MATLAB are: --units time=d says so'
                if is_of_days
                else ''
            )
        )
