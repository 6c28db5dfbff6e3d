"""``tendon-statics replay``: a recorded session through the model."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from ..files.estimator_parameters import ESTIMATIONS
from ..files.output_file import OutputError
from ..files.unit_file import Unit
from ..physics import JointDesign
from ..recordings.progress import Progress
from ..recordings.recording import Recording
from ..recordings.replay.bag_output import write_bag
from ..recordings.replay.estimates import replay
from ..recordings.replay.result import Replay
from ..recordings.replay.table_output import write_table
from ..recordings.replay.tip_forces import TipForces
from .options import (
    UsageError,
    add_design_option,
    add_load_options,
    add_tension_stddev_option,
    say_written,
    tension_stddev_from,
    tension_stddev_of,
)
from .progress import with_progress
from .recorded_load import recorded_load
from .recorded_tip_force import recorded_tip_forces, tip_force_facts
from .recording_options import (
    add_recording_options,
    report_damage,
    unit_and_recording,
)
from .replay_text import replay_facts
from .tables import fact_lines
from .tip_force_options import add_bend_angle_stddev_option, add_line_options


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_estimation_options(parser)
    add_load_options(parser)
    add_tension_stddev_option(parser, default=None)
    add_line_options(parser, required=False)
    add_bend_angle_stddev_option(parser)
    parser.add_argument(
        '--output',
        type=Path,
        metavar='FILE',
        help=f'write every sample there; ending: {", ".join(_WRITERS)}',
    )


def add_estimation_options(parser: argparse.ArgumentParser, default: str = ESTIMATIONS[0]) -> None:
    """Add what the model is to do with each sample, and by default."""
    parser.add_argument(
        '--estimation',
        choices=ESTIMATIONS,
        help='each sample by itself, or with memory: believing each sample (tracking), or taking '
        f'it for noisy (filtering); default: that of the design file, or {default}',
    )
    add_initial_bend_angle_option(parser)


def add_initial_bend_angle_option(parser: argparse.ArgumentParser) -> None:
    """Add where a tracked unit begins."""
    parser.add_argument(
        '--initial-bend-angle',
        type=float,
        metavar='RAD',
        help='where a unit that is followed is at first, in rad; default: that of the design '
        'file, or 0',
    )


def initial_bend_angle_from(options: argparse.Namespace, unit: Unit) -> float:
    """Return the option, or what the design file says, or 0, in rad."""
    if options.initial_bend_angle is not None:
        return float(options.initial_bend_angle)
    return float(unit.get('initial_bend_angle') or 0.0)


def run(options: argparse.Namespace) -> int:
    """Replay, write the samples, print a summary."""
    write = _writer(options.output)
    unit, recording = unit_and_recording(options)
    if write is not None:
        refuse_within(options.output, options.data)
    replayed = replay_from(options, unit, unit.design, recording)
    facts = replay_facts(replayed, unit, unit.design)
    tips = None
    if options.direction is not None:
        tips = recorded_tip_forces(options, unit, recording)
        facts = [*facts, *tip_force_facts(tips)]
    if write is not None:
        write(options.output, replayed, tips, with_progress)
    print(fact_lines(facts))
    if write is not None:
        say_written(options.output, options)
    return report_damage(recording)


def replay_from(
    options: argparse.Namespace,
    unit: Unit,
    design: JointDesign,
    recording: Recording,
    progress: Progress = with_progress,
    default: str = ESTIMATIONS[0],
) -> Replay:
    """Replay a recording as the options and the unit's file ask for, with a design of it.

    Where they do not say how each sample is estimated, it is done as `default` says.
    """
    estimation = options.estimation or unit.get('estimation') or default
    if estimation == 'filtering' and tension_stddev_of(options, unit) is None:
        raise UsageError(
            'estimation is filtering, which needs the noise of the load cells: give '
            '--tension-stddev, in N, or tension_stddev in the design file; tendon-statics tare '
            'says how far readings of slack cables scatter'
        )
    return replay(
        design,
        recording,
        estimation,
        settings=unit.settings,
        load=recorded_load(options, unit, recording),
        initial_bend_angle=initial_bend_angle_from(options, unit),
        tension_stddev=tension_stddev_from(options, unit),
        progress=progress,
    )


def refuse_within(path: Path, recording: Path) -> None:
    """Keep a recording from being written over.

    Raises
    ------
    OutputError
        If a file is the recording, or would become part of the bag that is or holds it.
    """
    output, data = path.resolve(), recording.resolve()
    into_its_bag = output.parent == data.parent and (output.parent / 'metadata.yaml').exists()
    if output.is_relative_to(data) or (into_its_bag and output.suffix == '.mcap'):
        raise OutputError(
            f'{path}: it is the recording itself, or lies in it, which must stay as it is; name '
            'another file'
        )


def _writer(path: Path | None) -> _Writer | None:
    """Return what writes such a file; looked up before the work, lest that be in vain."""
    if path is None:
        return None
    if path.suffix not in _WRITERS:
        raise OutputError(f'{path}: a replay is written to a file ending in {", ".join(_WRITERS)}')
    return _WRITERS[path.suffix]


def _write_table(path: Path, replayed: Replay, tips: TipForces | None, progress: Progress) -> None:
    columns = replayed.columns() | ({} if tips is None else tips.columns())
    write_table(path, columns, progress)


def _write_bag(path: Path, replayed: Replay, _tips: TipForces | None, progress: Progress) -> None:
    write_bag(path, replayed, progress)


_Writer = Callable[[Path, Replay, TipForces | None, Progress], None]
_WRITERS: dict[str, _Writer] = {
    '.csv': _write_table,
    '.parquet': _write_table,
    '.mcap': _write_bag,
}
