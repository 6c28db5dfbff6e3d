"""``tendon-statics track``: follow the unit through a recording of tensions."""

from __future__ import annotations

import argparse
import csv
import sys

from ..physics import StickSlipTracker, TensionError
from ..recordings.load import load_recording
from .options import add_design_option, design_from

COLUMNS = ('tension_l', 'tension_s', 'bend_angle', 'regime', 'slip_margin', 'angle_assured')


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


def run(options: argparse.Namespace) -> None:
    """Print a row for each row of the file: angle in rad, regime, margin, certainty."""
    tracker = StickSlipTracker(design_from(options), options.initial_bend_angle)
    recording = load_recording(options.file).whole()
    writer = csv.writer(sys.stdout, lineterminator='\n')
    writer.writerow(COLUMNS if recording.time is None else ['time', *COLUMNS])
    for index, tensions in enumerate(recording.tensions()):
        row = [*tensions, *_tracked(tracker, *tensions)]
        writer.writerow(row if recording.time is None else [recording.time[index], *row])


def _tracked(tracker: StickSlipTracker, tension_l: float, tension_s: float) -> tuple[object, ...]:
    try:
        state = tracker.update(tension_l, tension_s)
    except TensionError:
        return '', 'invalid', '', ''
    return state.bend_angle, state.regime, state.slip_margin, state.angle_assured
