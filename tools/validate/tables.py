"""The tables of docs/validation.md, from what was simulated and the laws as they are now."""

from __future__ import annotations

import argparse
import math

from tendon_statics.command_line.tables import markdown_table

from . import rest
from .bristles import first_moments, held_moment
from .constructions import BALL_RADIUS, CASES, CONVERGENCE_CASE, EQUATOR_SEAT, HANGING, LOW_SEAT
from .foundation import seat_constants
from .laws import LAWS, capacity
from .results import Results, read


def onset_table(results: Results) -> str:
    """Lay out the slip onset, and by how much each law is off."""
    rows = []
    for (construction, friction), onset in zip(CASES, results.onsets, strict=True):
        cells = [construction.name, f'{friction:g}', f'{onset.rigid_body:.4f}']
        cells += [f'{onset.bristles:.4f}', _number(onset.foundation, '.4f')]
        for law in LAWS:
            moment = capacity(law, construction, friction, tension=1.0)
            off = moment and moment / (BALL_RADIUS * onset.rigid_body) - 1.0
            cells.append(_number(off and 100.0 * off, '+.1f', ' %'))
        rows.append(cells)
    header = ('construction', 'μ:', 'rigid body:', 'bristles:', 'integration:')
    return markdown_table((*header, *(f'`{law}`:' for law in LAWS)), rows)


def rest_table(results: Results) -> str:
    """Lay out the rest angles, and by how much each law is off."""
    rows = []
    for tension_s, angle in zip(HANGING.tensions_s, results.rest_angles_deg, strict=True):
        integrated = math.degrees(rest.by_foundation(HANGING, tension_s))
        cells = [f'{tension_s:g} N', f'{angle:.1f}°', f'{integrated:.1f}°']
        for law in LAWS:
            by_law = math.degrees(rest.by_law(HANGING, tension_s, law))
            cells.append(f'{by_law:.1f}° ({by_law - angle:+.1f}°)')
        rows.append(cells)
    header = ('T_s:', 'rigid body:', 'integration:')
    return markdown_table((*header, *(f'`{law}`:' for law in LAWS)), rows)


def constants_table() -> str:
    """Lay out the constants of the elastic seat by direct integration."""
    rows = []
    for seat in (LOW_SEAT, EQUATOR_SEAT):
        constants = seat_constants(seat)
        rows.append([seat.name, *(f'{value:.4f}' for value in constants)])
    return markdown_table(('construction', 'k_c:', 'c:', 'q:'), rows)


def first_slip_table() -> str:
    """Lay out the largest moment before the first slip, by the bristles."""
    rows = []
    for construction, friction in CASES:
        if construction == EQUATOR_SEAT:
            steady = held_moment(construction, friction)
            rows.append([f'{friction:g}', f'{steady:.4f}'])
            for moment in first_moments(construction, friction):
                rows[-1].append(f'{moment:.4f} ({100.0 * (moment / steady - 1.0):+.0f} %)')
    header = ('μ:', 'sliding:', 'first, seated with friction:', 'first, seated without:')
    return markdown_table(header, rows)


def convergence_table(results: Results) -> str:
    """Lay out what each setting changes."""
    references = {
        (onset.construction, onset.friction): onset.rigid_body for onset in results.onsets
    }
    construction, friction = CONVERGENCE_CASE
    default = references[construction.name, friction]
    rows = [[*_case(construction.name, friction), 'as above', f'{default:.4f}', '']]
    for trial in results.trials:
        reference = references[trial.construction, trial.friction]
        change = 100.0 * (trial.rigid_body / reference - 1.0)
        rows.append(
            [
                *_case(trial.construction, trial.friction),
                trial.setting,
                f'{trial.rigid_body:.4f}',
                f'{change:+.2f} %',
            ]
        )
    return markdown_table(('construction', 'μ:', 'setting', 'K / (r T):', 'change:'), rows)


def _case(construction: str, friction: float) -> tuple[str, str]:
    return construction, f'{friction:g}'


def _number(value: float | None, form: str, unit: str = '') -> str:
    return '–' if value is None else f'{value:{form}}{unit}'


TABLES = {
    'onset': lambda: onset_table(read()),
    'rest': lambda: rest_table(read()),
    'constants': constants_table,
    'first-slip': first_slip_table,
    'convergence': lambda: convergence_table(read()),
}


def main(*arguments: str) -> None:
    """Print one of the tables."""
    parser = argparse.ArgumentParser(prog='validate.tables')
    parser.add_argument('table', choices=TABLES)
    print(TABLES[parser.parse_args(arguments).table]())
