"""How far smoothed tensions are off, in their own errors: `make measure-smoothing`."""

from __future__ import annotations

import argparse
import secrets
import sys

import numpy as np

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.physics.filter.local_fits import REACH
from tendon_statics.physics.filter.smoothing import Windows

from .sessions import NOISES, PROGRAMS, RATES, UNITS, session

LAG = 0.15
"""Age in s at which an estimate is committed"""
EVERY = 9
"""Samples from one place that is looked at to the next"""
SLOPES = (0.03, 0.1, 0.3, 1.0, 3.0)
"""Of ramps, in standard deviations of a sample from one to the next"""
EXTREME = 2.8
"""Errors of the outermost member"""


def errors(program: str, seconds: float, random: np.random.Generator) -> dict[str, list[float]]:
    """Errors in standard errors over random sessions, of committed and newest estimates."""
    found: dict[str, list[float]] = {'committed': [], 'newest': []}
    for unit in UNITS:
        for rate in RATES:
            for noise in NOISES:
                drawn = session(unit, program, noise, rate, seconds, random)
                truth, samples = drawn.true_tension_s, drawn.tension_s[None]
                lag = round(LAG * rate)
                windows = Windows(REACH + lag, np.array([lag, 0]), 1)
                for end in range(REACH + lag, samples.shape[1] + 1, EVERY):
                    one = windows.estimate(samples[:, end - REACH - lag : end], noise)
                    for row, (name, age) in enumerate((('committed', lag), ('newest', 0))):
                        off = one.value[0, row] - truth[end - 1 - age]
                        found[name].append(off / one.error[0, row])
    return found


def overshot(slope: float, ramps: int, random: np.random.Generator) -> float:
    """Share of the ends of ramps that are seen higher than they are by `EXTREME` errors."""
    lag, rest, before = 30, 80, 150
    truth = np.concatenate([slope * np.arange(-before, 0.0), np.zeros(rest + lag)])
    windows = Windows(REACH + lag, np.array([lag]), 1)
    count = 0
    for _ in range(ramps):
        samples = (truth + random.normal(0.0, 1.0, len(truth)))[None]
        ends = range(before - 20 + lag + 1, len(truth) + 1)
        found = [
            windows.estimate(samples[:, end - REACH - lag : end], 1.0)
            for end in ends
            if end >= REACH + lag
        ]
        count += any(one.value[0, 0] - EXTREME * one.error[0, 0] > 0.0 for one in found)
    return count / ramps


def main() -> int:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description='Measure how tensions are smoothed.')
    parser.add_argument('--seconds', type=float, default=6.0, metavar='S', help='of a session')
    parser.add_argument('--ramps', type=int, default=100, metavar='N', help='of each slope')
    parser.add_argument('--seed', type=int, default=secrets.randbelow(2**31), metavar='N')
    options = parser.parse_args()
    random = np.random.default_rng(options.seed)
    rows = []
    for program in PROGRAMS:
        for name, found in errors(program, options.seconds, random).items():
            size = np.abs(found)
            shares = (f'{100.0 * np.mean(size > level):.2f}' for level in (2.0, 3.0, 6.0))
            rows.append((program, name, f'{np.sqrt(np.mean(size**2)):.2f}', *shares))
    titles = ('program', 'estimate', 'error, rms [standard errors]:')
    print(markdown_table((*titles, '> 2 [%]:', '> 3 [%]:', '> 6 [%]:'), rows))
    print()
    rows = [
        (f'{slope:g}', f'{100.0 * overshot(slope, options.ramps, random):.0f}') for slope in SLOPES
    ]
    print(markdown_table(('slope of a ramp [deviations per sample]', 'overshot [%]:'), rows))
    print(f'\nseed {options.seed}')
    return 0


if __name__ == '__main__':
    sys.exit(main())
