"""A calibration in words and tables."""

from __future__ import annotations

import math

from ..physics.calibration import HELD, SLIPPING, Calibration, FittedParameter, LawComparison
from ..physics.calibration.law_comparison import LawFit
from ..physics.calibration.parameters import fit_parameters
from .tables import Facts, fact_lines, markdown_table

_UNITS = {parameter.name: parameter.unit or '1' for parameter in fit_parameters()}

LAW_TITLES = (
    *('contact law', 'criterion:', 'above the best:', 'the data'),
    'fitted with it',
)

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


def law_rows(comparison: LawComparison) -> list[tuple[str, ...]]:
    """Rows of the table of contact laws, under `LAW_TITLES`."""
    return [_law_row(fit, is_best=fit is comparison.best) for fit in comparison.fits]


def law_facts(comparison: LawComparison) -> Facts:
    """What the data say of the laws, and what would say more."""
    advice = [
        ('would tell', f'{one.text}; a difference of {one.difference:.3g} on average')
        for one in comparison.advice
    ]
    return [('contact law', comparison.statement), *advice]


def _law_row(fit: LawFit, *, is_best: bool) -> tuple[str, ...]:
    if fit.calibration is None:
        verdict = 'no fit' if fit.is_applicable else 'no such unit'
        return fit.law, '', '', verdict, fit.failure
    values = ', '.join(
        f'{of.name} = ' + ('not determined' if of.value is None else f'{of.value:.4g}')
        for of in fit.calibration.parameters
    )
    criterion = fit.loss + 2.0 * fit.parameter_count
    verdict = 'are likeliest' if is_best else 'rule it out' if fit.is_ruled_out else 'allow it'
    return fit.law, f'{criterion:.2f}', f'{fit.difference:.2f}', verdict, values


def calibration_text(
    calibration: Calibration, name: str, read: Facts, comparison: LawComparison | None = None
) -> str:
    """Everything, as it is printed, with how the data were read."""
    titles = ('correlation', *(f'{parameter.name}:' for parameter in calibration.parameters))
    first, *others = calibration_facts(calibration, name)
    parts = [fact_lines([first, *read, *others])]
    if comparison is not None:
        parts += [
            markdown_table(LAW_TITLES, law_rows(comparison)),
            fact_lines(law_facts(comparison)),
            f'with {comparison.best.law}:',
        ]
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
