"""``tendon-statics report``: a recorded session and its calibration as one HTML file."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from datetime import date
from html import escape
from importlib.metadata import version
from pathlib import Path
from string import Template

from ..files.output_file import OutputError, output_file
from ..physics import CalibrationError, JointDesign, design_fields
from ..physics.calibration.load_cells import AS_MEASURED
from ..recordings.errors import RecordingError
from ..recordings.recording import Recording
from ..recordings.scaling import corrected
from . import figure_calibration, figure_recording
from .calibration_options import Fitted, add_calibration_options, calibration_from
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
from .figures import svg_of
from .options import add_design_option, add_load_options, say_written
from .recording_options import add_recording_options, report_damage, unit_and_recording
from .replay import add_estimation_options, replay_from
from .replay_text import replay_facts
from .tables import Facts

_PAGE = Template("""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; background: white;
       max-width: 50rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; line-height: 1.25; } h2 { font-size: 1.2rem; margin-top: 2rem; }
svg { width: 100%; height: auto; }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.9rem; }
th, td { text-align: left; padding: 0.25rem 0.9rem 0.25rem 0; border-bottom: 1px solid #ddd;
         vertical-align: top; font-variant-numeric: tabular-nums; }
.facts th { font-weight: 600; white-space: nowrap; }
.warning { border-left: 4px solid #D55E00; background: #fdf3ec; padding: 0.5rem 0.9rem;
           margin: 0.6rem 0; }
footer { color: #666; font-size: 0.85rem; margin-top: 2.5rem; }
.wide { overflow-x: auto; }
</style>
</head>
<body>
<h1>$title</h1>
$content
<footer>Made on $date by tendon_statics $version.</footer>
</body>
</html>
""")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_estimation_options(parser)
    add_load_options(parser)
    add_calibration_options(parser)
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
        parts.append(_warning(f'Not all of it could be read: {recording.damage_summary}'))
    note = ''
    try:
        fit = calibration_from(options, unit, recording)
    except (CalibrationError, RecordingError) as error:
        design, of = start, _start_name(options)
        fitted = ['<h2>Calibration</h2>', _warning(f'Nothing could be fitted: {error}')]
        note = f'tendon-statics: {path} has no calibration: {error}'
    else:
        calibration = fit.calibration
        design, of = calibration.design or start, 'the fitted design'
        recording = corrected(recording, calibration.cells or AS_MEASURED)
        if calibration.design is None:
            of = f'{_start_name(options)}, since the fit does not determine a design'
        fitted = _calibration_part(fit, recording, _start_name(options))
    replayed = replay_from(options, unit, design, recording)
    parts += [
        f'<h2>Recording, with {escape(of)}</h2>',
        _facts(replay_facts(replayed, design)),
        svg_of(
            lambda drawing: draw_replay(drawing, design, replayed),
            figure_recording.SIZE,
        ),
        *fitted,
        '<h2>Design</h2>',
        _design_table(start, design),
    ]
    page = _PAGE.substitute(
        title=escape(f'Recorded session {recording.name}'),
        content='\n'.join(parts),
        date=date.today().isoformat(),
        version=version('tendon_statics'),
    )
    with output_file(path) as temporary:
        temporary.write_text(page, encoding='utf-8')
    say_written(path, options)
    if note:
        print(note, file=sys.stderr)
    return report_damage(recording)


def _start_name(options: argparse.Namespace) -> str:
    return Path(options.design).name if options.design else 'the preliminary design'


def _calibration_part(fit: Fitted, recording: Recording, start: str) -> list[str]:
    calibration, comparison = fit
    names = [parameter.name for parameter in calibration.parameters]
    parts = [
        '<h2>Calibration</h2>',
        *map(_warning, calibration.warnings),
        _facts([('start', start), *calibration_facts(calibration, recording.name)]),
    ]
    if comparison is not None:
        parts += [_table(LAW_TITLES, law_rows(comparison)), _facts(law_facts(comparison))]
    parts.append(_table(PARAMETER_TITLES, parameter_rows(calibration)))
    if len(names) > 1:
        parts.append(_table(['correlation', *names], correlation_rows(calibration)))
    parts.append(
        svg_of(
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
    return _table(('parameter', 'value', 'unit', 'meaning'), rows)


def _plain(value: float | str) -> str:
    return value if isinstance(value, str) else f'{value:.7g}'


def _warning(text: str) -> str:
    return f'<p class="warning">{escape(text)}</p>'


def _facts(facts: Facts) -> str:
    rows = ''.join(f'<tr><th>{escape(k)}</th><td>{escape(v)}</td></tr>' for k, v in facts)
    return f'<table class="facts">{rows}</table>'


def _table(titles: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    head = ''.join(f'<th>{escape(title.removesuffix(":"))}</th>' for title in titles)
    body = ''.join(
        '<tr>' + ''.join(f'<td>{escape(cell)}</td>' for cell in row) + '</tr>' for row in rows
    )
    return f'<div class="wide"><table><tr>{head}</tr>{body}</table></div>'
