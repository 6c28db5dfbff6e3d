"""Measure how well the filter tells a model that is wrong from one that is right.

`make measure-consistency`: sessions with an encoder, whose unit has a fault that the filter's
design does not know, or none. See docs/filter.md.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import secrets
import sys
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from measure_filter.sessions import PROGRAMS, UNITS, Session, session, slip_tension

from tendon_statics import JointDesign, StickSlipFilter, TensionError
from tendon_statics.command_line.tables import markdown_table
from tendon_statics.physics.filter.consistency import SLIPS
from tendon_statics.physics.filter.scores import Score

ALARM = 1e-9
"""Consistency below which the model counts as refuted"""

ENCODER = math.radians(0.2)
"""Standard deviation of a measured angle in rad"""

LEVELS = (2.0, 3.0, 4.0)
"""Scores whose exceedance is compared with that of a normal distribution"""


class Fault(NamedTuple):
    """What is wrong: of the design that the filter has, of the tensions, of the angle."""

    design: JointDesign
    bias: float = 0.0
    """Of T_s in N"""
    angle_sign: float = 1.0


class Run(NamedTuple):
    """What one session showed."""

    found_after: float
    """Slips until the first alarm; infinite without one"""
    slips: int
    scores: list[Score]
    """Of onsets and landings"""
    least: float
    """Lowest consistency"""
    seconds: float


def run(drawn: Session, fault: Fault, random: np.random.Generator) -> Run:
    """Run the filter over a session."""
    found = StickSlipFilter(fault.design, tension_stddev=drawn.noise)
    judge = found._consistency
    found_after, least, seen, scores = math.inf, 1.0, 0, []
    stop = fault.design.max_bend_angle
    last = None
    for time, angle, _, tension_l, tension_s in drawn.samples:
        try:
            found.update(tension_l, tension_s + fault.bias, time)
        except TensionError:
            continue
        reading = fault.angle_sign * angle + random.normal(0.0, ENCODER)
        found.measure(min(max(reading, -stop), stop), ENCODER)
        newest = judge._slips[-1] if judge._slips else None
        if newest is not last:
            # A landing is judged anew while the slip goes on; the last one counts.
            if last is not None and newest is not None and newest.onset is last.onset:
                scores[-1] = newest.landing
            elif newest is not None:
                seen += 1
                scores += newest.onset, newest.landing
            last = newest
        if not math.isnan(found.consistency):
            least = min(least, found.consistency)
            if found.consistency < ALARM:
                found_after = min(found_after, seen)
    return Run(found_after, seen, scores, least, float(drawn.time[-1]))


def moved(
    design: JointDesign, weak: float, shift: float, change: Callable[[float], JointDesign]
) -> JointDesign:
    """A design changed by a factor so that it slips at so many newtons more."""
    target = slip_tension(design, weak, 0.0) + shift
    low, high = 1.0, 3.0
    rising = slip_tension(change(high), weak, 0.0) > slip_tension(design, weak, 0.0)
    if not rising:
        low, high = 1.0 / 3.0, 1.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        if (slip_tension(change(middle), weak, 0.0) < target) == rising:
            low = middle
        else:
            high = middle
    return change(0.5 * (low + high))


def faults(unit: str, deviation: float) -> dict[str, Fault]:
    """The faults of a unit that move its boundary by three deviations in N, and others."""
    design, weak = UNITS[unit]
    shift = 3.0 * deviation

    def friction(factor: float) -> JointDesign:
        return dataclasses.replace(
            design, friction_coefficient=design.friction_coefficient * factor
        )

    def lever(factor: float) -> JointDesign:
        # A cable that has slipped off its guide pulls at another distance.
        offset = (design.ball_radius + design.cable_offset) * factor - design.ball_radius
        return dataclasses.replace(design, cable_offset=max(offset, 0.0))

    return {
        'friction coefficient': Fault(moved(design, weak, shift, friction)),
        'bias of 3 deviations': Fault(design, bias=shift),
        'bias of 0.03 N': Fault(design, bias=0.03),
        'slipped cable': Fault(moved(design, weak, shift, lever)),
        'swapped sign': Fault(design, angle_sign=-1.0),
    }


def main() -> int:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description='Measure the consistency of StickSlipFilter.')
    parser.add_argument('--sessions', type=int, default=4, metavar='N', help='of each row')
    parser.add_argument('--seconds', type=float, default=30.0, metavar='S', help='of a session')
    parser.add_argument('--noise', type=float, default=0.01, metavar='N', help='in N')
    parser.add_argument('--rate', type=float, default=500.0, metavar='HZ')
    parser.add_argument('--right', action='store_true', help='only the right model')
    parser.add_argument('--seed', type=int, default=secrets.randbelow(2**31), metavar='N')
    options = parser.parse_args()
    random = np.random.default_rng(options.seed)
    rows, right = [], []

    def runs_of(unit: str, fault: Fault, programs: Sequence[str]) -> list[Run]:
        runs = []
        for number in range(options.sessions):
            program = programs[number % len(programs)]
            drawn = session(unit, program, options.noise, options.rate, options.seconds, random)
            runs.append(run(drawn, fault, random))
            print('.', end='', file=sys.stderr, flush=True)
        return runs

    for unit, (design, _) in UNITS.items():
        runs = runs_of(unit, Fault(design), ('strokes', *PROGRAMS))
        right += runs
        deviation = float(np.nanmedian([score.deviation for one in runs for score in one.scores]))
        rows.append((unit, 'none', f'{1e3 * deviation:.1f}', *_row(runs)))
        for name, fault in faults(unit, deviation).items() if not options.right else ():
            rows.append((unit, name, '', *_row(runs_of(unit, fault, ('strokes',)))))
    print(file=sys.stderr)
    titles = ('unit', 'fault', 'deviation [mN]:', 'score:', 'slips:', 'found [%]:')
    print(markdown_table((*titles, 'within ten slips [%]:', 'slips until found:'), rows))
    if right:
        _print_right(right)
    print(
        f'\n{options.sessions} sessions of {options.seconds:g} s at {options.rate:g} Hz and '
        f'{1e3 * options.noise:g} mN, seed {options.seed}'
    )
    return 0


def _row(runs: list[Run]) -> tuple[str, ...]:
    scores = [abs(score.value) for one in runs for score in one.scores if score.value]
    after = [one.found_after for one in runs]
    found = [one for one in after if math.isfinite(one)]
    return (
        f'{np.median(scores):.1f}' if scores else '-',
        f'{np.mean([one.slips for one in runs]):.0f}',
        f'{100.0 * len(found) / len(runs):.0f}',
        f'{100.0 * np.mean([one <= SLIPS for one in after]):.0f}',
        f'{np.median(found):.0f}, at most {max(found):.0f}' if found else '-',
    )


def _print_right(runs: list[Run]) -> None:
    """Say how the scores are distributed while the model is right."""
    scores = np.array([score.value for one in runs for score in one.scores])
    hours = sum(one.seconds for one in runs) / 3600.0
    alarms = sum(math.isfinite(one.found_after) for one in runs)
    print(
        f'\nWith the right model: {hours:.2f} h, {sum(one.slips for one in runs)} slips, '
        f'{alarms} false alarms, lowest consistency {min(one.least for one in runs):.1e}.'
    )
    for level in LEVELS:
        share = np.mean(np.abs(scores) > level)
        normal = math.erfc(level / math.sqrt(2.0))
        print(f'Scores beyond {level:g}: {share:.5f}, of a normal distribution {normal:.5f}.')
    print(f'Largest score {np.abs(scores).max():.1f}.')


if __name__ == '__main__':
    sys.exit(main())
