"""``tendon-statics calibrate``: fit a design to a recorded session."""

from __future__ import annotations

import argparse
from datetime import date
from pathlib import Path

from ..files.design_file import save_design
from ..files.output_file import OutputError
from ..files.unit_file import Unit
from ..physics.calibration import Calibration, LawComparison
from ..physics.calibration.load_cells import AS_MEASURED
from ..recordings.plausible_fit import objections
from ..recordings.recording import Recording
from .calibration_options import (
    add_calibration_options,
    assumed_facts,
    calibration_from,
    states_text,
)
from .calibration_text import calibration_text
from .options import (
    add_design_option,
    add_format_option,
    add_load_options,
    design_name,
    print_json,
    say_written,
)
from .recording_options import add_recording_options, report_damage, unit_and_recording
from .replay_text import reading_facts
from .tables import Facts

DESIGN_ENDINGS = ('.yaml', '.yml')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_calibration_options(parser)
    add_load_options(parser)
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
    calibration, comparison = calibration_from(options, unit, recording)
    read = [
        *reading_facts(recording, unit, unit.design),
        *assumed_facts(options, recording),
        *_cell_facts(calibration, unit, recording),
    ]
    text = calibration_text(calibration, recording.name, read, comparison)
    unwritten = _unwritten(calibration, comparison, recording)
    if options.output is not None and calibration.design is not None and not unwritten:
        provenance = _provenance(options, recording)
        save_design(
            options.output,
            calibration.design,
            f'{provenance}\n\n{text}',
            {**unit.parameters, **cell_parameters(calibration, unit)},
            calibration.uncertainty,
        )
    if options.format == 'json':
        print_json(
            {
                'data': recording.name,
                'damage': list(recording.damage),
                'notes': [note for _, note in read],
                **calibration.as_dict(),
                **({} if comparison is None else {'comparison': comparison.as_dict()}),
            }
        )
    else:
        print(text)
    if options.output is not None and unwritten:
        raise OutputError(f'{options.output}: {unwritten}')
    if options.output is not None:
        say_written(options.output, options)
    return report_damage(recording)


def _unwritten(
    calibration: Calibration, comparison: LawComparison | None, recording: Recording
) -> str:
    """Say why no design is written; empty if one is."""
    doubts = objections(calibration)
    if comparison is not None and comparison.told is None:
        text = (
            f'no design is written, since {comparison.statement}; choose one with --contact-law '
            'if you know it otherwise'
        )
    elif calibration.design is None:
        text = (
            'no design is written, since the data do not determine '
            f'{" and ".join(calibration.undetermined)}; leave out of --fit what you know otherwise'
        )
    elif not doubts:
        return ''
    else:
        text = (
            f'no design is written, since {" and ".join(doubts)}; check units, states and --fit, '
            'or start from a --design nearer to the unit'
        )
    unread = f'; not all could be read: {recording.damage_summary}' if recording.damage else ''
    return text + unread


def cell_parameters(calibration: Calibration, unit: Unit) -> dict[str, float]:
    """Gain and bias of the cables whose load cells were fitted, as the unit's file has them.

    The fit corrects tensions that the file's own gain and bias have made of readings.
    """
    cells = calibration.cells or AS_MEASURED
    found = {}
    for cable, scale, gain, bias in (
        ('cable_l', unit.cable_l, cells.gain_l, cells.bias_l),
        ('cable_s', unit.cable_s, cells.gain_s, cells.bias_s),
    ):
        together = {'gain': gain * scale.gain, 'bias': gain * scale.bias + bias}
        for name, value in together.items():
            if value != getattr(scale, name):
                found[f'{cable}.{name}'] = value
    return found


def _cell_facts(calibration: Calibration, unit: Unit, recording: Recording) -> Facts:
    """Say what becomes of the file's gains and biases."""
    found = cell_parameters(calibration, unit)
    facts = [('load cells', f'{name}: {value:.8g}') for name, value in found.items()]
    is_scaled = not (unit.cable_l.is_identity and unit.cable_s.is_identity)
    if found and is_scaled and recording.readings is None:
        facts.append(
            (
                'warning',
                'the recorded tensions were in N already, so this is right only if they were made '
                "with the design file's gains and biases",
            )
        )
    return facts


def _provenance(options: argparse.Namespace, recording: Recording) -> str:
    from importlib.metadata import version

    lines = [
        f'Fitted on {date.today().isoformat()} by tendon_statics {version("tendon_statics")}, '
        f'starting from {design_name(options)}.',
        f'States: {states_text(options, recording)}.',
    ]
    if recording.damage:
        lines.append(f'Not all of the data could be read: {recording.damage_summary}')
    return '\n'.join(lines)
