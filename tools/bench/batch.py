"""Many pairs of tensions: `solve_batch` beside C and beside a loop of `solve`, and its memory."""

from __future__ import annotations

import dataclasses
import tracemalloc

import numpy as np

from tendon_statics import (
    EquilibriumBatch,
    JointDesign,
    TensionError,
    default_design_path,
    load_design,
    solve,
    solve_batch,
)
from tendon_statics.physics import UPRIGHT
from tendon_statics.physics.array_numbers import ARRAYS
from tendon_statics.physics.batch import INVALID, REGIME_CODES, results, solver
from tendon_statics.physics.contact import CONTACT_LAWS
from tendon_statics.physics.loaded_joint import LoadedJoint
from tendon_statics.physics.slip import Slip

from .rows import Row, at_least, at_most
from .stop_watches import StopWatches
from .timing import best_times
from .yardstick import Yardstick

PAIRS = 1_000_000
LOOPED = 20_000
"""Pairs on which the loop is timed"""
ROUNDS = 6
MANY = 10_000_000
TOLERANCE = 1e-9
REST = 'pressure, and the rest'
"""Of a batch, what is not measured by itself"""


def rows() -> list[Row]:
    """Measure."""
    design = load_design(default_design_path())
    return [*_speed(design), *_memory(design)]


def shares() -> dict[str, float]:
    """Measure what part of a batch with all fields goes where."""
    design = load_design(default_design_path())
    tensions = mixed_pairs(design, PAIRS)
    parts = (
        (solver, 'facing_slips', 'what is constant for each pair'),
        (solver, 'array_brackets', 'counting and bracketing roots'),
        (solver, 'array_refine', 'the roots'),
        (solver, '_solve_chunk', 'sorting pairs by regime, writing fields'),
        (results, '_gradients_of', 'gradients'),
        (results, 'contact_forces', 'forces and remainder'),
    )
    with StopWatches(REST) as watches:
        for owner, name, part in parts:
            watches.put_on(owner, name, part)
        took = []
        for _ in range(ROUNDS):
            watches.start()
            all_fields(solve_batch(design, *tensions))
            watches.turn_to('')
            took.append(watches.took)
    shortest = min(took, key=lambda of_round: of_round.total())
    in_order = [part for *_, part in parts] + [REST]
    return {part: shortest[part] / shortest.total() for part in in_order}


def mixed_pairs(design: JointDesign, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Draw tensions over all regimes: a third on the verge of slipping, one in a hundred slack."""
    draw = np.random.default_rng(1)
    tension_l, tension_s = draw.uniform(0.0, 3.0, (2, count))
    slipping = draw.random(count) < 1.0 / 3.0
    angle = draw.uniform(0.0, design.max_bend_angle, count)
    total = draw.uniform(1.0, 5.0, count)
    # With equal tensions M is all but that of the cables, which make up for what K has beyond it.
    joint, even = LoadedJoint.of(design, UPRIGHT.on(design)), 0.5 * total
    slip = Slip(joint, total - joint.size, even, even, numbers=ARRAYS)
    difference = -slip.value(angle) * total / design.relative_lever
    difference *= draw.choice([-1.0, 1.0], count)
    tension_l[slipping] = 0.5 * (total - difference)[slipping]
    tension_s[slipping] = 0.5 * (total + difference)[slipping]
    tension_l[draw.random(count) < 0.01] = 0.0
    return tension_l, tension_s


def all_fields(batch: EquilibriumBatch) -> list[np.ndarray]:
    """Ask for all fields, those worked out on demand included; the first four are no numbers."""
    return [
        *(batch.regime, batch.root_count, batch.stable, batch.branch_consistent),
        *(batch.bend_angle, batch.pressure, batch.normal_force, batch.residual),
        *batch.forces,
        *batch.force_remainder,
        *batch.bend_angle_gradient,
        *batch.pressure_gradient,
    ]


def _speed(design: JointDesign) -> list[Row]:
    tension_l, tension_s = mixed_pairs(design, PAIRS)
    equation, quartic = Yardstick(design), Yardstick(design, 'quartic')
    for yardstick in (equation, quartic):
        _check_against_c(yardstick, solve_batch(design, tension_l, tension_s))
    some_l, some_s = tension_l[:LOOPED], tension_s[:LOOPED]
    _check_against_loop(solve_batch(design, some_l, some_s))
    pairs = list(zip(some_l.tolist(), some_s.tolist(), strict=True))
    others = [dataclasses.replace(design, contact_law=law) for law in list(CONTACT_LAWS)[1:]]
    other_pairs = [mixed_pairs(other, PAIRS) for other in others]
    batch, c, c_of_quartic, loop = best_times(
        [
            lambda: all_fields(solve_batch(design, tension_l, tension_s)),
            lambda: equation.solve_many(tension_l, tension_s),
            lambda: quartic.solve_many(tension_l, tension_s),
            lambda: [_solved_alone(design, *pair) for pair in pairs],
        ],
        rounds=ROUNDS,
    )
    of_others = best_times(
        [
            lambda other=other, tensions=tensions: all_fields(solve_batch(other, *tensions))
            for other, tensions in zip(others, other_pairs, strict=True)
        ],
        rounds=3,
    )
    work, against = (
        '`solve_batch`, 10^6 mixed pairs, all fields',
        'bisection in C, -O3, one thread',
    )
    return [
        at_most(work, against, batch / c, 1.0),
        Row(work, f'{against}, of the quartic', batch / c_of_quartic),
        *(
            Row(f'{work}, `{other.contact_law}`', f'{against}, of `merged`', time / c)
            for other, time in zip(others, of_others, strict=True)
        ),
        at_least(
            '`solve_batch`, the same',
            'a loop of `solve`, all fields',
            (loop / LOOPED) / (batch / PAIRS),
            30.0,
        ),
    ]


def _memory(design: JointDesign) -> list[Row]:
    tension_l, tension_s = mixed_pairs(design, PAIRS)
    tension_l, tension_s = np.tile(tension_l, MANY // PAIRS), np.tile(tension_s, MANY // PAIRS)
    ten_arrays = 10 * tension_l.nbytes
    against = '10 float64 arrays of that length'
    tracemalloc.start()
    batch = solve_batch(design, tension_l, tension_s)
    solved = tracemalloc.get_traced_memory()[1]
    all_fields(batch)
    complete = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    work = 'peak memory of `solve_batch` at 10^7 pairs'
    return [
        at_most(work, against, solved / ten_arrays, 1.5),
        at_most(f'{work}, all fields asked for', against, complete / ten_arrays, 1.5),
    ]


def _solved_alone(design: JointDesign, tension_l: float, tension_s: float) -> dict | None:
    try:
        return solve(design, tension_l, tension_s).as_dict()
    except TensionError:
        return None


def _check_against_c(yardstick: Yardstick, batch: EquilibriumBatch) -> None:
    numbers, codes = yardstick.solve_many(batch.tension_l, batch.tension_s)
    ours = all_fields(batch)
    same = [
        np.array_equal(mine, other)
        for mine, other in zip(ours[:4], codes[[0, 1, 3, 4]], strict=True)
    ]
    # The shorter form of N_f that C takes has lost digits where R is next to nothing.
    same.append(np.allclose(ours[4], numbers[0], rtol=0.0, atol=TOLERANCE, equal_nan=True))
    same.append(np.allclose(ours[5], numbers[1], rtol=TOLERANCE, atol=0.0, equal_nan=True))
    if not all(same):
        raise RuntimeError('solve_batch and the bisection in C do not agree')


def _check_against_loop(batch: EquilibriumBatch) -> None:
    for index, pair in enumerate(zip(batch.tension_l, batch.tension_s, strict=True)):
        alone = _solved_alone(batch.design, *map(float, pair))
        code = batch.regime[index]
        if alone is None:
            same = code == INVALID
        else:
            angle, pressure = (
                np.nan if alone[name] is None else alone[name]
                for name in ('bend_angle', 'pressure')
            )
            same = (
                code == REGIME_CODES[alone['regime']]
                and batch.root_count[index] == alone['root_count']
                and np.allclose(
                    [batch.bend_angle[index], batch.pressure[index]],
                    [angle, pressure],
                    rtol=TOLERANCE,
                    atol=TOLERANCE,
                    equal_nan=True,
                )
            )
        if not same:
            raise RuntimeError(f'solve_batch and solve do not agree at {pair} N')
