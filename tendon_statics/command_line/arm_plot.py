"""``tendon-statics arm plot``: an arm going through a recording."""

from __future__ import annotations

import argparse
from pathlib import Path

from .arm_recording import add_arm_recording_options, followed_arm
from .figure_arm import SIZE, draw_arm
from .figures import FORMATS, write_figure
from .options import say_written
from .recording_options import report_damage, say_notes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_recording_options(parser)
    parser.add_argument(
        '--output',
        type=Path,
        required=True,
        metavar='FILE',
        help=f'ending: {", ".join(FORMATS)}',
    )


def run(options: argparse.Namespace) -> int:
    """Draw and write the figure."""
    path: Path = options.output
    followed = followed_arm(options)
    write_figure(path, lambda drawing: draw_arm(drawing, followed.replay), SIZE)
    say_written(path, options)
    say_notes(followed.replay.recording, followed.hints)
    return report_damage(followed.replay.recording)
