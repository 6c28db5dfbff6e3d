"""``tendon-statics arm replay``: a recorded session of an arm through the model."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..files.output_file import OutputError
from ..recordings.replay.table_output import write_table
from .arm_recording import add_arm_recording_options, add_arm_tip_force_options, followed_arm
from .arm_replay_text import arm_facts, arm_tip_force_facts, joint_table
from .options import say_written
from .progress import with_progress
from .recording_options import report_damage
from .replay_options import refuse_within
from .tables import fact_lines, markdown_table

ENDINGS = ('.csv', '.parquet')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_recording_options(parser)
    add_arm_tip_force_options(parser)
    parser.add_argument(
        '--output',
        type=Path,
        metavar='FILE',
        help=f'write every sample there; ending: {", ".join(ENDINGS)}',
    )


def run(options: argparse.Namespace) -> int:
    """Follow the arm, write the samples, print a summary."""
    path: Path | None = options.output
    if path is not None:
        if path.suffix not in ENDINGS:
            raise OutputError(
                f'{path}: a replay of an arm is written to a file ending in {", ".join(ENDINGS)}'
            )
        refuse_within(path, options.data)
    followed = followed_arm(options)
    replayed = followed.replay
    if path is not None:
        columns = replayed.columns() | ({} if followed.tips is None else followed.tips.columns())
        write_table(path, columns, with_progress)
    print(fact_lines([*arm_facts(replayed, followed.hints), *arm_tip_force_facts(followed)]))
    print('\n' + markdown_table(*joint_table(replayed)))
    if path is not None:
        say_written(path, options)
    return report_damage(replayed.recording)
