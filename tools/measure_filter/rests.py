"""Whether a unit that rests below slip stays where it is: `make measure-rests`."""

from __future__ import annotations

import argparse
import math
import secrets
import sys
from typing import NamedTuple

import numpy as np

from tendon_statics import StickSlipFilter
from tendon_statics.command_line.tables import markdown_table

from .sessions import UNITS, slip_tension

BELOW = 0.05
"""How far below slip the tension of the stronger cable rests, as a share of it"""
MOVED = math.radians(0.1)
"""Change in rad of median or interval from which on it counts as drift"""
FIRST = 2.0
"""Time in s after which it is seen where the unit is"""


class Rest(NamedTuple):
    """What a rest showed."""

    drift: float
    """Largest change of the committed median or of an end of its interval, in deg"""
    after: float
    """Time in s after which that was more than `MOVED`; infinite if never"""
    provisional: float
    """Share of samples at which the provisional ones were changed by more"""


def rest(unit: str, noise: float, rate: float, seconds: float, seed: int) -> Rest:
    """Follow a unit that rests from the start."""
    design, weak = UNITS[unit]
    pair = np.array([weak, (1.0 - BELOW) * slip_tension(design, weak, 0.0)])
    found = StickSlipFilter(design, tension_stddev=noise)
    random = np.random.default_rng(seed)
    was, drift, after, changed = None, 0.0, math.inf, 0
    for index in range(int(seconds * rate)):
        time = index / rate
        state = found.update(*(pair + random.normal(0.0, noise, 2)).tolist(), time)
        if time < FIRST:
            continue
        committed, newest = (
            np.array([one.bend_angle, *one.interval(0.95)]) for one in (found.committed, state)
        )
        was = committed if was is None else was
        change = float(np.abs(committed - was).max())
        drift = max(drift, change)
        after = min(after, time) if change > MOVED else after
        changed += bool(np.abs(newest - was).max() > MOVED)
    return Rest(math.degrees(drift), after, changed / max(int((seconds - FIRST) * rate), 1))


def main() -> int:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description='Measure whether a unit at rest is left there.')
    parser.add_argument('--unit', choices=UNITS, help='default: all')
    parser.add_argument('--noise', type=float, default=0.02, metavar='N', help='in N')
    parser.add_argument('--rate', type=float, default=200.0, metavar='HZ')
    parser.add_argument('--seconds', type=float, default=600.0, metavar='S', help='of a rest')
    parser.add_argument('--rests', type=int, default=1, metavar='N', help='of each unit')
    parser.add_argument('--seed', type=int, default=secrets.randbelow(2**31), metavar='N')
    options = parser.parse_args()
    rows = []
    for unit in [options.unit] if options.unit else UNITS:
        for number in range(options.rests):
            one = rest(unit, options.noise, options.rate, options.seconds, options.seed + number)
            after = f'{one.after:.0f}' if math.isfinite(one.after) else '-'
            share = f'{1e6 * one.provisional:.0f}'
            rows.append((unit, str(options.seed + number), f'{one.drift:.2f}', after, share))
    print(
        markdown_table(
            ('unit', 'seed:', 'drift [deg]:', 'after [s]:', 'provisional, changed [ppm]:'), rows
        )
    )
    print(
        f'\nrests of {options.seconds:g} s at {100.0 * BELOW:g} % below slip, '
        f'{1e3 * options.noise:g} mN and {options.rate:g} Hz'
    )
    return 0


if __name__ == '__main__':
    sys.exit(main())
