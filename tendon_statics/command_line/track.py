"""``tendon-statics track``: a replay with memory, as a table of where the unit is."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from numpy.typing import NDArray

from ..recordings.replay.table_output import write_csv, write_table
from .options import say_written
from .progress import with_progress
from .recording_options import report_damage
from .replay_options import Replayed, add_replay_options, replayed
from .tables import fact_lines

ESTIMATIONS = ('tracking', 'filtering')
"""Those that follow a unit; by default it is tracked, also with a file for equilibrium"""

ENDINGS = ('.csv', '.parquet')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_replay_options(parser, ENDINGS, ESTIMATIONS)


def run(options: argparse.Namespace) -> int:
    """Print a row for each sample, or write it, and say what there is to say of all.

    Beside a printed table the summary is for a terminal; a script is told what it may have to
    mend, and nothing else.
    """
    found = replayed(options, ENDINGS, ESTIMATIONS)
    if options.output is None:
        write_csv(sys.stdout, _columns(found))
        if sys.stderr.isatty():
            sys.stdout.flush()
            print(f'\n{fact_lines(found.facts)}', file=sys.stderr)
        else:
            for title, text in found.facts:
                if title in ('read', 'warning'):
                    print(f'tendon-statics: {found.recording.name}: {text}', file=sys.stderr)
    else:
        write_table(options.output, _columns(found), with_progress)
        print(fact_lines(found.facts))
        say_written(options.output, options)
    return report_damage(found.recording)


def _columns(found: Replayed) -> dict[str, NDArray[Any]]:
    """Return the table: when, at which tensions, where."""
    recording, followed = found.recording, found.replay
    columns: dict[str, NDArray[Any]] = {}
    if recording.time is not None:
        columns['time'] = recording.time
    columns |= {
        'tension_l': recording.tension_l,
        'tension_s': recording.tension_s,
        'bend_angle': followed.bend_angle,
        'regime': followed.regime,
        'slip_margin': followed.slip_margin,
        'angle_assured': followed.angle_assured,
    }
    if followed.interval is not None:
        columns['bend_angle_low'], columns['bend_angle_high'] = followed.interval
    return columns if found.tips is None else columns | found.tips.columns()
