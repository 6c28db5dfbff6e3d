"""``tendon-statics sweep``: a map of the answers over both cable tensions."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..files.output_file import OutputError
from ..physics.batch import EquilibriumBatch, solve_batch
from ..recordings.replay.table_output import write_arrays, write_table
from .options import (
    UsageError,
    add_design_option,
    add_load_options,
    design_and_load,
    say_written,
)
from .progress import with_progress
from .tables import markdown_table

ENDINGS = ('.npz', '.csv', '.parquet')
MAX_POINTS = 5000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_grid_options(parser)
    add_design_option(parser)
    parser.add_argument(
        '--output',
        type=Path,
        required=True,
        metavar='FILE',
        help=f'ending: {", ".join(ENDINGS)}',
    )


def add_grid_options(parser: argparse.ArgumentParser) -> None:
    """Add the tensions at which to look, and the load."""
    for cable in ('l', 's'):
        parser.add_argument(
            f'--tension-{cable}-range',
            type=float,
            nargs=2,
            default=(0.1, 3.0),
            metavar=('FROM', 'TO'),
            help=f'tensions of cable {cable} in N; default: 0.1 to 3',
        )
    parser.add_argument(
        '--points',
        type=int,
        default=101,
        help='along each of the two, with both ends; default: %(default)s',
    )
    add_load_options(parser)


def grid_from(options: argparse.Namespace) -> EquilibriumBatch:
    """Solve at every pair of the tensions; arrays of shape ``(T_l, T_s)``."""
    if not 2 <= options.points <= MAX_POINTS:
        raise UsageError(f'--points is {options.points}, allowed is 2 to {MAX_POINTS}')
    axes = []
    for name in ('tension_l_range', 'tension_s_range'):
        low, high = getattr(options, name)
        if not 0.0 <= low < high < np.inf:
            raise UsageError(
                f'--{name.replace("_", "-")} is {low:g} to {high:g} N, which must rise from 0 on'
            )
        axes.append(np.linspace(low, high, options.points))
    design, load = design_and_load(options)
    return solve_batch(design, axes[0][:, None], axes[1][None, :], load)


def run(options: argparse.Namespace) -> None:
    """Solve, write the map, print how much of it each regime takes."""
    path: Path = options.output
    if path.suffix not in ENDINGS:
        raise OutputError(f'{path}: a map is written to a file ending in {", ".join(ENDINGS)}')
    answers = grid_from(options)
    arrays: dict[str, NDArray[Any]] = {
        'tension_l': answers.tension_l,
        'tension_s': answers.tension_s,
        'regime': answers.regime_names,
        'bend_angle': answers.bend_angle,
        'pressure': answers.pressure,
        'root_count': answers.root_count,
        'stable': answers.stable,
        'bend_angle_by_tension_l': np.asarray(answers.bend_angle_gradient.tension_l),
        'bend_angle_by_tension_s': np.asarray(answers.bend_angle_gradient.tension_s),
        'pressure_by_tension_l': np.asarray(answers.pressure_gradient.tension_l),
        'pressure_by_tension_s': np.asarray(answers.pressure_gradient.tension_s),
    }
    if path.suffix == '.npz':
        axes = {'tension_l': arrays['tension_l'][:, 0], 'tension_s': arrays['tension_s'][0]}
        write_arrays(path, arrays | axes)
    else:
        write_table(path, {name: values.ravel() for name, values in arrays.items()}, with_progress)
    names, counts = np.unique(answers.regime_names, return_counts=True)
    rows = [
        (str(name), str(count), f'{100.0 * count / answers.regime.size:.3g}')
        for name, count in zip(names, counts, strict=True)
    ]
    print(markdown_table(('regime', 'points:', '%:'), rows))
    say_written(path, options)
