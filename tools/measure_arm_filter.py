"""Measure `ArmFilter` on random arms and sessions: `make measure-arm-filter`.

Arms as `make measure-arm` draws them, of 2 to 6 units, go through ramps with rests; each load cell
has noise of 5, 10 or 20 mN. The truth is the exact `ArmTracker` on tensions without noise; beside
the filter runs the tracker that believes each sample.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import random
import secrets
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'test/support'))

from arm_brute import random_arm, random_load, random_pull

from tendon_statics import (
    Arm,
    ArmError,
    ArmFilter,
    ArmFilterState,
    ArmTracker,
    ArmUnit,
    Cable,
    Load,
    Regime,
    TensionError,
    default_design_path,
    load_design,
)
from tendon_statics.command_line.tables import markdown_table

NOISES = (0.005, 0.01, 0.02)
"""N"""
FAR = math.radians(1.0)
"""Error in rad from which on an angle counts as off"""
UNITS = range(2, 7)


class Score(NamedTuple):
    """What one session showed, in percent of its samples and joints unless said otherwise."""

    covered: float
    tip_covered: float
    """Of x, z and tilt, each by itself"""
    width: float
    """Mean of the joints' 95 % intervals in deg"""
    off: float
    committed_off: float
    tracker_off: float
    tip_error: float
    """Mean distance of the tip in mm"""
    tracker_tip_error: float
    pressure_covered: float
    """Within two of its deviations"""
    median_cost: float
    """CPU time of an update in ms"""
    mean_cost: float
    high_cost: float
    """Of which nine tenths are below"""


def pulls(draw: random.Random, arm: Arm, load: Load, rate: float) -> Iterator[dict]:
    """Yield tensions without noise: ramps from one random pull to the next, with rests."""
    now = dict(random_pull(draw, arm, load))
    for pair in range(len(arm.cables) // 2):  # balanced at first
        mean = 0.5 * (now[f'l{pair}'] + now[f's{pair}'])
        now[f'l{pair}'] = now[f's{pair}'] = mean
    while True:
        after = random_pull(draw, arm, load)
        steps = max(1, int(draw.uniform(0.3, 1.5) * rate))
        for step in range(1, steps + 1):
            share = step / steps
            yield {name: (1.0 - share) * now[name] + share * after[name] for name in now}
        for _ in range(int(draw.uniform(0.2, 1.0) * rate)):
            yield after
        now = after


def score(draw: random.Random, units: int, rate: float, count: int) -> Score:
    """Run filter and tracker over a session."""
    arm = random_arm(draw, units)
    load = random_load(draw)
    noise = draw.choice(NOISES)
    found = ArmFilter(arm, tension_stddev=noise)
    exact, believing = ArmTracker(arm), ArmTracker(arm)
    truths, rows, costs = {}, [], []
    for index, tensions in zip(range(count), pulls(draw, arm, load, rate), strict=False):
        at = index / rate
        measured = {name: value + draw.gauss(0.0, noise) for name, value in tensions.items()}
        truth = exact.update(tensions, load)
        truths[at] = np.array(truth.bend_angles)
        begin = time.process_time()
        try:
            state = found.update(measured, at, load)
        except TensionError:
            continue
        costs.append(1e3 * (time.process_time() - begin))
        try:
            believed = believing.update(measured, load)
        except (TensionError, ArmError):
            continue
        rows.append(_row(state, truth, believed, found.committed, truths))
    median, high = np.percentile(costs, [50.0, 90.0])
    return Score(*np.nanmean(rows, axis=0), median, float(np.mean(costs)), high)


def _row(state: ArmFilterState, truth, believed, committed, truths) -> list[float]:
    angles, ends = np.array(truth.bend_angles), np.array(state.intervals())
    inside = (ends[:, 0] - 1e-9 <= angles) & (angles <= ends[:, 1] + 1e-9)
    low, high = np.array(state.tip_interval())
    tip = np.array(truth.tip)
    tip_inside = (low - 1e-9 <= tip) & (tip <= high + 1e-9)
    off = np.abs(np.array(state.bend_angles) - angles) > FAR
    tracker_off = np.abs(np.array(believed.bend_angles) - angles) > FAR
    committed_off = math.nan
    if committed is not None:
        committed_off = 100.0 * np.mean(
            np.abs(np.array(committed.bend_angles) - truths[committed.time]) > FAR
        )
    pressed = [
        abs(found - true) <= 2.0 * stddev
        for found, stddev, true in zip(
            state.pressures, state.pressure_stddevs, truth.pressures, strict=True
        )
        if found is not None and true is not None
    ]
    return [
        100.0 * inside.mean(),
        100.0 * tip_inside.mean(),
        math.degrees((ends[:, 1] - ends[:, 0]).mean()),
        100.0 * off.mean(),
        committed_off,
        100.0 * tracker_off.mean(),
        1e3 * math.dist(state.tip[:2], truth.tip[:2]),
        1e3 * math.dist(believed.tip[:2], truth.tip[:2]),
        100.0 * np.mean(pressed) if pressed else math.nan,
    ]


def costs(units: int, rate: float) -> tuple[str, ...]:
    """CPU times in ms of an update of arms alike: all at rest, some slipping, and the worst."""
    design = dataclasses.replace(
        load_design(default_design_path()), friction_coefficient=0.3, stiffness=0.05
    )
    arm = Arm([ArmUnit(design, 0.02)] * units, [Cable('l', 'l', units), Cable('s', 's', units)])
    found, random = ArmFilter(arm, tension_stddev=0.01), np.random.default_rng(1)
    resting, slipping = [], []
    for index in range(int(6.0 * rate)):
        strong = 1.0 + 0.3 * min(index / rate, 2.0 + max(0.0, index / rate - 4.0))
        pull = np.array([1.0, strong]) + random.normal(0.0, 0.01, 2)
        begin = time.process_time()
        state = found.update(dict(zip('ls', pull.tolist(), strict=True)), index / rate)
        took = 1e3 * (time.process_time() - begin)
        slips = any(part[Regime.SLIPPING] > 0.0 for part in state.regime_probabilities)
        (slipping if slips else resting).append(took)
    return (
        *(str(units), f'{np.median(resting):.1f}'),
        *(f'{share:.1f}' for share in np.percentile(slipping, [50.0, 90.0])),
        f'{max(resting + slipping):.0f}',
    )


def main(arguments: list[str] | None = None) -> int:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description='Measure ArmFilter on random sessions.')
    parser.add_argument('--arms', type=int, default=20, metavar='N', help='default: %(default)s')
    parser.add_argument('--seconds', type=float, default=4.0, metavar='S', help='of a session')
    parser.add_argument('--rate', type=float, default=100.0, metavar='HZ')
    parser.add_argument('--seed', type=int, help='default: a fresh one')
    options = parser.parse_args(arguments)
    seed = secrets.randbits(32) if options.seed is None else options.seed
    print(f'seed {seed}', file=sys.stderr)
    count = int(options.seconds * options.rate)
    rows, everything = [], []
    for units in UNITS:
        scores = []
        for number in range(max(1, options.arms // len(UNITS))):
            draw = random.Random(f'{seed} {units} {number}')
            scores.append(score(draw, units, options.rate, count))
            print(f'\r{units} units, arm {number + 1}', end='', file=sys.stderr)
        everything += scores
        rows.append(_mean_row(str(units), scores))
    print(file=sys.stderr)
    rows.append(_mean_row('all', everything))
    header = ('units:', 'covered [%]:', 'least [%]:', 'tip covered [%]:', 'width [deg]:')
    more = ('off [%]:', 'off, committed [%]:', 'off, tracker [%]:', 'tip off [mm]:')
    last = ('tip off, tracker [mm]:', 'pressure covered [%]:', 'median, mean, p90 [ms]:')
    print(markdown_table((*header, *more, *last), rows), flush=True)
    header = ('units:', 'rests [ms]:', 'slips, median [ms]:', 'nine tenths [ms]:', 'worst [ms]:')
    print('\n' + markdown_table(header, [costs(units, options.rate) for units in (1, 2, 5, 10)]))
    print(f'\n{len(everything)} arms, {options.seconds:g} s at {options.rate:g} Hz, seed {seed}')
    return 0


def _mean_row(name: str, scores: list[Score]) -> tuple[str, ...]:
    mean = Score(*np.nanmean(scores, axis=0))
    return (
        *(name, f'{mean.covered:.1f}', f'{min(one.covered for one in scores):.1f}'),
        *(f'{mean.tip_covered:.1f}', f'{mean.width:.2f}', f'{mean.off:.2f}'),
        *(f'{mean.committed_off:.2f}', f'{mean.tracker_off:.1f}', f'{mean.tip_error:.2f}'),
        *(f'{mean.tracker_tip_error:.2f}', f'{mean.pressure_covered:.1f}'),
        f'{mean.median_cost:.0f}, {mean.mean_cost:.0f}, {mean.high_cost:.0f}',
    )


if __name__ == '__main__':
    sys.exit(main())
