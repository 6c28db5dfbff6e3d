"""What in a recording looks as if it were in another unit than it is taken to be in."""

from __future__ import annotations

import numpy as np

from ..estimation.settings import MANY_WEIGHTS
from ..physics import JointDesign
from .recording import Recording

BEYOND = 0.2
"""Share of angles beyond the stop above which their unit is doubted: a unit rests against its stop
and does not pass it, but for noise"""

SLACK_OF_STOP = 0.05
"""Share of the stop by which noise or a rough drawing may put an angle beyond it"""

SLOWEST, FASTEST = 2.5, 1e-5
"""s from one sample to the next, in the median"""


def hints(recording: Recording, design: JointDesign) -> list[str]:
    """Say what is probably in degrees, millinewtons, counts, milliseconds or the like."""
    return [
        hint
        for hint in (
            _of_angle(recording, design),
            _of_tilt(recording),
            _of_tensions(recording, design),
            _of_time(recording),
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
