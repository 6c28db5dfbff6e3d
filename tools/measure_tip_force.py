"""Measure how often the intervals of `tip_force` hold the true force, for every contact law.

Units, their exact sets of forces and what is true of them come from the tests' brute force, which
shares no code with the package. Each true force is measured through noisy tensions, a noisy angle
and a design that is not quite the true one.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import os
import random
import sys
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import synthetic_units
from brute import LAWS, Case, excesses_under_push, random_case

from tendon_statics import DesignUncertainty, TipForce, tip_force

TENSION_SHARE = 0.01
"""Noise of each tension, as a share of T"""

ANGLE_STDDEV = math.radians(0.5)

DESIGN_SHARES = {'friction_coefficient': 0.03, 'mass': 0.02, 'ball_radius': 0.01}
"""Deviation of parameters of the design, as a share of each"""

GRID = np.linspace(-1.0, 1.0, 2001)[1:-1]

KINDS = {
    'end': 'at an end of the exact set',
    'inside': 'anywhere inside it',
    'slipping': 'at an end, while known to slip',
}


class Job(NamedTuple):
    """One random unit of a law."""

    law: str
    seed: int
    draws: int
    kinds: tuple[str, ...]
    """Of `KINDS`"""
    noise: float
    """As a share of all deviations below"""


class Truth(NamedTuple):
    """A unit and its exact set of forces, by brute force."""

    case: Case
    angle: float
    direction: np.ndarray
    distance: float
    intervals: list[tuple[float, float]]


def true_unit(draw: random.Random, law: str) -> Truth:
    """Draw a unit that is pushed across or along its axis, and has a set with an end."""
    while True:
        case = random_case(draw)
        stop = case.design.max_bend_angle
        angle = draw.uniform(-0.9, 0.9) * stop
        turn = draw.choice((0.5 * math.pi, draw.uniform(-math.pi, math.pi)))
        direction = np.array([math.sin(turn), math.cos(turn)])
        distance = draw.uniform(0.005, 0.06)
        if case.design.contact_law != law:
            continue
        found = exact_set(case, angle, direction, distance)
        if any(math.isfinite(end) for interval in found for end in interval):
            return Truth(case, angle, direction, distance, found)


def exact_set(
    case: Case, angle: float, direction: np.ndarray, distance: float
) -> list[tuple[float, float]]:
    """Return the forces that friction can hold: a fine grid, and halving between its points."""
    scale = case.tension_l + case.tension_s

    def held(force: Any) -> Any:
        towards_s, towards_l, seated = excesses_under_push(case, angle, direction, distance, force)
        return seated & (towards_s <= 0.0) & (towards_l <= 0.0)

    grid = scale * GRID / (1.0 - GRID**2)
    is_held = held(grid)
    changes = np.flatnonzero(is_held[:-1] != is_held[1:])
    low, high = grid[changes], grid[changes + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        same = held(middle) == is_held[changes]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    ends = [*([-math.inf] if is_held[0] else []), *low, *([math.inf] if is_held[-1] else [])]
    return [(float(a), float(b)) for a, b in zip(ends[::2], ends[1::2], strict=True)]


def counts(job: Job) -> dict[tuple[bool, str], tuple[int, int]]:
    """How many draws there were, and of them covered, with an exact design and without."""
    draw = random.Random(f'{job.seed} {job.law}')
    truth = true_unit(draw, job.law)
    found: dict[tuple[bool, str], tuple[int, int]] = {}
    for is_exact in (True, False):
        for kind in job.kinds:
            results = [
                covered(truth, kind, draw, is_exact=is_exact, noise=job.noise)
                for _ in range(job.draws)
            ]
            known = [result for result in results if result is not None]
            found[is_exact, kind] = len(known), sum(known)
    return found


def covered(
    truth: Truth, kind: str, draw: random.Random, *, is_exact: bool, noise: float = 1.0
) -> bool | None:
    """Draw a true force and measurements of it; say whether the interval holds the force."""
    found = draw.choice(truth.intervals)
    ends = [end for end in found if math.isfinite(end)]
    if kind != 'inside':
        if not ends:
            return None
        force = draw.choice(ends)
    elif len(ends) == 2:
        force = draw.uniform(*found)
    else:
        return None
    slipping = ''
    if kind == 'slipping':
        towards_s, towards_l, _ = excesses_under_push(*truth[:4], force)
        scale = truth.case.design.ball_radius * sum(truth.case[2:4])
        if min(abs(towards_s), abs(towards_l)) > 1e-6 * scale:
            return None  # an end where the seat is lost
        slipping = 's' if abs(towards_s) < abs(towards_l) else 'l'
    answer = measured(truth, draw, slipping=slipping, is_exact=is_exact, noise=noise)
    if answer is None:
        return None
    return any(low <= force <= high for low, high in answer.intervals)


def measured(
    truth: Truth, draw: random.Random, *, slipping: str, is_exact: bool, noise: float
) -> TipForce | None:
    """Return what is said of noisy measurements; None where they have no meaning."""
    case, angle, direction, distance, _ = truth
    stddev, angle_stddev = noise * TENSION_SHARE * sum(case[2:4]), noise * ANGLE_STDDEV
    pair = [tension + draw.gauss(0.0, stddev) for tension in case[2:4]]
    if min(pair) <= 0.0:
        return None
    design, uncertainty = case.design, None
    if not is_exact:
        shares = {name: noise * share for name, share in DESIGN_SHARES.items()}
        believed = {
            name: getattr(design, name) * (1.0 + draw.gauss(0.0, share))
            for name, share in shares.items()
        }
        variances = [(getattr(design, name) * share) ** 2 for name, share in shares.items()]
        design = dataclasses.replace(design, **believed)
        uncertainty = DesignUncertainty(
            tuple(shares), tuple(map(tuple, np.diag(variances).tolist()))
        )
    stop = design.max_bend_angle
    return tip_force(
        *(design, *pair),
        bend_angle=min(max(angle + draw.gauss(0.0, angle_stddev), -stop), stop),
        direction=tuple(direction.tolist()),
        distance=distance,
        load=case.load,
        tension_stddev=stddev,
        bend_angle_stddev=angle_stddev,
        design_covariance=uncertainty,
        slipping=slipping,
    )


def main(arguments: list[str] | None = None) -> int:
    """Print the coverage as a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--units', type=int, default=400, help='of each law')
    parser.add_argument('--draws', type=int, default=5, help='of each unit and kind of force')
    parser.add_argument('--seed', type=int, default=0, help='of the first unit')
    parser.add_argument('--laws', nargs='+', choices=LAWS, default=LAWS, help='default: all')
    parser.add_argument('--kinds', nargs='+', choices=KINDS, default=tuple(KINDS), help='likewise')
    parser.add_argument('--noise', type=float, default=1.0, help='as a share of the usual')
    parser.add_argument('--workers', type=int, default=len(os.sched_getaffinity(0)))
    options = parser.parse_args(arguments)
    seeds = range(options.seed, options.seed + options.units)
    laws, kinds = options.laws, tuple(options.kinds)
    jobs = [Job(law, seed, options.draws, kinds, options.noise) for law in laws for seed in seeds]
    results = list(synthetic_units.run_all(counts, jobs, options.workers))
    print(
        f'{options.units} units of each law from seed {options.seed}, {options.draws} draws of '
        f'each, level 95 %\n\n'
        '| law | true force | design exact | design uncertain | draws |\n|---|---|--:|--:|--:|'
    )
    for law, rows in by_law(jobs, results):
        for kind in kinds:
            shares, total = [], 0
            for is_exact in (True, False):
                drawn, held = (sum(row[is_exact, kind][of] for row in rows) for of in (0, 1))
                shares.append(f'{100.0 * held / max(drawn, 1):.1f} %')
                total += drawn
            print(f'| {law} | {KINDS[kind]} | {" | ".join(shares)} | {total} |')
    return 0


def by_law(jobs: list[Job], results: list[Any]) -> Iterator[tuple[str, list[Any]]]:
    """Yield the results of each law."""
    for law in dict.fromkeys(job.law for job in jobs):
        yield law, [row for job, row in zip(jobs, results, strict=True) if job.law == law]


if __name__ == '__main__':
    sys.exit(main())
