"""Measure how right `slip_angle_distribution` is on random units, and what it costs.

Beside draws of the tensions, each solved on a grid of angles by the tests' brute force, which
shares no code with the package. The cost is that of the probability of each regime and an
interval, in solves of the same pair.
"""

from __future__ import annotations

import argparse
import math
import os
import random
import statistics
import sys
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import synthetic_units
from bench.timing import best_times
from brute import LAWS, Case, excess, forces, random_case, seats

from tendon_statics import Regime, SlipAngleDistribution, slip_angle_distribution, solve

SHARES = (0.002, 0.005, 0.01, 0.02)
"""Noise of each tension, as shares of T"""

KINDS = {
    'any': 'any tensions',
    'equal': 'next to equal tensions',
    'slack': 'next to a slack cable',
    'seat': 'hardly seated',
}

LEVEL = 0.9
"""Of the interval"""

ANGLES = 100
"""Of the grid from 0 to the stop; a root is searched for between two of them"""

HALVINGS = 16
"""Of the interval between them, before a chord"""

LEAST = 0.05
"""Share of equilibria from which on the coverage of their interval counts"""

MOST_SOLVES = 5.0

REGIMES = tuple(Regime)


class Job(NamedTuple):
    """One random unit."""

    kind: str
    seed: int
    draws: int


class Result(NamedTuple):
    """What was measured of it."""

    is_closed_form: bool
    probabilities_cost: float
    """Of the probability of each regime, in solves of the same pair"""
    cost: float
    """Of these and an interval"""
    probability: float
    """Largest difference of a regime's probability"""
    coverage: float
    """Difference of the interval's coverage from its level; NaN where there is no interval"""


def unit(job: Job) -> tuple[Case, float]:
    """Draw a unit, and the standard deviation of its tensions in N."""
    draw = random.Random(f'{job.seed} {job.kind}')
    case = random_case(draw)
    total = case.tension_l + case.tension_s
    share = draw.choice(SHARES)
    if job.kind == 'seat':
        total = hardly_seated(case, draw.uniform(0.0, 6.0) * math.sqrt(2.0) * share)
    stddev = share * total
    weaker = total * min(case.tension_l, case.tension_s) / (case.tension_l + case.tension_s)
    if job.kind == 'equal':
        weaker = 0.5 * (total - draw.uniform(0.0, 6.0) * stddev)
    if job.kind == 'slack':
        weaker = draw.uniform(0.0, 6.0) * stddev
    if case.tension_l < case.tension_s:
        return case._replace(tension_l=weaker, tension_s=total - weaker), stddev
    return case._replace(tension_l=total - weaker, tension_s=weaker), stddev


def hardly_seated(case: Case, beyond: float) -> float:
    """Return a sum of tensions in N that is beyond what seats the joint by a share of itself."""
    stop = case.design.max_bend_angle
    _, axial, across = forces(case, np.linspace(-stop, stop, 2 * ANGLES))
    pulls = np.hypot(axial, across) if case.design.contact_law == 'merged' else -axial
    return float(max(pulls.max(), 1e-3) * (1.0 + 1e-9) / (1.0 - beyond))


def drawn(case: Case, stddev: float, draws: int, seed: int) -> tuple[dict[Regime, float], Any]:
    """Return the share of each regime among draws, and the angles of equilibria."""
    pairs = np.random.default_rng(seed).normal(0.0, stddev, (2, draws))
    pairs = pairs + np.array([[case.tension_l], [case.tension_s]])
    counts = dict.fromkeys(Regime, 0)
    taut = (pairs > 0.0).all(axis=0)
    counts[Regime.SLACK] = int(np.sum(~taut))
    angles = []
    for side in (1.0, -1.0):
        of_side = taut & ((pairs[1] >= pairs[0]) == (side > 0.0))
        regimes, found = brute_solved(case, pairs[:, of_side], side)
        angles.append(found)
        for regime, count in regimes.items():
            counts[regime] += count
    return {regime: count / draws for regime, count in counts.items()}, np.concatenate(angles)


def brute_solved(case: Case, pairs: Any, side: float) -> tuple[dict[Regime, int], Any]:
    """Return how many pairs are in each regime, and the first roots of those in equilibrium."""
    stop = case.design.max_bend_angle
    grid = np.linspace(0.0, side * stop, ANGLES)
    both = np.linspace(-stop, stop, 2 * ANGLES)
    _, axial, across = forces(case, both)
    total = pairs.sum(axis=0)[:, None]
    pairs = pairs[:, seats(case.design, total, axial, across).all(axis=1)]
    each = case._replace(tension_l=pairs[0][:, None], tension_s=pairs[1][:, None])
    values = excess(each, grid, side)
    is_held = values <= 0.0
    changes = is_held[:, 1:] != is_held[:, :-1]
    has_root = changes.any(axis=1)
    first = changes.argmax(axis=1)[has_root]
    rows = np.flatnonzero(has_root)
    low, high = grid[first], grid[first + 1]
    each = case._replace(tension_l=pairs[0][rows], tension_s=pairs[1][rows])
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = (excess(each, middle, side) <= 0.0) == is_held[rows, first]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    before, after = excess(each, low, side), excess(each, high, side)
    roots = low + (high - low) * before / (before - after)
    held = int(np.sum(~has_root & is_held[:, 0]))
    rest = len(has_root) - held - len(rows)
    return {
        Regime.EQUILIBRIUM: len(rows),
        Regime.HELD: held,
        Regime.DRIVEN_TO_STOP: rest,
    }, roots


def measured(job: Job) -> Result:
    """Measure one unit."""
    case, stddev = unit(job)
    pair = case.design, case.tension_l, case.tension_s

    def distribution() -> SlipAngleDistribution:
        return slip_angle_distribution(*pair, tension_stddev=stddev, load=case.load)

    def probabilities() -> object:
        return [*map(distribution().probability, REGIMES)]

    def everything() -> object:
        said = distribution()
        return [*map(said.probability, REGIMES), said.interval(0.95)]

    found = distribution()
    rounds = 100 if found.is_closed_form else 3
    works = probabilities, everything, lambda: solve(*pair, load=case.load)
    of_probabilities, of_everything, alone = best_times(works, rounds)
    of_regime, angles = drawn(case, stddev, job.draws, job.seed)
    coverage, interval = math.nan, found.interval(LEVEL)
    if interval is not None and len(angles) > LEAST * job.draws:
        low, high = interval
        coverage = float(np.mean((angles >= low) & (angles <= high))) - LEVEL
    probability = max(abs(found.probability(regime) - of_regime[regime]) for regime in Regime)
    costs = of_probabilities / alone, of_everything / alone
    return Result(found.is_closed_form, *costs, probability, coverage)


def row(results: Sequence[Result]) -> str:
    """Return the columns of a table for some units."""
    shares = [result.probabilities_cost for result in results]
    costs = [result.cost for result in results]
    coverages = [abs(result.coverage) for result in results if not math.isnan(result.coverage)]
    return ' | '.join(
        [
            f'{len(results)}',
            f'{statistics.median(shares):.1f}, {max(shares):.1f}',
            f'{statistics.median(costs):.1f}, {max(costs):.1f}',
            f'{sum(cost > MOST_SOLVES for cost in costs)}',
            f'{max(result.probability for result in results):.3f}',
            f'{max(coverages):.3f}' if coverages else '–',
            f'{len(coverages)}',
        ]
    )


def main(arguments: list[str] | None = None) -> int:
    """Print what was measured as a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--units', type=int, default=300, help='of each kind')
    parser.add_argument('--draws', type=int, default=10_000, help='of the tensions of each unit')
    parser.add_argument('--seed', type=int, default=0, help='of the first unit')
    parser.add_argument('--kinds', nargs='+', choices=KINDS, default=tuple(KINDS))
    parser.add_argument('--workers', type=int, default=len(os.sched_getaffinity(0)))
    options = parser.parse_args(arguments)
    seeds = range(options.seed, options.seed + options.units)
    jobs = [Job(kind, seed, options.draws) for kind in options.kinds for seed in seeds]
    results = list(synthetic_units.run_all(measured, jobs, options.workers))
    print(
        f'{options.units} units of each kind from seed {options.seed}, of the laws '
        f'{", ".join(LAWS)}; {options.draws} draws of each\n\n'
        'Costs are in solves of the same pair without its other fields; median and most.\n\n'
        '| units | form | number | probabilities | and an interval | above 5 '
        '| probability off by | coverage off by | intervals |\n'
        '|---|---|--:|--:|--:|--:|--:|--:|--:|'
    )
    for kind in options.kinds:
        for form, is_closed_form in (('closed', True), ('drawn', False)):
            of_form = [
                result
                for job, result in zip(jobs, results, strict=True)
                if job.kind == kind and result.is_closed_form is is_closed_form
            ]
            if of_form:
                print(f'| {KINDS[kind]} | {form} | {row(of_form)} |')
    return 0


if __name__ == '__main__':
    sys.exit(main())
