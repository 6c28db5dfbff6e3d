"""From the values of the estimator's parameters to what it computes with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..estimation.methods import METHODS
from ..estimation.settings import Settings
from ..physics.admissible import check_bend_angle
from ..physics.design import JointDesign, design_fields
from ..physics.errors import BendAngleError, DesignError, DesignMisfitError
from .design_file import check_uncertainty, uncertainty_in
from .estimator_parameters import (
    DESIGN,
    ESTIMATIONS,
    ESTIMATOR_PARAMETERS,
    NUMBERS,
    VECTORS,
)
from .measuring_values import cable_scale, check_directions, measuring_in, numbers_in
from .parameter_kinds import MisfitError, SettingError, check_given


def check_parameters(values: Mapping[str, object]) -> None:
    """Check what is given of the estimator's parameters, one by one.

    Raises
    ------
    SettingError
        If a value is not allowed; the text names the parameter, its value and what is allowed.
    """
    check_given(ESTIMATOR_PARAMETERS, values)
    for field in design_fields():
        if DESIGN + field.name in values:
            try:
                field.check(values[DESIGN + field.name])
            except DesignError as error:
                raise _refusal(error, DESIGN) from error
    try:
        check_uncertainty(values)
    except DesignError as error:
        raise _refusal(error) from error
    check_directions(values)


def settings_from(values: Mapping[str, Any]) -> Settings:
    """Make settings of the values of parameters by name; what is not given has its default.

    Foreign names are left alone.

    Raises
    ------
    SettingError
        If a value is not valid; the text names the parameter, its value and what is allowed.
    MisfitError
        If each is valid by itself, and the whole is not.
    """
    check_parameters(values)
    try:
        design = JointDesign.from_mapping(
            {
                name.removeprefix(DESIGN): value
                for name, value in values.items()
                if name.startswith(DESIGN)
            }
        )
    except DesignError as error:
        raise _refusal(error, DESIGN if error.key else '') from error
    try:
        uncertainty = uncertainty_in(values)
    except DesignError as error:
        raise _refusal(error) from error

    number = numbers_in(values, NUMBERS)
    try:
        settings = Settings(
            design=design,
            design_uncertainty=uncertainty,
            cable_l=cable_scale('cable_l.', number),
            cable_s=cable_scale('cable_s.', number),
            **measuring_in(values, NUMBERS, VECTORS, Settings),
        )
        check_bend_angle(design, settings.initial_bend_angle)
    except BendAngleError as error:
        raise MisfitError(f'initial_{error}') from None
    refusal = METHODS[values.get('estimation', ESTIMATIONS[0])].refusal(settings)
    if refusal:
        raise SettingError(refusal)
    return settings


def _refusal(error: DesignError, prefix: str = '') -> SettingError:
    kind = MisfitError if isinstance(error, DesignMisfitError) else SettingError
    return kind(f'{prefix}{error}')
