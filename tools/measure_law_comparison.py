"""Measure how often `compare_laws` tells the law of a synthetic unit, and how often a wrong one.

Sessions are made by the tests' brute force, which shares no code with the package. The unit is the
preliminary design with another mass, cable offset and friction, and each of the three contact
laws in turn; the fits start from the preliminary design. Noise is 10 mN and 0.5 degrees.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import os
import sys
from collections import Counter
from typing import Any, NamedTuple

import numpy as np
import synthetic_units
from brute import LAWS
from designs import PRELIMINARY
from law_sessions import SessionPlan, session_of, unit_of

from tendon_statics import CalibrationError
from tendon_statics.physics.calibration.comparison import compare_laws

SIXTY = math.radians(60.0)
FRICTIONS = (0.7, 1.3)
"""Shares of the unit's friction coefficient between which that of a session lies"""

ALL = ('mass', 'cable_offset', 'friction_coefficient')


class Condition(NamedTuple):
    """How sessions are recorded, and what is known of the unit before they are."""

    text: str
    plan: SessionPlan
    fit: tuple[str, ...] = ('mass', 'friction_coefficient')
    known: tuple[str, ...] = ('cable_offset',)
    changes: dict[str, float] = {}  # noqa: RUF012 that nobody changes
    """Of the unit, which are known"""
    noise: float = 1.0
    """As a multiple of the stated"""


CONDITIONS = (
    Condition('upright, nothing known', SessionPlan(), ALL, ()),
    Condition('upright', SessionPlan()),
    Condition('upright, 100 slips', SessionPlan(slips=100)),
    Condition('upright, weighs nothing', SessionPlan(), changes={'mass': 1e-4}),
    Condition('upright, noise three times the stated', SessionPlan(), noise=3.0),
    Condition('base at 0° and ±60°', SessionPlan(tilts=(0.0, SIXTY, -SIXTY))),
    Condition(
        'weight of 0.4 N at the tip in half of them',
        SessionPlan(tip_forces=((0.0, 0.0), (0.0, -0.4)), tip_distance=0.016),
    ),
    Condition(
        'pressure to 2 %, width known',
        SessionPlan(pressure_stddev=0.02),
        changes={'contact_width': 0.002},
    ),
    Condition('pressure to 2 %, width unknown', SessionPlan(pressure_stddev=0.02)),
    Condition(
        'friction known instead of the offset',
        SessionPlan(),
        ('mass', 'cable_offset'),
        ('friction_coefficient',),
    ),
    Condition(
        'friction and offset known',
        SessionPlan(),
        ('mass',),
        ('cable_offset', 'friction_coefficient'),
    ),
    Condition(
        'base at 0° and ±60°, 0.4 to 1.2 N, 100 slips',
        SessionPlan(slips=100, totals=(0.4, 1.2), tilts=(0.0, SIXTY, -SIXTY)),
    ),
    Condition(
        'weight of 0.4 N at the tip in half of them, 0.8 to 1.6 N, 100 slips',
        SessionPlan(
            slips=100, totals=(0.8, 1.6), tip_forces=((0.0, 0.0), (0.0, -0.4)), tip_distance=0.016
        ),
    ),
)


class Job(NamedTuple):
    """One session."""

    condition: int
    law: str
    seed: int


def outcome(job: Job) -> tuple[str, bool]:
    """Return what the comparison says, ``right``, ``wrong`` or ``open``, and if truth is out."""
    condition = CONDITIONS[job.condition]
    rng = np.random.default_rng((job.seed, job.condition, LAWS.index(job.law)))
    truth = unit_of(job.law, **condition.changes)
    friction = truth.friction_coefficient * rng.uniform(*FRICTIONS)
    truth = dataclasses.replace(truth, friction_coefficient=friction)
    plan = condition.plan
    noisy = plan._replace(
        tension_stddev=condition.noise * plan.tension_stddev,
        bend_angle_stddev=condition.noise * plan.bend_angle_stddev,
    )
    recording, pressure_stddev = session_of(truth, noisy, rng)
    known: dict[str, Any] = {name: getattr(truth, name) for name in condition.known}
    start = dataclasses.replace(PRELIMINARY, **condition.changes, **known)
    try:
        found = compare_laws(
            start,
            recording,
            condition.fit,
            tension_stddev=plan.tension_stddev,
            bend_angle_stddev=plan.bend_angle_stddev,
            pressure_stddev=pressure_stddev,
            load=recording_load(plan),
            with_advice=False,
        )
    except CalibrationError:
        return 'open', False
    said = 'open' if found.told is None else 'right' if found.told == job.law else 'wrong'
    return said, found.meets_data and job.law not in found.possible


def recording_load(plan: SessionPlan) -> Any:
    """What of a session's load is not in the recording: where the tip force acts."""
    from tendon_statics import Load

    return Load(tip_distance=plan.tip_distance)


def main(arguments: list[str] | None = None) -> int:
    """Print the rates as a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--sessions', type=int, default=100, help='of each law and condition')
    parser.add_argument('--seed', type=int, default=0, help='of the first session')
    parser.add_argument('--workers', type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument('--only', default='', help='conditions with this text')
    options = parser.parse_args(arguments)
    seeds = range(options.seed, options.seed + options.sessions)
    chosen = [n for n, one in enumerate(CONDITIONS) if options.only in one.text]
    jobs = [Job(n, law, seed) for n in chosen for law in LAWS for seed in seeds]
    counts: dict[tuple[int, str], Counter[str]] = {}
    for job, (said, is_out) in zip(
        jobs, synthetic_units.run_all(outcome, jobs, options.workers), strict=True
    ):
        counted = counts.setdefault((job.condition, job.law), Counter())
        counted.update([said, *(['out'] if is_out else [])])
    print(
        f'{options.sessions} sessions of each; percent of them, as {", ".join(LAWS)}\n\n'
        '| condition | fitted | identified, right | identified, wrong | truth ruled out |\n'
        '|---|---|---|---|---|'
    )
    for number in chosen:
        cells = [
            ' / '.join(
                f'{100.0 * counts[number, law][what] / options.sessions:.0f}' for law in LAWS
            )
            for what in ('right', 'wrong', 'out')
        ]
        condition = CONDITIONS[number]
        fitted = ', '.join(condition.fit)
        slips = '' if condition.plan.slips != 30 else ', 30 slips'
        print(f'| {condition.text}{slips} | {fitted} | {" | ".join(cells)} |')
    return 0


if __name__ == '__main__':
    sys.exit(main())
