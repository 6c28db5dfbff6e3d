"""Every sample of a recording through the model, as the node would have said it."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...estimation.regimes import INVALID
from ...estimation.settings import Settings
from ...estimation.unit_estimator import KnownLoad, UnitEstimator
from ...physics import Equilibrium, JointDesign, Load, TensionError
from ...physics.admissible import check_bend_angle
from ...physics.batch import solve_batch
from ...tensions.reason import ReadingError, Reason
from ..progress import Progress, unseen
from ..reading.columns import READINGS
from ..recording import OF_LOAD, Floats, Recording
from ..samples import Samples

CHUNK = 20_000
"""Samples solved at once, after which progress is shown"""

VALID = 'valid'


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
    """False after what cannot vouch for a tracked unit, such as a slack cable, until a stop"""
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
    settings: Settings | None = None,
    load: Load | None = None,
    initial_bend_angle: float | None = None,
    tension_stddev: float | None = None,
    progress: Progress = unseen,
) -> Replay:
    """Estimate every sample of a recording, as the node does with the same settings.

    Parameters
    ----------
    estimation : str
        ``equilibrium``: each sample by itself, as `solve` does; ``tracking``: with the memory of a
        `StickSlipTracker`.
    settings : Settings
        How the unit is measured and what is believed; the design of it is not looked at. What
        follows changes it, where it is given.
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
    settings = settings or Settings(design)
    load = load or settings.load
    stddev = settings.tension_stddev if tension_stddev is None else tension_stddev
    if not 0.0 < stddev < math.inf:
        raise TensionError(f'tension_stddev is {stddev!r} N, allowed is a finite number above 0')
    angle = settings.initial_bend_angle if initial_bend_angle is None else initial_bend_angle
    check_bend_angle(design, angle)
    settings = dataclasses.replace(
        settings, design=design, tension_stddev=stddev, initial_bend_angle=angle
    )
    samples = Samples(recording, settings)
    loads = recording.loads(load)
    starts = progress(range(0, len(recording), CHUNK), 'solving')
    if estimation == 'equilibrium':
        parts = [_solved(samples, loads, start) for start in starts]
    else:
        recording.in_order()
        unit = UnitEstimator(settings, estimation)
        parts = [_tracked(unit, samples, loads, start) for start in starts]
    regime, numbers, assured = zip(*parts, strict=True)
    angles, angle_stddev, pressure, pressure_stddev, margin = np.concatenate(numbers, axis=1)
    regimes = np.concatenate(regime)
    validity = [
        fault or (Reason.BELOW_WEIGHT.value if name == INVALID else VALID)
        for fault, name in zip(samples.faults, regimes.tolist(), strict=True)
    ]
    return Replay(
        recording,
        load,
        estimation,
        regimes,
        angles,
        angle_stddev,
        pressure,
        pressure_stddev,
        margin,
        np.concatenate(assured),
        np.array(validity, dtype=np.str_),
    )


def _part(samples: Samples, start: int) -> range:
    """Return the places of those that are solved at once."""
    return range(start, min(start + CHUNK, len(samples.tensions)))


_Part = tuple[NDArray[np.str_], Floats, NDArray[np.bool_]]
"""Regimes, the five numbers of each sample in rows, and whether the angle is assured"""


def _solved(samples: Samples, loads: Load | list[Load], start: int) -> _Part:
    settings, part = samples.settings, _part(samples, start)
    pairs = np.array([samples.judged(place) for place in part])
    tension_l, tension_s = pairs.reshape(-1, 2).T
    of_part = loads if isinstance(loads, Load) else loads[part.start : part.stop]
    answers = solve_batch(settings.design, tension_l, tension_s, of_part)
    numbers = np.stack(
        [
            answers.bend_angle,
            answers.bend_angle_stddev(settings.tension_stddev),
            answers.pressure,
            answers.pressure_stddev(settings.tension_stddev),
            answers.slip_margin,
        ]
    )
    return answers.regime_names, numbers, np.full(answers.regime.shape, True)


def _tracked(unit: UnitEstimator, samples: Samples, loads: Load | list[Load], start: int) -> _Part:
    regimes, rows, assured = [], [], []
    stddev = samples.settings.tension_stddev
    for place in _part(samples, start):
        known = KnownLoad(loads if isinstance(loads, Load) else loads[place])
        now, measured = samples.times[place]
        fault = samples.faults[place]
        try:
            if fault:
                unit.drop(Reason(fault), fault)
                raise ReadingError(Reason(fault), fault)
            state = unit.take_tensions(*samples.tensions[place], known, now, measured)
        except ReadingError as error:
            samples.faults[place] = error.reason.value
            regimes.append(INVALID)
            rows.append((math.nan,) * 5)
            assured.append(False)
            continue
        regimes.append(state.regime.value)
        rows.append((*_estimates(state, stddev), _number(state.slip_margin)))
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
