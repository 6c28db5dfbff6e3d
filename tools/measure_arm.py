"""Hold `ArmTracker` against brute force on random arms: `make measure-arm`.

Each arm goes through five random loads in a row. The brute force of the tests shares no code with
the package; it lets the joints flow in steps of 1e-4 rad. Where the two part by more than
5e-3 rad, tensions that differ by a thousandth are tried: if the tracker goes the other way too
with one of them, the arm was at a tie, which the steps decide.
"""

from __future__ import annotations

import argparse
import math
import random
import secrets
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'test/support'))

from arm_brute import BruteArm, random_arm, random_load, random_pull

from tendon_statics import ArmTracker, Regime
from tendon_statics.command_line.tables import markdown_table

LOADS = 5
APART = 5e-3
"""rad"""


def main(arguments: list[str] | None = None) -> int:
    """Print how many arms agree."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--arms', type=int, default=60, help='default: %(default)s')
    parser.add_argument('--seed', type=int, help='default: a fresh one')
    options = parser.parse_args(arguments)
    seed = secrets.randbits(32) if options.seed is None else options.seed
    rows = []
    everything = []
    for units in range(2, 7):
        results = [
            compared(random.Random(f'{seed} {units} {arm}'), units)
            for arm in range(options.arms // 5)
        ]
        everything += results
        rows.append(_row(str(units), results))
    rows.append(_row('all', everything))
    header = ('units:', 'arms:', 'slips:', 'within 5e-3 rad [%]:', 'ties:', 'unexplained:')
    print(markdown_table((*header, 'median [rad]:', 'worst of those within [rad]:'), rows))
    print(f'seed {seed}', file=sys.stderr)
    return 0


def compared(draw: random.Random, units: int) -> tuple[str, float, int]:
    """Return how an arm fares, the largest distance in rad, and how many joints slipped."""
    arm = random_arm(draw, units)
    tracker, brute = ArmTracker(arm), BruteArm(arm, [0.0] * units)
    worst, slips = 0.0, 0
    for _ in range(LOADS):
        load = random_load(draw)
        tensions = random_pull(draw, arm, load)
        before = tracker.copy()
        state = tracker.update(tensions, load)
        slips += sum(regime is not Regime.HELD for regime in state.regimes)
        brute.update(tensions, load)
        apart = _apart(tracker, brute)
        if apart > APART:
            return ('tie' if _is_tie(before, brute, tensions, load) else 'other'), apart, slips
        worst = max(worst, apart)
    return 'within', worst, slips


def _apart(tracker: ArmTracker, brute: BruteArm) -> float:
    return max(abs(a - b) for a, b in zip(tracker.bend_angles, brute.angles, strict=True))


def _is_tie(before: ArmTracker, brute: BruteArm, tensions: dict[str, float], load) -> bool:
    draw = random.Random(1)
    for _ in range(40):
        near = {name: value * (1.0 + draw.gauss(0.0, 1e-3)) for name, value in tensions.items()}
        other = before.copy()
        other.update(near, load)
        if _apart(other, brute) <= 4.0 * APART:
            return True
    return False


def _row(name: str, results: list[tuple[str, float, int]]) -> list[str]:
    kinds = Counter(kind for kind, _, _ in results)
    within = sorted(apart for kind, apart, _ in results if kind == 'within') or [math.nan]
    return [
        *(name, str(len(results)), str(sum(slips for _, _, slips in results))),
        f'{100.0 * kinds["within"] / max(len(results), 1):.1f}',
        *(str(kinds['tie']), str(kinds['other'])),
        *(f'{within[len(within) // 2]:.1e}', f'{within[-1]:.1e}'),
    ]


if __name__ == '__main__':
    sys.exit(main())
