"""What keeps a fitted design from being written to a file that a node would take."""

from __future__ import annotations

from ..physics.calibration import Calibration
from ..physics.calibration.parameters import fit_parameters

FACTOR = 10.0
"""Factor by which a fitted value may differ from the start, which was drawn or weighed"""

AT_END = 1e-6
"""Share of the range within which a value counts as at its end"""

MOST_FRICTION = 3.0
"""Friction coefficient that no dry pair of joint materials exceeds"""


def objections(calibration: Calibration) -> list[str]:
    """Say which fitted values cannot be believed, a clause each; none if all can.

    A value at the end of its range is where the search was stopped, not where the data led it.
    One that is an order of magnitude from the drawing, or a friction that no material has, is
    what samples give that were not slipping, or are in another unit.
    """
    ranges = {parameter.name: parameter for parameter in fit_parameters()}
    found = []
    for fitted in calibration.parameters:
        if fitted.value is None:
            continue
        parameter = ranges[fitted.name]
        value, start = fitted.value, fitted.start
        said = f'{fitted.name} = {value:.4g} {parameter.unit}'.rstrip()
        # The range that was searched may end before that of the parameter, as the weight below
        # the tensions; then a warning says so.
        width = parameter.maximum - parameter.minimum
        if min(value - parameter.minimum, parameter.maximum - value) < AT_END * width or any(
            warning.startswith(f'{fitted.name} is at the end of its range')
            for warning in calibration.warnings
        ):
            found.append(f'{said} is at the end of its range')
        elif fitted.name == 'friction_coefficient' and value > MOST_FRICTION:
            found.append(f'{said} is more than any joint has')
        elif start != 0.0 and abs(value) > FACTOR * abs(start):
            found.append(f'{said} is more than {FACTOR:g} times the start, {start:.4g}')
        elif parameter.minimum >= 0.0 and 0.0 <= value < abs(start) / FACTOR:
            found.append(f'{said} is less than a {FACTOR:g}th of the start, {start:.4g}')
    return found
