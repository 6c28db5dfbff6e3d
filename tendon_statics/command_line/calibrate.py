"""``tendon-statics calibrate``: fit a design to a recorded session."""

from __future__ import annotations

import argparse
from datetime import date
from pathlib import Path

from ..files.design_file import save_design
from ..files.output_file import OutputError
from ..physics import Calibration
from ..recordings.plausible_fit import objections
from ..recordings.recording import Recording
from .calibration_options import add_calibration_options, calibration_from, states_text
from .calibration_text import calibration_text
from .options import add_design_option, add_format_option, print_json
from .recording_options import add_recording_options, report_damage, unit_and_recording
from .replay_text import reading_facts

DESIGN_ENDINGS = ('.yaml', '.yml')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_calibration_options(parser)
    parser.add_argument(
        '--output', type=Path, metavar='FILE.yaml', help='write the fitted design there'
    )
    add_format_option(parser)


def run(options: argparse.Namespace) -> int:
    """Fit, write the design, print what is known of it."""
    if options.output is not None and options.output.suffix not in DESIGN_ENDINGS:
        raise OutputError(
            f'{options.output}: a design is written to a file ending in '
            f'{" or ".join(DESIGN_ENDINGS)}'
        )
    unit, recording = unit_and_recording(options)
    calibration = calibration_from(options, unit, recording)
    read = reading_facts(recording, unit.design)
    text = calibration_text(calibration, recording.name, read)
    doubts = objections(calibration)
    if options.output is not None and calibration.design is not None and not doubts:
        provenance = _provenance(options, recording)
        save_design(options.output, calibration.design, f'{provenance}\n\n{text}', unit.parameters)
    if options.format == 'json':
        print_json(
            {
                'data': recording.name,
                'damage': list(recording.damage),
                'notes': [note for _, note in read],
                **calibration.as_dict(),
            }
        )
    else:
        print(text)
    if options.output is not None and (calibration.design is None or doubts):
        raise OutputError(f'{options.output}: {_unwritten(calibration, doubts, recording)}')
    return report_damage(recording)


def _unwritten(calibration: Calibration, doubts: list[str], recording: Recording) -> str:
    """Say why no design is written."""
    if calibration.design is None:
        text = (
            'no design is written, since the data do not determine '
            f'{" and ".join(calibration.undetermined)}; leave out of --fit what you know otherwise'
        )
    else:
        text = (
            f'no design is written, since {" and ".join(doubts)}; check units, states and --fit, '
            'or start from a --design nearer to the unit'
        )
    unread = f'; not all could be read: {recording.damage_summary}' if recording.damage else ''
    return text + unread


def _provenance(options: argparse.Namespace, recording: Recording) -> str:
    from importlib.metadata import version

    start = Path(options.design).name if options.design else 'the preliminary design'
    lines = [
        f'Fitted on {date.today().isoformat()} by tendon_statics {version("tendon_statics")}, '
        f'starting from {start}.',
        f'States: {states_text(options)}.',
    ]
    if recording.damage:
        lines.append(f'Not all of the data could be read: {recording.damage_summary}')
    return '\n'.join(lines)
