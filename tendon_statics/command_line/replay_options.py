"""What the verbs that replay a recording have in common."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import NamedTuple

from ..files.estimator_parameters import ESTIMATIONS
from ..files.output_file import OutputError
from ..files.unit_file import Unit
from ..physics import JointDesign
from ..recordings.progress import Progress
from ..recordings.recording import Recording
from ..recordings.replay.estimates import replay
from ..recordings.replay.result import Replay
from ..recordings.replay.tip_forces import TipForces
from .options import (
    UsageError,
    add_bend_angle_stddev_option,
    add_design_option,
    add_load_options,
    add_tension_stddev_option,
    bend_angle_stddev_from,
    tension_stddev_from,
    tension_stddev_of,
)
from .progress import with_progress
from .recorded_load import recorded_load
from .recorded_tip_force import recorded_tip_forces, tip_force_facts
from .recording_options import add_recording_options, unit_and_recording
from .replay_text import replay_facts
from .tables import Facts
from .tip_force_options import add_line_options

_MEANINGS = {
    'equilibrium': 'each sample by itself',
    'tracking': 'with memory, believing each sample',
    'filtering': 'with memory, taking each sample for noisy',
}


class Replayed(NamedTuple):
    """A recording of a unit, and what the model says of it."""

    unit: Unit
    recording: Recording
    replay: Replay
    tips: TipForces | None
    """What pushes at the tip, if it was asked for"""

    @property
    def facts(self) -> Facts:
        """The same in words."""
        tips = [] if self.tips is None else tip_force_facts(self.tips)
        return [*replay_facts(self.replay, self.unit, self.unit.design), *tips]


def add_replay_options(
    parser: argparse.ArgumentParser,
    endings: Collection[str],
    estimations: Sequence[str] = ESTIMATIONS,
) -> None:
    """Add all that a replay hangs on, and where it is written; see `replayed`."""
    add_recording_options(parser)
    add_design_option(parser)
    add_estimation_options(parser, estimations[0], estimations)
    add_load_options(parser)
    add_tension_stddev_option(parser, default=None)
    add_line_options(parser, required=False)
    add_bend_angle_stddev_option(parser)
    parser.add_argument(
        '--output',
        type=Path,
        metavar='FILE',
        help=f'write every sample there; ending: {", ".join(endings)}',
    )


def add_estimation_options(
    parser: argparse.ArgumentParser,
    default: str = ESTIMATIONS[0],
    estimations: Sequence[str] = ESTIMATIONS,
) -> None:
    """Add what the model is to do with each sample, and by default."""
    parser.add_argument(
        '--estimation',
        choices=estimations,
        help='; '.join(f'{name}: {_MEANINGS[name]}' for name in estimations)
        + f'; default: that of the design file, or {default}',
    )
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


def replayed(
    options: argparse.Namespace,
    endings: Collection[str],
    estimations: Sequence[str] = ESTIMATIONS,
) -> Replayed:
    """Read a recording and replay it, as the options and the unit's file ask for.

    Parameters
    ----------
    endings
        Of files to which it can be written.
    estimations
        What is done with a sample; the first, if neither option nor file names one of them.

    Raises
    ------
    OutputError
        If the output has another ending, or would be written over the recording.
    """
    path = options.output
    if path is not None and path.suffix not in endings:  # before the work, lest that be in vain
        raise OutputError(f'{path}: a replay is written to a file ending in {", ".join(endings)}')
    unit, recording = unit_and_recording(options)
    if path is not None:
        refuse_within(path, options.data)
    return Replayed(
        unit,
        recording,
        replay_from(
            *(options, unit, unit.design, recording),
            default=estimations[0],
            estimations=estimations,
        ),
        None if options.direction is None else recorded_tip_forces(options, unit, recording),
    )


def replay_from(
    options: argparse.Namespace,
    unit: Unit,
    design: JointDesign,
    recording: Recording,
    progress: Progress = with_progress,
    default: str = ESTIMATIONS[0],
    estimations: Sequence[str] = ESTIMATIONS,
) -> Replay:
    """Replay a recording as the options and the unit's file ask for, with a design of it.

    Where they do not say which of some estimations, it is done as `default` says.
    """
    of_file = unit.get('estimation')
    estimation = options.estimation or (of_file if of_file in estimations else default)
    if estimation == 'filtering' and tension_stddev_of(options, unit) is None:
        raise UsageError(
            'estimation is filtering, which needs the noise of the load cells: give '
            '--tension-stddev, in N, or tension_stddev in the design file; tendon-statics tare '
            'says how far readings of slack cables scatter'
        )
    settings = dataclasses.replace(
        unit.settings, measured_bend_angle_stddev=bend_angle_stddev_from(options, unit)
    )
    return replay(
        design,
        recording,
        estimation,
        settings=settings,
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
