"""A calibration in words and tables."""

from __future__ import annotations

import math

from ..physics import Calibration, design_parameters
from ..physics.calibration import HELD, SLIPPING, FittedParameter
from .tables import Facts, fact_lines, markdown_table

_UNITS = {parameter.name: parameter.unit or '1' for parameter in design_parameters()}

PARAMETER_TITLES = (
    *('parameter', 'unit', 'start:', 'fitted:', 'standard error:', '95 % interval'),
)


def parameter_rows(calibration: Calibration) -> list[tuple[str, ...]]:
    """Rows of the table of fitted parameters, under `PARAMETER_TITLES`."""
    return [
        (
            parameter.name,
            _UNITS[parameter.name],
            f'{parameter.start:.6g}',
            *_told(parameter),
        )
        for parameter in calibration.parameters
    ]


def correlation_rows(calibration: Calibration) -> list[tuple[str, ...]]:
    """Rows of the table of correlations; its titles are the names of the parameters."""
    return [
        (parameter.name, *('' if math.isnan(value) else f'{value:+.3f}' for value in row))
        for parameter, row in zip(
            calibration.parameters, calibration.correlation.tolist(), strict=True
        )
    ]


def calibration_facts(calibration: Calibration, name: str) -> Facts:
    """What was fitted to and how well it fits."""
    noise, residuals = calibration.noise, calibration.residuals
    counts = dict(calibration.counts)
    slipping, with_pressure, held, holds = (
        counts.pop(key) for key in (SLIPPING, 'with pressure', HELD, 'holds')
    )
    of_pressure = f', {noise.pressure:.3g} Pa' if with_pressure else ''
    in_holds = f' in {holds} holds' if held else ''
    return [
        ('data', name),
        (
            'samples',
            f'slipping: {slipping}, with a pressure: {with_pressure}, held: {held}{in_holds}',
        ),
        ('not used', ', '.join(f'{why}: {count}' for why, count in counts.items()) or 'none'),
        (
            'noise',
            f'{noise.tension:g} N, {math.degrees(noise.bend_angle):.3g} deg{of_pressure}',
        ),
        (
            'distances',
            f'root mean square {residuals.root_mean_square:.2f}, median {residuals.median:.2f}, '
            f'largest {residuals.largest:.1f} in units of that noise; '
            f'{residuals.outliers} beyond 3',
        ),
        ('freedom', f'{residuals.degrees_of_freedom}: equations less fitted parameters'),
    ]


def calibration_text(calibration: Calibration, name: str, read: Facts) -> str:
    """Everything, as it is printed, with how the data were read."""
    titles = ('correlation', *(f'{parameter.name}:' for parameter in calibration.parameters))
    first, *others = calibration_facts(calibration, name)
    parts = [fact_lines([first, *read, *others])]
    parts.append(markdown_table(PARAMETER_TITLES, parameter_rows(calibration)))
    if len(calibration.parameters) > 1:
        parts.append(markdown_table(titles, correlation_rows(calibration)))
    if calibration.warnings:
        parts.append(fact_lines([('warning', warning) for warning in calibration.warnings]))
    return '\n\n'.join(parts)


def _told(parameter: FittedParameter) -> tuple[str, str, str]:
    """Value, standard error and interval, as far as the data tell them."""
    if parameter.interval is None:
        return 'not determined', '', ''
    low, high = parameter.interval
    return f'{parameter.value:.6g}', f'{parameter.standard_error:.2g}', f'{low:.6g} to {high:.6g}'
