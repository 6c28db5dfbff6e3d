"""``tendon-statics report``: a recorded session and its calibration as one HTML file."""

from __future__ import annotations

import argparse
import dataclasses
import sys
from html import escape
from pathlib import Path

from ..files.output_file import OutputError
from ..files.unit_file import Unit
from ..physics import CalibrationError, JointDesign, design_fields
from ..physics.calibration.load_cells import AS_MEASURED
from ..recordings.errors import RecordingError
from ..recordings.recording import Recording
from ..recordings.scaling import corrected
from . import figure_calibration, figure_recording, figure_tip_force
from .calibration_options import (
    Fitted,
    add_calibration_options,
    assumed_facts,
    calibration_from,
)
from .calibration_text import (
    LAW_TITLES,
    PARAMETER_TITLES,
    calibration_facts,
    correlation_rows,
    law_facts,
    law_rows,
    parameter_rows,
)
from .figure_calibration import draw_calibration
from .figure_recording import draw_replay
from .options import (
    add_design_option,
    add_load_options,
    design_name,
    design_path,
    say_written,
    tension_stddev_from,
    tension_stddev_of,
)
from .origin import origin_facts
from .page import fact_table, figure, paragraph, table, warning, write_page
from .recorded_tip_force import recorded_tip_forces, tip_force_facts
from .recording_options import add_recording_options, report_damage, unit_and_recording
from .replay_options import add_estimation_options, initial_bend_angle_from, replay_from
from .replay_text import replay_facts
from .report_text import (
    DISTANCES,
    ESTIMATION_DEFAULT,
    FREEDOM,
    default_estimation,
    error_meaning,
)
from .tables import Facts
from .tip_force_options import add_line_options

FITTED = 'the fitted design'


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_estimation_options(parser, ESTIMATION_DEFAULT)
    add_load_options(parser)
    add_calibration_options(parser)
    add_line_options(parser, required=False)
    parser.add_argument(
        '--output', type=Path, required=True, metavar='FILE.html', help='the report'
    )


def run(options: argparse.Namespace) -> int:
    """Read, fit, replay with the fitted design, and write the page."""
    path: Path = options.output
    if path.suffix != '.html':
        raise OutputError(f'{path}: a report is written to a file ending in .html')
    unit, recording = unit_and_recording(options)
    start = unit.design
    parts = []
    if recording.damage:
        parts.append(warning(f'Not all of it could be read: {recording.damage_summary}'))
    note = ''
    try:
        fit = calibration_from(options, unit, recording)
    except (CalibrationError, RecordingError) as error:
        design, of = start, design_name(options)
        fitted = ['<h2>Calibration</h2>', warning(f'Nothing could be fitted: {error}')]
        note = f'tendon-statics: the report is written, but has no calibration: {error}'
    else:
        calibration = fit.calibration
        design, of = calibration.design or start, FITTED
        recording = corrected(recording, calibration.cells or AS_MEASURED)
        if calibration.design is not None:
            unit = unit.with_uncertainty(calibration.uncertainty)
        else:
            of = f'{design_name(options)}, since the fit does not determine a design'
            note = 'tendon-statics: the report is written, but the fit does not determine a design'
        facts = [('start', design_name(options)), *assumed_facts(options, recording)]
        fitted = _calibration_part(fit, recording, facts)
    parts += [
        f'<h2>Recording, with {escape(of)}</h2>',
        *_replay_part(options, unit, design, recording, is_fitted=of == FITTED),
        *_tip_force_part(options, unit, design, recording),
        *fitted,
        '<h2>Design</h2>',
        _design_table(start, design),
        '<h2>How to make it again</h2>',
        fact_table(origin_facts(options, recording, [design_path(options)])),
    ]
    write_page(path, f'Recorded session {recording.name}', parts)
    say_written(path, options)
    if note:
        print(note, file=sys.stderr)
    return report_damage(recording)


def _replay_part(
    options: argparse.Namespace,
    unit: Unit,
    design: JointDesign,
    recording: Recording,
    *,
    is_fitted: bool,
) -> list[str]:
    """What the model says of the recording, how it was asked, and what the error means."""
    default, why = default_estimation(recording, tension_stddev_of(options, unit))
    replayed = replay_from(options, unit, design, recording, default=default)
    parts = [fact_table(replay_facts(replayed, unit, design))]
    if options.estimation is None and unit.get('estimation') is None:
        parts.append(
            paragraph(f'Estimation is {default}, since {why}; --estimation says otherwise.')
        )
    if replayed.error is not None:
        start, stddev = initial_bend_angle_from(options, unit), tension_stddev_from(options, unit)
        parts.append(paragraph(error_meaning(replayed, start, stddev, is_fitted=is_fitted)))
    drawn = figure(
        lambda drawing: draw_replay(drawing, design, replayed),
        figure_recording.SIZE,
    )
    return [*parts, drawn]


def _tip_force_part(
    options: argparse.Namespace, unit: Unit, design: JointDesign, recording: Recording
) -> list[str]:
    """What the recording tells of a force at the tip, if it is asked for."""
    if options.direction is None:
        return []
    settings = dataclasses.replace(unit.settings, design=design)
    unit = dataclasses.replace(unit, settings=settings)
    try:
        found = recorded_tip_forces(options, unit, recording, figure_tip_force.MOST)
    except RecordingError as error:
        return ['<h2>Force at the tip</h2>', warning(str(error))]
    return [
        '<h2>Force at the tip</h2>',
        fact_table(tip_force_facts(found)),
        figure(
            lambda drawing: figure_tip_force.draw_tip_forces(drawing, recording, found),
            figure_tip_force.SIZE,
        ),
    ]


def _calibration_part(fit: Fitted, recording: Recording, facts: Facts) -> list[str]:
    calibration, comparison = fit
    names = [parameter.name for parameter in calibration.parameters]
    parts = [
        '<h2>Calibration</h2>',
        *map(warning, calibration.warnings),
        fact_table([*facts, *calibration_facts(calibration, recording.name)]),
        *map(paragraph, (DISTANCES, FREEDOM)),
    ]
    if comparison is not None:
        parts += [table(LAW_TITLES, law_rows(comparison)), fact_table(law_facts(comparison))]
    parts.append(table(PARAMETER_TITLES, parameter_rows(calibration)))
    if len(names) > 1:
        parts.append(table(['correlation', *names], correlation_rows(calibration)))
    parts.append(
        figure(
            lambda drawing: draw_calibration(drawing, calibration, recording),
            figure_calibration.SIZE,
        )
    )
    return parts


def _design_table(start: JointDesign, design: JointDesign) -> str:
    rows = []
    for field in design_fields():
        before, after = (_plain(getattr(of, field.name)) for of in (start, design))
        rows.append(
            (
                field.name,
                after,
                field.unit or '1',
                field.description + (f' (fitted; was {before})' * (before != after)),
            )
        )
    return table(('parameter', 'value', 'unit', 'meaning'), rows)


def _plain(value: float | str) -> str:
    return value if isinstance(value, str) else f'{value:.7g}'
