"""Measure how often the 95 % intervals of `calibrate` hold the truth, for every kind of parameter.

Sessions are made by the tests' brute force, which shares no code with the package, with noise of
10 mN and 0.5 degrees. Fits start from other values than the truth.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import os
import sys
from typing import Any, NamedTuple

import numpy as np
import synthetic_units
from law_sessions import SessionPlan, session_of, unit_of

from tendon_statics import CalibrationError, Load, Recording, calibrate
from tendon_statics.physics.calibration.load_cells import LoadCells

SIXTY = math.radians(60.0)
TILTED = SessionPlan(slips=40, tilts=(0.0, SIXTY, -SIXTY))
HUNG = SessionPlan(slips=40, tip_forces=((0.0, 0.0), (0.0, -0.4), (0.2, 0.0)), tip_distance=0.016)
STARTS = {
    'mass': 0.0195558,
    'friction_coefficient': 0.6,
    'stiffness': 0.0,
    'cable_offset': 0.0045,
    'com_distance': 0.01,
}


class Condition(NamedTuple):
    """What is fitted to which sessions of which unit."""

    law: str
    plan: SessionPlan
    fit: tuple[str, ...]
    stiffness: float = 0.0
    """Of the unit"""
    cells: tuple[float, float, float, float] = (1.0, 1.0, 0.0, 0.0)
    """gain_l, gain_s, bias_l and bias_s that make the truth of what is measured"""


BASICS = ('mass', 'friction_coefficient')
BIASED = (1.0, 1.0, 0.03, -0.05)
CONDITIONS = (
    Condition('merged', SessionPlan(slips=40), (*BASICS, 'bias_l', 'bias_s'), cells=BIASED),
    Condition('merged', SessionPlan(slips=40), ('friction_coefficient', 'stiffness'), 0.004),
    Condition('friction_circle', TILTED, (*BASICS, 'stiffness'), 0.004),
    Condition(
        'friction_circle', TILTED, (*BASICS, 'com_distance', 'bias_l', 'bias_s'), 0.0, BIASED
    ),
    Condition('elastic_seat', TILTED, (*BASICS, 'bias_l', 'bias_s'), 0.0, BIASED),
    Condition('elastic_seat', HUNG, (*BASICS, 'stiffness'), 0.004),
    Condition(
        'elastic_seat',
        HUNG._replace(pressure_stddev=0.02),
        (*BASICS, 'cable_offset', 'gain_l'),
        cells=(1.05, 1.0, 0.0, 0.0),
    ),
    Condition(
        'merged', HUNG, ('friction_coefficient', 'gain_l', 'gain_s'), cells=(1.05, 0.97, 0.0, 0.0)
    ),
)


class Job(NamedTuple):
    """One session."""

    condition: int
    seed: int


def deviations(job: Job) -> list[tuple[float, bool]] | None:
    """Error of each fitted value in standard errors, and whether its interval holds the truth."""
    condition = CONDITIONS[job.condition]
    truth = unit_of(condition.law, stiffness=condition.stiffness)
    rng = np.random.default_rng((job.seed, job.condition))
    recording, pressure_stddev = session_of(truth, condition.plan, rng)
    gain_l, gain_s, bias_l, bias_s = condition.cells
    recording = dataclasses.replace(
        recording,
        tension_l=(recording.tension_l - bias_l) / gain_l,
        tension_s=(recording.tension_s - bias_s) / gain_s,
    )
    true: dict[str, Any] = LoadCells(*condition.cells)._asdict()
    true |= {name: getattr(truth, name) for name in condition.fit if name not in true}
    start = dataclasses.replace(
        truth, **{name: STARTS[name] for name in condition.fit if name in STARTS}
    )
    try:
        fitted = fit_of(start, recording, condition, pressure_stddev)
    except CalibrationError:
        return None
    found = []
    if any('other values fit as well' in warning for warning in fitted.warnings):
        return None  # which is said
    for parameter in fitted.parameters:
        if parameter.interval is None:
            return None
        low, high = parameter.interval
        truly = true[parameter.name]
        found.append(((parameter.value - truly) / parameter.standard_error, low <= truly <= high))
    return found


def fit_of(
    start: Any, recording: Recording, condition: Condition, pressure_stddev: float | None
) -> Any:
    """Fit as somebody would who knows the law."""
    return calibrate(
        start,
        recording,
        condition.fit,
        pressure_stddev=pressure_stddev,
        load=Load(tip_distance=condition.plan.tip_distance),
    )


def main(arguments: list[str] | None = None) -> int:
    """Print coverage, mean and spread as a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--sessions', type=int, default=200, help='of each condition')
    parser.add_argument('--seed', type=int, default=0, help='of the first session')
    parser.add_argument('--workers', type=int, default=len(os.sched_getaffinity(0)))
    options = parser.parse_args(arguments)
    seeds = range(options.seed, options.seed + options.sessions)
    jobs = [Job(n, seed) for n in range(len(CONDITIONS)) for seed in seeds]
    results = list(synthetic_units.run_all(deviations, jobs, options.workers))
    print(
        f'{options.sessions} sessions of 40 slips each\n\n'
        '| law | sessions | parameter | covered | mean error | spread | not determined |\n'
        '|---|---|---|--:|--:|--:|--:|'
    )
    for number, condition in enumerate(CONDITIONS):
        mine = [of for job, of in zip(jobs, results, strict=True) if job.condition == number]
        told = [of for of in mine if of is not None]
        for place, name in enumerate(condition.fit):
            errors = np.array([of[place][0] for of in told])
            covered = np.mean([of[place][1] for of in told])
            cells = [condition.law, _about(condition.plan), name, f'{100.0 * covered:.1f} %']
            cells += [f'{errors.mean():+.2f}', f'{errors.std():.2f}', f'{len(mine) - len(told)}']
            print(f'| {" | ".join(cells)} |')
    return 0


def _about(plan: SessionPlan) -> str:
    parts = []
    if any(plan.tilts):
        parts.append('base at 0° and ±60°')
    if any(map(any, plan.tip_forces)):
        parts.append('force at the tip')
    if plan.pressure_stddev is not None:
        parts.append('pressure')
    return ', '.join(parts) or 'upright'


if __name__ == '__main__':
    sys.exit(main())
