"""``tendon-statics track``: follow the unit through a recording of tensions."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from numpy.typing import NDArray

from ..recordings.reading.load import load_recording
from ..recordings.replay.estimates import replay
from ..recordings.replay.table_output import write_csv
from .options import add_design_option, design_from
from .progress import with_progress
from .recording_options import report_damage


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    parser.add_argument(
        'file',
        metavar='FILE.csv',
        help='columns tension_l, tension_s in N and, if there are times, time',
    )
    parser.add_argument(
        '--initial-bend-angle',
        type=float,
        default=0.0,
        metavar='RAD',
        help='where the unit is at first, in rad; default: %(default)s',
    )
    add_design_option(parser)


def run(options: argparse.Namespace) -> int:
    """Print a row for each sample: angle in rad, regime, margin, certainty."""
    recording = load_recording(options.file, progress=with_progress)
    tracked = replay(
        design_from(options),
        recording,
        'tracking',
        initial_bend_angle=options.initial_bend_angle,
        progress=with_progress,
    )
    columns: dict[str, NDArray[Any]] = {}
    if recording.time is not None:
        columns['time'] = recording.time
    columns |= {
        'tension_l': recording.tension_l,
        'tension_s': recording.tension_s,
        'bend_angle': tracked.bend_angle,
        'regime': tracked.regime,
        'slip_margin': tracked.slip_margin,
        'angle_assured': tracked.angle_assured,
    }
    write_csv(sys.stdout, columns)
    return report_damage(recording)
