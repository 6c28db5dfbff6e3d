"""Measure how well the filter tells a model that is wrong from one that is right.

`make measure-consistency`: sessions with an encoder, whose unit has a fault that the filter's
design does not know, or none. See docs/filter.md.
"""

from __future__ import annotations

import argparse
import dataclasses
import itertools
import math
import secrets
import sys
from collections.abc import Callable
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
from measure_filter.readings import readings
from measure_filter.sessions import PROGRAMS, UNITS, Floats, Session, session, slip_tension

from tendon_statics import JointDesign, TensionError
from tendon_statics.command_line.tables import markdown_table
from tendon_statics.physics.filter.consistency import SLIPS, STATISTICS, Consistency
from tendon_statics.physics.filter.scores import MOST, Boundary, Score

ALARM = 1e-9
"""Consistency below which the model counts as refuted"""

ENCODER = math.radians(0.2)
"""Standard deviation of a measured angle in rad"""

DEVIATIONS = 3.0
"""Of a score, by which a fault moves the boundary"""

LEVELS = (2.0, 3.0, 3.5)
"""Scores whose exceedance is compared with that of a normal distribution"""

COUNTS = range(3, SLIPS + 1)
"""How many scores may add up to an alarm, as each counts `MOST` at the most"""

TILTS = np.linspace(0.2, 12.0, 60)
"""λ of Chernoff's bound of a sum of scores"""


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
    slips: list[tuple[Score, ...]]
    """Of each slip the scores of its onset and, if there was one, of its slide"""
    least: float
    """Lowest consistency"""
    seconds: float


def run(drawn: Session, fault: Fault, random: np.random.Generator) -> Run:
    """Judge a session, as the filter does that has the design of a fault."""
    stop = fault.design.max_bend_angle
    angles = fault.angle_sign * drawn.bend_angle + random.normal(0.0, ENCODER, len(drawn.time))
    tensions = np.array([drawn.tension_l, drawn.tension_s + fault.bias])
    judge = Consistency(Boundary(fault.design, 0.0, None))
    found_after, least = math.inf, 1.0
    slips: list[Any] = []
    for reading in readings(
        drawn.time, tensions, np.clip(angles, -stop, stop), drawn.noise, ENCODER
    ):
        try:
            judge.take(reading)
        except TensionError:
            judge.interrupt()
        newest = judge._slips[-1] if judge._slips else None
        if newest is not None and not (slips and newest is slips[-1]):
            slips.append(newest)
        if not math.isnan(judge.probability):
            least = min(least, judge.probability)
            if judge.probability < ALARM:
                found_after = min(found_after, len(slips))
    scores = [
        tuple(score for score in (slip.onset, slip.slide.score) if score is not None)
        for slip in slips
    ]
    return Run(found_after, scores, least, drawn.time[-1])


def deviation_of(runs: list[Run]) -> float:
    """Deviation of the boundary in N as one slip tells it, by the better of its scores."""
    return float(
        np.median([min(score.deviation for score in slip) for one in runs for slip in one.slips])
    )


def moved(
    design: JointDesign, weak: float, shift: float, change: Callable[[float], JointDesign]
) -> JointDesign:
    """A design changed by a factor so that it slips at so many newtons more."""
    target = slip_tension(design, weak, 0.0) + shift
    low, high = 0.8, 1.25
    rising = slip_tension(change(high), weak, 0.0) > slip_tension(change(low), weak, 0.0)
    for _ in range(50):
        middle = 0.5 * (low + high)
        if (slip_tension(change(middle), weak, 0.0) < target) == rising:
            low = middle
        else:
            high = middle
    return change(0.5 * (low + high))


def faults(unit: str, shift: float) -> dict[str, Fault]:
    """The faults of a unit that move its boundary by so many newtons, and others."""
    design, weak = UNITS[unit]

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
        'bias': Fault(design, bias=shift),
        'bias of 0.03 N': Fault(design, bias=math.copysign(0.03, shift)),
        'slipped cable': Fault(moved(design, weak, shift, lever)),
        'swapped sign': Fault(design, angle_sign=-1.0),
    }


def main() -> int:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description='Measure the consistency of StickSlipFilter.')
    parser.add_argument('--sessions', type=int, default=4, metavar='N', help='of each row')
    parser.add_argument('--seconds', type=float, default=14.0, metavar='S', help='of a session')
    parser.add_argument('--noise', type=float, default=0.01, metavar='N', help='in N')
    parser.add_argument('--rate', type=float, default=500.0, metavar='HZ')
    parser.add_argument('--unit', choices=UNITS, help='default: all')
    parser.add_argument('--right', action='store_true', help='only the right model')
    parser.add_argument('--program', choices=('strokes', *PROGRAMS), help='of the right model')
    parser.add_argument('--seed', type=int, default=secrets.randbelow(2**31), metavar='N')
    options = parser.parse_args()
    random = np.random.default_rng(options.seed)
    rows, right = [], []
    programs = ['strokes', *(PROGRAMS if options.right else ())]
    if options.program:
        programs = [options.program]

    def drawn(unit: str, program: str) -> Session:
        print('.', end='', file=sys.stderr, flush=True)
        return session(unit, program, options.noise, options.rate, options.seconds, random)

    for unit in [options.unit] if options.unit else UNITS:
        design, _ = UNITS[unit]
        runs = [
            run(drawn(unit, program), Fault(design), random)
            for _, program in zip(range(options.sessions), itertools.cycle(programs), strict=False)
        ]
        right += runs
        deviation = deviation_of(runs)
        rows.append((unit, 'none', f'{1e3 * deviation:.1f}', *_row(runs)))
        if options.right:
            continue
        of_fault: dict[str, list[Run]] = {}
        for number in range(options.sessions):
            shift = DEVIATIONS * deviation * (-1.0) ** number
            for name, fault in faults(unit, shift).items():
                of_fault.setdefault(name, []).append(run(drawn(unit, 'strokes'), fault, random))
        rows += [(unit, name, '', *_row(runs)) for name, runs in of_fault.items()]
    print(file=sys.stderr)
    titles = ('unit', 'fault', 'deviation [mN]:', 'score:', 'slips:', 'found [%]:')
    print(markdown_table((*titles, 'within ten slips [%]:', 'slips until found:'), rows))
    _print_right(right)
    print(
        f'\n{options.sessions} sessions of {options.seconds:g} s at {options.rate:g} Hz and '
        f'{1e3 * options.noise:g} mN, seed {options.seed}'
    )
    return 0


def _row(runs: list[Run]) -> tuple[str, ...]:
    slips = [slip for one in runs for slip in one.slips]
    scores = [abs(score.value) for slip in slips for score in slip if score.value]
    after = [one.found_after for one in runs]
    found = [one for one in after if math.isfinite(one)]
    return (
        f'{np.median(scores):.1f}' if scores else '-',
        f'{len(slips) / len(runs):.0f}',
        f'{100.0 * len(found) / len(runs):.0f}',
        f'{100.0 * np.mean([one <= SLIPS for one in after]):.0f}',
        f'{np.median(found):.0f}, at most {max(found):.0f}' if found else '-',
    )


def _print_right(runs: list[Run]) -> None:
    """Say how the scores are distributed while the model is right."""
    hours = sum(one.seconds for one in runs) / 3600.0
    alarms = sum(math.isfinite(one.found_after) for one in runs)
    slips = [slip for one in runs for slip in one.slips]
    print(
        f'\nWith the right model: {hours:.2f} h, {len(slips)} slips, '
        f'{alarms} false alarms, lowest consistency {min(one.least for one in runs):.1e}.'
    )
    for name, found in (
        ('Onsets', [slip[0].value for slip in slips]),
        ('Slides', [slip[1].value for slip in slips if len(slip) > 1]),
    ):
        if not found:
            continue
        scores = np.array(found)
        shares = ', '.join(
            f'{np.mean(np.abs(scores) > level):.1e} beyond {level:g} '
            f'(normal {math.erfc(level / math.sqrt(2.0)):.1e})'
            for level in LEVELS
        )
        print(f'{name}: {shares}; largest {np.abs(scores).max():.1f}.')
        print(
            f'{name}: at {24.0 * len(slips) / hours:.0f} slips a day at most '
            f'{24.0 * len(scores) / hours * 2.0 * likeliest_alarm(scores):.1e} false alarms a day.'
        )


def likeliest_alarm(scores: Floats) -> float:
    """Bound the probability that the newest scores add up to an alarm.

    Chernoff's: P(|Σ| ≥ z √n) ≤ 2 min over λ of M(λ)ⁿ exp(−λ z √n), if scores are independent.
    M is the mean of exp(λ score) over those seen, for the worse side; the worst n counts.
    """
    counted = np.clip(scores, -MOST, MOST)
    both = np.array([TILTS, -TILTS])
    generating = np.exp(both[..., None] * counted).mean(axis=-1).max(axis=0)
    sum_at_alarm = -NormalDist().inv_cdf(0.5 * ALARM / STATISTICS)
    exponents = [
        np.min(count * np.log(generating) - TILTS * sum_at_alarm * math.sqrt(count))
        for count in COUNTS
    ]
    return 2.0 * math.exp(max(exponents))


if __name__ == '__main__':
    sys.exit(main())
