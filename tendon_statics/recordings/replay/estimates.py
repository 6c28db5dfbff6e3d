"""Every sample of a recording through the model, as the node would have said it."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from ...estimation.estimate import Estimate, Remark
from ...estimation.regimes import INVALID
from ...estimation.settings import Settings
from ...estimation.unit_estimator import UnitEstimator
from ...physics import JointDesign, Load, Regime, TensionError
from ...physics.admissible import check_bend_angle
from ...physics.batch import solve_batch
from ...tensions.reason import Reason
from ..errors import RecordingError
from ..progress import Progress, unseen
from ..recording import Recording
from ..samples import Samples
from ..session import Floats
from .result import VALID, Replay

CHUNK = 20_000
"""Samples solved at once, after which progress is shown"""


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
        `StickSlipTracker`; ``filtering``: of a `StickSlipFilter`.
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
        If a unit is to be followed through a recording in which time goes back, or filtered
        through one without times.
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
    unit = UnitEstimator(settings, estimation)
    if unit.remembers:
        recording.in_order()
    is_filtered = estimation == 'filtering'
    if is_filtered and recording.time is None:
        raise RecordingError(
            f'{recording.name}: filtering needs the time of each sample, which is not recorded'
            + (f': {recording.unknown_times}' if recording.unknown_times else '')
        )
    # The derivatives by the design, on which its part in a deviation rests, are those of one pair.
    is_batch = not unit.remembers and settings.design_uncertainty is None
    parts = [
        _solved(design, samples, loads, start)
        if is_batch
        else _followed(unit, samples, loads, start)
        for start in starts
    ]
    regime_names, numbers, assured = zip(*parts, strict=True)
    of_each = dict(zip(_NUMBERS, np.concatenate(numbers, axis=1), strict=True))
    regimes = np.concatenate(regime_names)
    validity = [
        fault or (Reason.BELOW_WEIGHT.value if name == INVALID else VALID)
        for fault, name in zip(samples.faults, regimes.tolist(), strict=True)
    ]
    return Replay(
        recording,
        load,
        estimation,
        regime=regimes,
        bend_angle=of_each['bend_angle'],
        bend_angle_stddev=of_each['bend_angle_stddev'],
        pressure=of_each['pressure'],
        pressure_stddev=of_each['pressure_stddev'],
        slip_margin=of_each['slip_margin'],
        angle_assured=np.concatenate(assured),
        validity=np.array(validity, dtype=np.str_),
        confidence=settings.confidence,
        measured_stddev=settings.measured_bend_angle_stddev,
        interval=(of_each['low'], of_each['high']) if is_filtered else None,
        regime_probabilities={regime: of_each[regime.value] for regime in _FILTERED_REGIMES}
        if is_filtered
        else None,
        noise_risks=unit.health.count(Remark.NOISE),
    )


def _part(samples: Samples, start: int) -> range:
    """Return the places of those that are solved at once."""
    return range(start, min(start + CHUNK, len(samples.tensions)))


_FILTERED_REGIMES = tuple(regime for regime in Regime if regime is not Regime.EQUILIBRIUM)
"""Those that a filter gives a probability"""

_NUMBERS = (
    *('bend_angle', 'bend_angle_stddev', 'pressure', 'pressure_stddev', 'slip_margin'),
    *('low', 'high', *(regime.value for regime in _FILTERED_REGIMES)),
)
"""What there is of each sample"""

_Part = tuple[NDArray[np.str_], Floats, NDArray[np.bool_]]
"""Regimes, the numbers of each sample in rows, and whether the angle is assured"""


def _solved(design: JointDesign, samples: Samples, loads: Load | list[Load], start: int) -> _Part:
    settings, part = samples.settings, _part(samples, start)
    pairs = np.array([samples.judged(place) for place in part])
    tension_l, tension_s = pairs.reshape(-1, 2).T
    of_part = loads if isinstance(loads, Load) else loads[part.start : part.stop]
    answers = solve_batch(design, tension_l, tension_s, of_part)
    numbers = np.stack(
        [
            answers.bend_angle,
            answers.bend_angle_stddev(settings.tension_stddev),
            answers.pressure,
            answers.pressure_stddev(settings.tension_stddev),
            answers.slip_margin,
            *np.full((len(_NUMBERS) - 5, len(part)), math.nan),
        ]
    )
    return answers.regime_names, numbers, np.isfinite(answers.bend_angle)


def _followed(
    unit: UnitEstimator, samples: Samples, loads: Load | list[Load], start: int
) -> _Part:
    regimes, assured = [], []
    rows: list[list[float | None]] = []
    for place in _part(samples, start):
        estimate = samples.followed(unit, loads, place)
        if estimate is None:
            regimes.append(INVALID)
            rows.append([math.nan] * len(_NUMBERS))
            assured.append(False)
            continue
        regimes.append(estimate.regime.value)
        rows.append(_numbers(estimate))
        assured.append(estimate.angle_assured)
    numbers = np.array(rows, dtype=float).reshape(-1, len(_NUMBERS)).T
    return np.array(regimes), numbers, np.array(assured)


def _numbers(estimate: Estimate) -> list[float | None]:
    """What `_NUMBERS` names; None becomes NaN in an array."""
    found: list[float | None] = [
        *(estimate.bend_angle, estimate.bend_angle_stddev),
        *(estimate.pressure, estimate.pressure_stddev, estimate.slip_margin),
    ]
    if estimate.exact is not None:  # whose interval and probabilities would take too long
        return [*found, *[None] * (len(_NUMBERS) - 5)]
    probabilities = estimate.regime_probabilities or {}
    found += estimate.interval or (None, None)
    return [*found, *(probabilities.get(regime) for regime in _FILTERED_REGIMES)]
