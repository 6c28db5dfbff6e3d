"""``tendon-statics track``: follow the unit through a recording of tensions."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from numpy.typing import NDArray

from ..recordings.replay.estimates import replay
from ..recordings.replay.table_output import write_csv
from .options import add_design_option, add_load_options
from .progress import with_progress
from .recorded_load import recorded_load
from .recording_options import (
    add_recording_options,
    report_damage,
    report_notes,
    unit_and_recording,
)
from .replay import add_initial_bend_angle_option, initial_bend_angle_from


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_recording_options(parser)
    add_initial_bend_angle_option(parser)
    add_load_options(parser)
    add_design_option(parser)


def run(options: argparse.Namespace) -> int:
    """Print a row for each sample: angle in rad, regime, margin, certainty."""
    unit, recording = unit_and_recording(options)
    tracked = replay(
        unit.design,
        recording,
        'tracking',
        settings=unit.settings,
        load=recorded_load(options, unit, recording),
        initial_bend_angle=initial_bend_angle_from(options, unit),
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
    report_notes(unit, recording, unit.settings.doubts)
    return report_damage(recording)
