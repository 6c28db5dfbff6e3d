"""Every sample of a recording through the model, as the node would have said it."""

from __future__ import annotations

import dataclasses
import itertools
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...physics import (
    UPRIGHT,
    Equilibrium,
    JointDesign,
    Load,
    StickSlipTracker,
    TensionError,
)
from ...physics.admissible import check_bend_angle
from ...physics.batch import solve_batch
from ...physics.tensions import MAX_TENSION
from ...tensions.cable_scale import CableScale, scaled_arrays
from ...tensions.reason import Reason
from ..progress import Progress, unseen
from ..reading.columns import READINGS
from ..recording import OF_LOAD, Floats, Recording
from ..scaling import usable, worse_reasons

CHUNK = 20_000
"""Samples solved at once, after which progress is shown"""

VALID = 'valid'

INVALID = 'invalid'
"""Regime of a sample that the model does not take"""


class Replay(NamedTuple):
    """What the model says of each sample; arrays of shape ``(n,)``, NaN where not determined."""

    recording: Recording
    load: Load
    """What acts beside the cables, as far as it was not recorded"""
    estimation: str
    regime: NDArray[np.str_]
    bend_angle: Floats
    """rad"""
    bend_angle_stddev: Floats
    pressure: Floats
    """Pa"""
    pressure_stddev: Floats
    slip_margin: Floats
    angle_assured: NDArray[np.bool_]
    """False where a cable has been slack, until a stop: a tracked unit may have moved"""
    validity: NDArray[np.str_]
    """``valid``, or why a sample is not, in the node's words (`Reason`)"""

    @property
    def error(self) -> Floats | None:
        """Estimated less measured angle in rad, where both are there and the angle is assured."""
        if self.recording.bend_angle is None:
            return None
        error: Floats = np.where(
            self.angle_assured, self.bend_angle - self.recording.bend_angle, math.nan
        )
        return error

    def columns(self) -> dict[str, Floats | NDArray[np.str_] | NDArray[np.bool_]]:
        """Table with the recorded columns and the estimated ones, by name; SI units."""
        recorded = self.recording
        columns = {
            name: values
            for name, values in (
                ('time', recorded.time),
                ('tension_l', recorded.tension_l),
                ('tension_s', recorded.tension_s),
                *zip(READINGS, recorded.readings or (None, None), strict=True),
                ('bend_angle', recorded.bend_angle),
                ('pressure', recorded.pressure),
                *((name, getattr(recorded, name)) for name in OF_LOAD),
                ('state', None if recorded.state is None else np.array(recorded.state)),
            )
            if values is not None
        }
        return columns | {
            'regime': self.regime,
            'estimated_bend_angle': self.bend_angle,
            'estimated_bend_angle_stddev': self.bend_angle_stddev,
            'estimated_pressure': self.pressure,
            'estimated_pressure_stddev': self.pressure_stddev,
            'slip_margin': self.slip_margin,
            'angle_assured': self.angle_assured,
            'validity': self.validity,
        }


def replay(
    design: JointDesign,
    recording: Recording,
    estimation: str = 'equilibrium',
    *,
    load: Load = UPRIGHT,
    initial_bend_angle: float = 0.0,
    tension_stddev: float = 0.01,
    progress: Progress = unseen,
) -> Replay:
    """Estimate every sample of a recording.

    Parameters
    ----------
    estimation : str
        ``equilibrium``: each sample by itself, as `solve` does; ``tracking``: with the memory of a
        `StickSlipTracker`.
    load : Load
        What acts beside the cables; what was recorded of it comes first.
    initial_bend_angle : float
        Where a tracked unit is at first, in rad.
    tension_stddev : float
        Standard deviation of each tension in N.
    progress : callable
        A `Progress`, to show how far the solving is.

    Raises
    ------
    BendAngleError
        If the initial angle is not a number or lies beyond the stop.
    RecordingError
        If a unit is to be tracked through a recording in which time goes back.
    TensionError
        If the deviation is not finite and above 0.
    """
    if not 0.0 < tension_stddev < math.inf:
        raise TensionError(
            f'tension_stddev is {tension_stddev!r} N, allowed is a finite number above 0'
        )
    check_bend_angle(design, initial_bend_angle)
    faults = _faults(recording)
    given = recording
    recording = usable(dataclasses.replace(recording, faults=faults))
    loads = recording.loads(load)
    starts = progress(range(0, len(recording), CHUNK), 'solving')
    if estimation == 'equilibrium':
        parts = [_solved(design, recording, loads, start, tension_stddev) for start in starts]
    else:
        recording.in_order()
        tracker = StickSlipTracker(design, initial_bend_angle)
        parts = [_tracked(tracker, recording, loads, start, tension_stddev) for start in starts]
    regime, numbers, assured = zip(*parts, strict=True)
    angle, angle_stddev, pressure, pressure_stddev, margin = np.concatenate(numbers, axis=1)
    regimes = np.concatenate(regime)
    faults = [
        fault or (Reason.BELOW_WEIGHT.value if name == INVALID else VALID)
        for fault, name in zip(faults, regimes.tolist(), strict=True)
    ]
    return Replay(
        given,
        load,
        estimation,
        regimes,
        angle,
        angle_stddev,
        pressure,
        pressure_stddev,
        margin,
        np.concatenate(assured),
        np.array(faults, dtype=np.str_),
    )


def _faults(recording: Recording) -> list[str]:
    """Why each sample is no pair of tensions, as far as that is seen without a design."""
    limits = CableScale(max_tension=MAX_TENSION)
    found = worse_reasons(
        *(scaled_arrays(of, limits)[1] for of in (recording.tension_l, recording.tension_s))
    )
    known = recording.known_faults
    return [before or now for before, now in zip(known, found.tolist(), strict=True)]


_Part = tuple[NDArray[np.str_], Floats, NDArray[np.bool_]]
"""Regimes, the five numbers of each sample in rows, and whether the angle is assured"""


def _solved(
    design: JointDesign,
    recording: Recording,
    loads: Load | list[Load],
    start: int,
    tension_stddev: float,
) -> _Part:
    part = slice(start, start + CHUNK)
    of_part = loads if isinstance(loads, Load) else loads[part]
    answers = solve_batch(design, recording.tension_l[part], recording.tension_s[part], of_part)
    numbers = np.stack(
        [
            answers.bend_angle,
            answers.bend_angle_stddev(tension_stddev),
            answers.pressure,
            answers.pressure_stddev(tension_stddev),
            answers.slip_margin,
        ]
    )
    return answers.regime_names, numbers, np.full(answers.regime.shape, True)


def _tracked(
    tracker: StickSlipTracker,
    recording: Recording,
    loads: Load | list[Load],
    start: int,
    tension_stddev: float,
) -> _Part:
    regimes, rows, assured = [], [], []
    part = slice(start, start + CHUNK)
    pairs = zip(
        recording.tension_l[part].tolist(), recording.tension_s[part].tolist(), strict=True
    )
    of_part = itertools.repeat(loads) if isinstance(loads, Load) else loads[part]
    for tensions, load in zip(pairs, of_part, strict=False):
        try:
            state = tracker.update(*tensions, load)
        except TensionError:
            regimes.append(INVALID)
            rows.append((math.nan,) * 5)
            assured.append(False)
            continue
        regimes.append(state.regime.value)
        rows.append((*_estimates(state, tension_stddev), _number(state.slip_margin)))
        assured.append(state.angle_assured)
    return np.array(regimes), np.array(rows).reshape(-1, 5).T, np.array(assured)


def _estimates(result: Equilibrium, tension_stddev: float) -> tuple[float, float, float, float]:
    return (
        _number(result.bend_angle),
        _number(result.bend_angle_stddev(tension_stddev)),
        _number(result.pressure),
        _number(result.pressure_stddev(tension_stddev)),
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else value
