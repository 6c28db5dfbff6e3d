"""Measure how often the intervals of `arm_tip_force` hold the true force.

Random arms of 2 to 6 units of all laws, and the forces that all their joints can hold, come from
the tests' brute force, which shares no code with the package. Each true force is measured through
noisy tensions and noisy angles of all joints.
"""

from __future__ import annotations

import argparse
import math
import random
import secrets
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'test/support'))

from arm_pushed import Pushed, joints_held, random_pushed

from tendon_statics import TensionError
from tendon_statics.command_line.tables import markdown_table

TENSION_SHARE = 0.01
"""Noise of each tension, as a share of their mean"""
ANGLE_STDDEV = math.radians(0.5)
GRID = np.linspace(-1.0, 1.0, 2001)[1:-1]


def main(arguments: list[str] | None = None) -> int:
    """Print the coverage as a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--arms', type=int, default=150, help='default: %(default)s')
    parser.add_argument('--draws', type=int, default=4, help='of each arm and kind of force')
    parser.add_argument('--seed', type=int, help='default: a fresh one')
    options = parser.parse_args(arguments)
    seed = secrets.randbits(32) if options.seed is None else options.seed
    found: dict[tuple[str, str], list[bool]] = {}
    for number in range(options.arms):
        draw = random.Random(f'{seed} {number}')
        case, intervals = true_arm(draw)
        for _ in range(options.draws):
            for kind in ('an end', 'inside'):
                force = true_force(draw, intervals, kind)
                is_covered = None if force is None else covered(draw, case, force)
                if is_covered is not None:
                    for units in (str(len(case.angles)), 'all'):
                        found.setdefault((units, kind), []).append(is_covered)
        print(f'\r{number + 1} of {options.arms} arms', end='', file=sys.stderr)
    print(file=sys.stderr)
    rows = []
    for units in sorted({units for units, _ in found}):
        row = [units]
        for kind in ('an end', 'inside'):
            results = found.get((units, kind), [])
            row += [f'{100.0 * np.mean(results):.1f}' if results else '-', str(len(results))]
        rows.append(row)
    header = ('units:', 'at an end of the exact set [%]:', 'draws:', 'inside it [%]:', 'draws:')
    print(markdown_table(header, rows))
    print(f'\n{options.arms} arms, level 95 %, seed {seed}')
    return 0


def true_arm(draw: random.Random) -> tuple[Pushed, list[tuple[float, float]]]:
    """Draw an arm, and the forces that its joints can hold, of which there is an end."""
    while True:
        case = random_pushed(draw, friction=False)
        intervals = exact_set(case)
        if any(math.isfinite(end) for interval in intervals for end in interval):
            return case, intervals


def exact_set(case: Pushed) -> list[tuple[float, float]]:
    """Return the forces that all joints hold: a fine grid, and halving between its points."""
    grid = case.scale * GRID / (1.0 - GRID**2)
    is_held = joints_held(case, grid).all(axis=0)
    changes = np.flatnonzero(is_held[:-1] != is_held[1:])
    low, high = grid[changes], grid[changes + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        same = joints_held(case, middle).all(axis=0) == is_held[changes]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    ends = [*([-math.inf] if is_held[0] else []), *low, *([math.inf] if is_held[-1] else [])]
    return [(float(a), float(b)) for a, b in zip(ends[::2], ends[1::2], strict=True)]


def true_force(draw: random.Random, intervals: list, kind: str) -> float | None:
    """Draw a force at a finite end, or inside an interval that has two."""
    interval = draw.choice(intervals)
    ends = [end for end in interval if math.isfinite(end)]
    if kind == 'inside':
        return draw.uniform(*interval) if len(ends) == 2 else None
    return draw.choice(ends) if ends else None


def covered(draw: random.Random, case: Pushed, force: float) -> bool | None:
    """Measure an arm that is pushed; say whether the interval holds the force."""
    stddev = TENSION_SHARE * float(np.mean(list(case.tensions.values())))
    tensions = {name: value + draw.gauss(0.0, stddev) for name, value in case.tensions.items()}
    angles = [
        min(max(angle + draw.gauss(0.0, ANGLE_STDDEV), -stop), stop)
        for angle, stop in zip(case.angles, case.arm.stops, strict=True)
    ]
    if min(tensions.values()) <= 0.0:
        return None
    try:
        found = case.found(
            tensions=tensions,
            bend_angles=angles,
            tension_stddev=stddev,
            bend_angle_stddev=ANGLE_STDDEV,
        )
    except TensionError:
        return None
    return any(low <= force <= high for low, high in found.intervals)


if __name__ == '__main__':
    sys.exit(main())
