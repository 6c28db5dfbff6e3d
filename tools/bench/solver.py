"""One pair of tensions: `solve` beside a NumPy port, and beside C."""

from __future__ import annotations

import numpy as np

from tendon_statics import default_design_path, load_design, solve
from tendon_statics.physics import paper
from tendon_statics.physics.roots import SlipEquation
from tendon_statics.physics.solver import check_tensions

from . import numpy_port
from .pairs import noisy_pairs
from .rows import Row, at_least, at_most
from .timing import best_times
from .yardstick import Yardstick


def rows() -> list[Row]:
    """Measure."""
    design = load_design(default_design_path())
    return [_all_fields(design), *_angle_and_pressure(design)]


def shares() -> dict[str, float]:
    """Measure what part of `solve(...).as_dict()` goes where, in order of the work."""
    design = load_design(default_design_path())
    case = (design, paper.TENSION_L, paper.TENSION_S)
    equation = SlipEquation(*case)
    search = (0.0, design.max_bend_angle)
    (bracket,) = equation.brackets(*search)
    checking, coefficients, counting, bisection, solving, everything = best_times(
        [
            lambda: [check_tensions(*case) for _ in range(20)],
            lambda: [SlipEquation(*case) for _ in range(20)],
            lambda: [equation.brackets(*search) for _ in range(20)],
            lambda: [equation.bisect(*bracket) for _ in range(20)],
            lambda: [solve(*case) for _ in range(20)],
            lambda: [solve(*case).as_dict() for _ in range(20)],
        ],
        rounds=400,
    )
    parts = {
        'checking the tensions': checking,
        'coefficients of one pair': coefficients,
        'showing that there is one root': counting,
        'bisection': bisection,
        'the rest of `solve`': solving - checking - coefficients - counting - bisection,
        'fields on demand, and the dict': everything - solving,
    }
    return {part: seconds / everything for part, seconds in parts.items()}


def _all_fields(design) -> Row:
    case = (design, paper.TENSION_L, paper.TENSION_S)
    answer, port = solve(*case), numpy_port.solve(*case)
    if abs(answer.bend_angle - port[0]) > 1e-9 or abs(answer.pressure / port[1] - 1.0) > 1e-9:
        raise RuntimeError(f'solve says {answer}, the NumPy port {port}')
    ours, theirs = best_times(
        [
            lambda: [solve(*case).as_dict() for _ in range(20)],
            lambda: [numpy_port.solve(*case) for _ in range(2)],
        ],
        rounds=400,
    )
    return at_least(
        'one `solve`, published case, all fields',
        'NumPy port with `scipy.optimize.bisect`',
        (theirs / 2) / (ours / 20),
        15.0,
    )


def _angle_and_pressure(design) -> list[Row]:
    pairs = noisy_pairs(4000)
    # All alike: the processor learns the one way of the branches by heart, which helps C.
    same = np.tile([paper.TENSION_L, paper.TENSION_S], (4000, 1))
    equation, quartic = Yardstick(design), Yardstick(design, 'quartic')
    work, against = 'one `solve`, angle and pressure only', 'the same bisection in C, -O3'
    return [
        at_most(work, against, _beside_c(design, equation, pairs), 12.0),
        Row(f'{work}, one pair over and over', against, _beside_c(design, equation, same)),
        Row(work, f'{against}, of the quartic', _beside_c(design, quartic, pairs)),
    ]


def _beside_c(design, yardstick, pairs) -> float:
    works = []
    for block in np.split(pairs, 50):
        tension_l, tension_s = (np.ascontiguousarray(column) for column in block.T)
        python, c = _python_work(design, block.tolist()), _c_work(yardstick, tension_l, tension_s)
        if not np.isclose(python(), c(), rtol=1e-9, atol=0.0):
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
