"""``tendon-statics replay``: a recorded session through the model."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..recordings.replay.bag_output import write_bag
from ..recordings.replay.table_output import write_table
from .options import say_written
from .progress import with_progress
from .recording_options import report_damage
from .replay_options import Replayed, add_replay_options, replayed
from .tables import fact_lines


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_replay_options(parser, _WRITERS)


def run(options: argparse.Namespace) -> int:
    """Replay, write the samples, print a summary."""
    path: Path | None = options.output
    found = replayed(options, _WRITERS)
    if path is not None:
        _WRITERS[path.suffix](path, found)
    print(fact_lines(found.facts))
    if path is not None:
        say_written(path, options)
    return report_damage(found.recording)


def _write_table(path: Path, found: Replayed) -> None:
    columns = found.replay.columns() | ({} if found.tips is None else found.tips.columns())
    write_table(path, columns, with_progress)


def _write_bag(path: Path, found: Replayed) -> None:
    write_bag(path, found.replay, with_progress)


_WRITERS = {'.csv': _write_table, '.parquet': _write_table, '.mcap': _write_bag}
