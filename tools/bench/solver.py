"""One pair of tensions: `solve` beside NumPy ports and C, and a tracked sample beside `solve`."""

from __future__ import annotations

import dataclasses

import numpy as np

from tendon_statics import (
    JointDesign,
    Regime,
    default_design_path,
    load_design,
    slip_angle_distribution,
    solve,
)
from tendon_statics.physics import UPRIGHT, StickSlipTracker, paper, tensions_for
from tendon_statics.physics.contact import CONTACT_LAWS
from tendon_statics.physics.roots import refine
from tendon_statics.physics.tensions import check_tensions, taut_slip

from . import numpy_port
from .pairs import noisy_pairs
from .rows import Row, at_least, at_most
from .timing import best_times
from .yardstick import Yardstick

TENSION_STDDEV = 0.01
"""N"""

HELD = (1.0, 1.5)
"""Tensions in N at which the preliminary design is held at every angle"""

PORTS = {
    'NumPy port with `scipy.optimize.bisect`': (numpy_port.solve, 15.0),
    'the same, with scalars': (numpy_port.solve_lean, 15.0),
    'the same, what does not depend on the angle worked out before': (
        numpy_port.solve_leanest,
        None,
    ),
}
"""What `solve` stands beside → the function, and how many times faster it is to be"""


ALL_FIELDS = 'one `solve`, published case, all fields'
ANGLE_AND_PRESSURE = 'one `solve`, angle and pressure only'
IN_C = 'the same bisection in C, -O3'


def rows() -> list[Row]:
    """Measure."""
    design = load_design(default_design_path())
    found = [*_all_fields(design), *_angle_and_pressure(design), _tracked(design)]
    found.append(_distribution(design))
    # Last: Python adapts its bytecode to the one law that it has seen, as in any process.
    for law in list(CONTACT_LAWS)[1:]:
        found += _other_law(design, dataclasses.replace(design, contact_law=law))
    return found


def shares() -> dict[str, float]:
    """Measure what part of `solve(...).as_dict()` goes where, in order of the work."""
    design = load_design(default_design_path())
    case = (design, paper.TENSION_L, paper.TENSION_S)
    tensions = check_tensions(*case[1:])
    slip = taut_slip(design, tensions, UPRIGHT)
    first, last = slip.probe(0.0), slip.probe(design.max_bend_angle)
    (bracket,) = slip.brackets(first, last)
    works = {
        'checking the tensions': lambda: check_tensions(*tensions),
        'what is constant for one pair': lambda: taut_slip(design, tensions, UPRIGHT),
        'the ends of the range': lambda: (slip.probe(0.0), slip.probe(design.max_bend_angle)),
        'showing that there is one root': lambda: slip.brackets(first, last),
        'the root': lambda: refine(slip, bracket),
        'solve': lambda: solve(*case),
        'everything': lambda: solve(*case).as_dict(),
    }
    times = best_times([_repeated(work) for work in works.values()], rounds=400)
    *parts, solving, everything = times
    took = dict(zip(works, parts, strict=False))
    took['the rest of `solve`'] = solving - sum(parts)
    took['fields on demand, and the dict'] = everything - solving
    return {part: seconds / everything for part, seconds in took.items()}


def _repeated(work):
    return lambda: [work() for _ in range(20)]


def _all_fields(design: JointDesign) -> list[Row]:
    case = (design, paper.TENSION_L, paper.TENSION_S)
    answer = solve(*case)
    for port, _ in PORTS.values():
        angle, pressure, pressed, rubbed = port(*case)
        said = [answer.bend_angle, answer.pressure, *answer.forces]
        if not np.allclose(said, [angle, pressure, *pressed, *rubbed], rtol=1e-8, atol=1e-9):
            raise RuntimeError(f'solve says {answer}, the NumPy port {angle, pressure}')
    ours, *ports = best_times(
        [
            _repeated(lambda: solve(*case).as_dict()),
            *(lambda port=port: [port(*case) for _ in range(2)] for port, _ in PORTS.values()),
        ],
        rounds=400,
    )
    return [
        _beside_port(ALL_FIELDS, against, (port / 2) / (ours / 20), target)
        for (against, (_, target)), port in zip(PORTS.items(), ports, strict=True)
    ]


def _beside_port(work: str, against: str, ratio: float, target: float | None) -> Row:
    return Row(work, against, ratio) if target is None else at_least(work, against, ratio, target)


def _angle_and_pressure(design: JointDesign) -> list[Row]:
    pairs = noisy_pairs(4000)
    # All alike: the processor learns the one way of the branches by heart, which helps C.
    same = np.tile([paper.TENSION_L, paper.TENSION_S], (4000, 1))
    equation, quartic = Yardstick(design), Yardstick(design, 'quartic')
    return [
        at_most(ANGLE_AND_PRESSURE, IN_C, _beside_c(design, equation, pairs), 12.0),
        Row(
            f'{ANGLE_AND_PRESSURE}, one pair over and over',
            IN_C,
            _beside_c(design, equation, same),
        ),
        Row(ANGLE_AND_PRESSURE, f'{IN_C}, of the quartic', _beside_c(design, quartic, pairs)),
    ]


def _distribution(design: JointDesign) -> Row:
    def distribution() -> list[object]:
        found = slip_angle_distribution(
            design, paper.TENSION_L, paper.TENSION_S, tension_stddev=TENSION_STDDEV
        )
        return [*map(found.probability, Regime), found.interval(0.95)]

    ours, alone = best_times(
        [
            _repeated(distribution),
            _repeated(lambda: solve(design, paper.TENSION_L, paper.TENSION_S).as_dict()),
        ],
        rounds=200,
    )
    work = '`slip_angle_distribution`: the probability of each regime, and an interval'
    return at_most(work, ALL_FIELDS, ours / alone, 5.0)


def _other_law(design: JointDesign, other: JointDesign) -> list[Row]:
    """Return the rows of another law, at the published sum of tensions and angle, beside `merged`.

    At the published tensions themselves it holds the unit.
    """
    total = paper.TENSION_L + paper.TENSION_S
    pair = tensions_for(other, paper.BEND_ANGLE, total_tension=total)
    port, ours = best_times(
        [
            lambda: [numpy_port.solve(design, paper.TENSION_L, paper.TENSION_S) for _ in range(2)],
            _repeated(lambda: solve(other, *pair).as_dict()),
        ],
        rounds=400,
    )
    pairs = noisy_pairs(4000)
    # With less noise: these laws slip over a narrower range of tensions.
    shifted = pair + 0.1 * (pairs - [paper.TENSION_L, paper.TENSION_S])
    beside_c = _beside_c(design, Yardstick(design), pairs, other, shifted)
    name = f'`{other.contact_law}`'
    return [
        Row(f'{ALL_FIELDS}, {name}', f'{next(iter(PORTS))}, `merged`', (port / 2) / (ours / 20)),
        Row(f'{ANGLE_AND_PRESSURE}, {name}', f'{IN_C}, `merged`', beside_c),
    ]


def _beside_c(design, yardstick, pairs, other=None, other_pairs=None) -> float:
    """Return our time over that of C; ours of another law and its pairs, if they are given."""
    works = []
    blocks = np.split(pairs, 50)
    our_blocks = blocks if other is None else np.split(other_pairs, 50)
    for block, our_block in zip(blocks, our_blocks, strict=True):
        tension_l, tension_s = (np.ascontiguousarray(column) for column in block.T)
        python = _python_work(other or design, our_block.tolist())
        c = _c_work(yardstick, tension_l, tension_s)
        if other is None and not np.isclose(python(), c(), rtol=1e-9, atol=0.0):
            raise RuntimeError('solve and the bisection in C do not agree')
        works += [python, c]
    times = best_times(works, rounds=30)
    return sum(times[::2]) / sum(times[1::2])


def _python_work(design, pairs):
    def work() -> float:
        total = 0.0
        for tension_l, tension_s in pairs:
            answer = solve(design, tension_l, tension_s)
            total += answer.bend_angle + answer.pressure
        return total

    return work


def _c_work(yardstick, tension_l, tension_s):
    return lambda: yardstick.solve_each(tension_l, tension_s)


def _tracked(design: JointDesign) -> Row:
    tracker = StickSlipTracker(design, 0.1)
    tracked, alone = best_times(
        [
            _repeated(lambda: tracker.update(*HELD)),
            _repeated(lambda: solve(design, *HELD)),
        ],
        rounds=400,
    )
    return at_most('a tracked sample that is held', '`solve` of a held pair', tracked / alone, 1.5)
