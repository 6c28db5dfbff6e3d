"""``tendon-statics arm track``: follow an arm through a recording, as a table."""

from __future__ import annotations

import argparse
import sys

from ..recordings.replay.table_output import write_csv
from .arm_recording import add_arm_recording_options, followed_arm
from .recording_options import report_damage, say_notes

add_arguments = add_arm_recording_options


def run(options: argparse.Namespace) -> int:
    """Print a row for each sample: the tip in m and rad; angle in rad, regime, margin a joint."""
    followed = followed_arm(options)
    write_csv(sys.stdout, followed.replay.columns())
    recording = followed.replay.recording
    say_notes(recording, followed.hints)
    return report_damage(recording)
