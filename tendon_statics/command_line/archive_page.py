"""An archive as one page: what came of every recording, the troubled ones first."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape
from pathlib import Path

from ..archive.dataset import PAGE
from ..archive.row import STATUSES, WHOLE, Row
from ..estimation.regimes import INVALID, REGIME_COLOURS
from .page import fact_table, html_table, table, warning, write_page
from .tables import Facts

COLOURS = {**{regime.value: colour for regime, colour in REGIME_COLOURS.items()}, INVALID: 'black'}

_STYLE = """\
.bar { display: flex; width: 9rem; height: 0.8rem; margin-top: 0.35rem; }
.bar i, .key i { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.key i { display: inline-block; width: 0.8rem; height: 0.8rem; margin: 0 0.3rem 0 1rem; }
td small { display: block; color: #666; overflow-wrap: anywhere; }
"""


def write_archive_page(
    folder: Path, rows: Sequence[Row], others: Sequence[Row], facts: Facts
) -> None:
    """Write the page of a data set.

    Parameters
    ----------
    rows : sequence of Row
        Of this run.
    others : sequence of Row
        Of earlier runs, which stay.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    troubled = [row for row in rows if row.problem]
    parts = [fact_table([*facts, *_settings(rows)])]
    if troubled:
        parts += [
            '<h2>Not read or not done</h2>',
            warning(f'{len(troubled)} of {len(rows)} recordings are not whole.'),
            table(
                ('recording', 'status', 'what it means', 'why'),
                [
                    (row.recording, row.status, STATUSES[row.status], row.problem)
                    for row in troubled
                ],
            ),
        ]
    parts += ['<h2>Recordings</h2>', _key(), _recordings([*rows, *others])]
    fitted = [row for row in rows if row.fitted or row.calibration_error]
    if fitted:
        parts += ['<h2>Calibration</h2>', _calibrations(fitted)]
    write_page(folder / PAGE, f'Archive {folder.name}', parts, style=_STYLE, width='72rem')


def _settings(rows: Sequence[Row]) -> Facts:
    estimations = sorted({row.estimation for row in rows if row.estimation})
    return [('estimation', ', '.join(estimations))] if estimations else []


def _key() -> str:
    entries = ''.join(
        f'<i style="background:{colour}"></i>{escape(name.replace("_", " "))}'
        for name, colour in COLOURS.items()
    )
    return f'<p class="key">Regimes:{entries}</p>'


def _recordings(rows: Sequence[Row]) -> str:
    titles = ('recording', 'what', 'samples', 'duration', 'rate', 'clock', 'regimes', 'error')
    return html_table(titles, [_cells(row) for row in rows])


def _cells(row: Row) -> list[str]:
    said = [*row.notes, *row.warnings]
    if row.status != WHOLE:
        said.insert(0, row.status)
    name = escape(row.recording) + ''.join(f'<small>{escape(text)}</small>' for text in said)
    error = row.error_root_mean_square
    return [
        name,
        escape(row.format),
        '' if row.samples is None else str(row.samples),
        '' if row.duration is None else f'{row.duration:.4g} s',
        '' if row.rate is None else f'{row.rate:.4g} Hz',
        escape(row.clock),
        _bar(row),
        '' if error is None else f'{math.degrees(error):.3g}° rms',
    ]


def _bar(row: Row) -> str:
    """Draw the share of each regime."""
    if not row.regimes or not row.samples:
        return ''
    words = ', '.join(f'{name} {count}' for name, count in row.regimes.items())
    parts = ''.join(
        f'<i style="width:{100.0 * row.regimes[name] / row.samples:.2f}%;background:{colour}"></i>'
        for name, colour in COLOURS.items()
        if name in row.regimes
    )
    return f'<span class="bar" title="{escape(words)}">{parts}</span>'


def _calibrations(rows: Sequence[Row]) -> str:
    names = [*dict.fromkeys(name for row in rows for name in row.fitted)]
    titles = ('recording', *names, 'residual', 'what to know')
    return html_table(titles, [_calibration_cells(row, names) for row in rows])


def _calibration_cells(row: Row, names: Sequence[str]) -> list[str]:
    cells = [escape(row.recording)]
    for name in names:
        value, error = row.fitted.get(name, (None, None))
        cells.append('' if value is None else f'{value:.5g}' + _plus_minus(error))
    residual = row.calibration_residual
    cells.append('' if residual is None else f'{residual:.3g}')
    known = [row.calibration_error, *row.calibration_objections]
    cells.append(escape('; '.join(filter(None, known))))
    return cells


def _plus_minus(error: float | None) -> str:
    return '' if error is None else f' ± {error:.2g}'
