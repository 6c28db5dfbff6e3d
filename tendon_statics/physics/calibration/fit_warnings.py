"""What is to be known before fitted values are used, in plain sentences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..array_roots import Floats
from ..design import DesignParameter
from .identifiability import Identification
from .result import FittedParameter, ResidualStatistics

STRONG_CORRELATION = 0.99
NEGLIGIBLE_DISTANCE = 0.01
"""Standard deviations; an equation that is met has less"""
BIASES = ('bias_l', 'bias_s')
SIGNIFICANT = 3.0
"""Standard deviations beyond which a scatter is not by chance"""


def calibration_warnings(
    ranges: Sequence[tuple[DesignParameter, float, float]],
    fitted: Sequence[FittedParameter],
    identification: Identification,
    residuals: ResidualStatistics,
    counts: dict[str, int],
    *,
    states_are_known: bool,
) -> list[str]:
    """Say what keeps the values from being used as they are.

    Parameters
    ----------
    ranges : sequence
        The fitted parameters, each with the ends of the range that was searched, in SI.
    """
    found = []
    known = identification.rank
    equations = residuals.degrees_of_freedom + known
    if equations < len(fitted):
        found.append(
            f'{equations} equations cannot determine {len(fitted)} parameters: '
            'record more slips, or fit fewer parameters'
        )
    elif residuals.degrees_of_freedom == 0 and residuals.largest < NEGLIGIBLE_DISTANCE:
        found.append(
            'there are as many equations as parameters, so that they are met whatever the data '
            'are: nothing tests the fit'
        )
    elif residuals.degrees_of_freedom == 0:
        found.append(
            'there are as many equations as parameters, and no values within their ranges and the '
            f'holds meet them: the distance is up to {residuals.largest:.2g} standard deviations, '
            'so the model does not fit, or a state is wrong'
        )
    for direction in identification.null_directions:
        found.append(_unidentified(fitted, direction))
    for (parameter, *ends), value in zip(ranges, fitted, strict=True):
        found += _doubts(parameter, ends, value)
    names = [value.name for value in fitted]
    for i, j in zip(*np.triu_indices(len(names), 1), strict=True):
        correlation = identification.correlation[i, j]
        if abs(correlation) > STRONG_CORRELATION:
            found.append(
                f'{names[i]} and {names[j]} are correlated by {correlation:+.4f}: the data tell '
                'a combination of them far better than either; measure one in another way'
            )
    if residuals.significance > SIGNIFICANT:
        states = (
            'some states are wrong'
            if states_are_known
            else 'not all samples are slipping, as was taken without a state'
        )
        found.append(
            f'the distances scatter {residuals.scale:.2g} times as much as the stated noise '
            f'explains: the noise is larger, {states}, a sign or a value that is not fitted is '
            'wrong, or the model does not fit; the errors are for the larger noise'
        )
    if residuals.hold_violations:
        found.append(
            f'{residuals.hold_violations} of {counts["holds"]} holds lie beyond the fitted '
            'boundary of slip by more than noise explains'
        )
    return found


def other_solution(names: Sequence[str], values: Floats) -> str:
    """Say that other values fit as well."""
    listed = ', '.join(
        f'{name} = {value:.4g}' for name, value in zip(names, values.tolist(), strict=True)
    )
    return (
        f'other values fit as well: {listed}; the law holds as much with either friction '
        'coefficient, so one of them has to be ruled out in another way'
    )


def _unidentified(fitted: Sequence[FittedParameter], direction: Floats) -> str:
    """Name a direction in which the data say nothing, in shares of the start values.

    What starts at 0 has no share, and is named only.
    """
    parts = [
        (value, part) for value, part in zip(fitted, direction, strict=True) if abs(part) > 1e-3
    ]
    names = [value.name for value, _ in parts]
    if len(parts) == 1:
        return f'{names[0]} is not identifiable: the data do not depend on it'
    first = next((part for value, part in parts if value.start != 0.0), 1.0)
    together = ', '.join(
        f'{value.name} by {part / first:+.3g} %' if value.start != 0.0 else value.name
        for value, part in parts
    )
    return (
        f'{", ".join(names[:-1])} and {names[-1]} are not identifiable '
        f'apart from each other: changing {together} changes nothing in the data; fix one of them'
    )


def _doubts(
    parameter: DesignParameter, ends: Sequence[float], fitted: FittedParameter
) -> list[str]:
    found = []
    if fitted.value is None or fitted.standard_error is None:
        return []
    width = parameter.maximum - parameter.minimum
    for end in ends:
        if abs(fitted.value - end) < 1e-9 * width:
            asked = 'the data ask for a value beyond it'
            if parameter.name == 'stiffness' and end == 0.0:
                asked = 'the data show no backbone, so fit without it'
            found.append(
                f'{parameter.name} is at the end of its range, {end:.6g} {parameter.unit}: {asked}'
            )
    error = fitted.standard_error
    if fitted.name in BIASES:  # of which 0 is a value like any other
        return found
    if error > 0.5 * abs(fitted.value):
        found.append(
            f'{parameter.name} is hardly identifiable: its standard error is {error:.2g} '
            f'{parameter.unit}, more than half of its value'
        )
    return found
