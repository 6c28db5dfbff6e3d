"""``tendon-statics tare``: the biases of load cells from a recording of slack cables."""

from __future__ import annotations

import argparse
import math
from datetime import date
from pathlib import Path

import numpy as np

from ..files.output_file import OutputError
from ..files.parameter_edit import edit_parameters
from ..files.unit_file import Unit
from ..recordings.errors import RecordingError
from ..recordings.recording import Recording
from ..tensions.tare import CableTare, TareError, tare
from .calibrate import DESIGN_ENDINGS
from .options import (
    UsageError,
    add_design_option,
    add_format_option,
    add_tension_stddev_option,
    design_file_and_node,
    print_json,
    say_written,
    tension_stddev_from,
)
from .recording_options import add_recording_options, report_damage, unit_and_recording
from .tables import fact_lines, markdown_table

TITLES = (
    *('cable', 'readings:', 'mean [N]:', 'scatter [N]:', 'drift [N]:'),
    *('bias was [N]:', 'bias is [N]:'),
)


IN_NEWTONS = (
    'by their titles these tensions are in a unit of force, and such columns are taken as they '
    'are: a bias counts only for what the node reads, and for columns without a unit'
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_tension_stddev_option(parser, default=None)
    for name, what in (('start', 'from'), ('end', 'up to')):
        parser.add_argument(
            f'--{name}',
            type=float,
            metavar='S',
            help=f'{what} this time of the recording both cables are slack; default: all of it',
        )
    parser.add_argument(
        '--output',
        type=Path,
        metavar='FILE.yaml',
        help='write the design file there, with the new biases and all else as it stands',
    )
    add_format_option(parser)


def run(options: argparse.Namespace) -> int:
    """Average, write, and say what was found."""
    if options.output is not None and options.output.suffix not in DESIGN_ENDINGS:
        raise OutputError(
            f'{options.output}: a design is written to a file ending in '
            f'{" or ".join(DESIGN_ENDINGS)}'
        )
    unit, recording = unit_and_recording(options)
    slack = _between(recording, options.start, options.end)
    try:
        tares = tare(
            {'cable_l': slack.tension_l.tolist(), 'cable_s': slack.tension_s.tolist()},
            (unit.cable_l.bias, unit.cable_s.bias),
            tension_stddev_from(options, unit),
        )
    except TareError as error:
        raise UsageError(
            f'{recording.name}: {error}; both cables have to hang slack and still, '
            '--start and --end choose a time'
        ) from None
    biases = {f'{of.cable}.bias': of.bias for of in tares}
    if options.output is not None:
        comment = f'Biases of {date.today().isoformat()}, from slack cables in {recording.name}.'
        path, node = design_file_and_node(options)
        edit_parameters(path, options.output, biases, node, comment)
    if options.format == 'json':
        print_json({**biases, 'cables': [{**of._asdict(), 'bias': of.bias} for of in tares]})
    else:
        print(_text(unit, slack, tares))
    if options.output is not None:
        say_written(options.output, options)
    return report_damage(recording)


def _between(recording: Recording, start: float | None, end: float | None) -> Recording:
    """Return the samples of a time.

    Raises
    ------
    RecordingError
        If there are no times, or no samples in it.
    """
    if start is None and end is None:
        return recording
    if recording.time is None:
        raise RecordingError(f'{recording.name}: it has no times for --start and --end')
    first = -math.inf if start is None else start
    last = math.inf if end is None else end
    within = (recording.time >= first) & (recording.time <= last)
    if not within.any():
        times = recording.time[np.isfinite(recording.time)]
        raise RecordingError(
            f'{recording.name}: no sample is between these times; it has those from '
            f'{times.min():.6g} s to {times.max():.6g} s'
            if len(times)
            else f'{recording.name}: no sample has a time'
        )
    return recording.part(within)


def _text(unit: Unit, slack: Recording, tares: list[CableTare]) -> str:
    rows = [
        (
            of.cable,
            str(of.readings),
            f'{of.mean:.5g}',
            f'{of.scatter:.3g}',
            f'{of.drift:+.3g}',
            f'{of.old_bias:.6g}',
            f'{of.bias:.6g}',
        )
        for of in tares
    ]
    facts = [('data', slack.name), *(('read', note) for note in slack.notes)]
    if {'tension_l', 'tension_s'} <= slack.marked:
        facts.append(('warning', IN_NEWTONS))
    for of in tares:
        if doubt := of.doubt(unit.design.weight):
            facts.append(('warning', doubt))
    lines = [f'    {of.cable}.bias: {of.bias!r}' for of in tares]
    return '\n\n'.join([fact_lines(facts), markdown_table(TITLES, rows), '\n'.join(lines)])
