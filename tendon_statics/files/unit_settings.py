"""From the values of the estimator's parameters to what it computes with."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import Any

from ..estimation.methods import METHODS
from ..estimation.settings import Settings
from ..physics import Load
from ..physics.admissible import check_bend_angle
from ..physics.design import JointDesign, design_fields
from ..physics.errors import BendAngleError, DesignError, DesignMisfitError, LoadError
from ..physics.load import push_along
from ..tensions.cable_scale import CableScale
from ..tensions.watch import Plausibility
from .design_file import check_uncertainty, uncertainty_in
from .estimator_parameters import (
    DESIGN,
    ESTIMATIONS,
    ESTIMATOR_PARAMETERS,
    NUMBERS,
    VECTORS,
    known_names,
)
from .parameter_kinds import MisfitError, Parameter, SettingError

GRAVITY_DIRECTION, TIP_DIRECTION = 'gravity_direction', 'tip_direction'


def misspelt(names: Mapping[str, object]) -> list[str]:
    """Say of each name that is close to a parameter's which is probably meant."""
    known = sorted(known_names())
    found = []
    for name in not_known(names):
        close = get_close_matches(name, known, 1, cutoff=0.85)
        if close:
            found.append(f'{name} is no parameter of the estimator; is {close[0]} meant?')
    return found


def not_known(names: Iterable[str]) -> list[str]:
    """Return those names that no parameter of the estimator has; a design's have been checked."""
    known = known_names()
    return [
        name
        for name in names
        if name not in known and not name.startswith((DESIGN, 'qos_overrides.'))
    ]


def check_parameters(values: Mapping[str, object]) -> None:
    """Check what is given of the estimator's parameters, one by one.

    Raises
    ------
    SettingError
        If a value is not allowed; the text names the parameter, its value and what is allowed.
    """
    for parameter in ESTIMATOR_PARAMETERS:
        if parameter.name in values:
            parameter.check(values[parameter.name])
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
    _check_directions(values)


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

    def given(parameter: Parameter) -> Any:
        return values.get(parameter.name, parameter.default)

    number = {parameter.name: given(parameter) for parameter in NUMBERS}
    vector: dict[str, Any] = {
        parameter.name: tuple(map(float, given(parameter))) for parameter in VECTORS
    }
    plain: dict[str, Any] = {
        field.name: float(number[field.name])
        for field in dataclasses.fields(Settings)
        if field.name in number
    }
    try:
        settings = Settings(
            design=design,
            design_uncertainty=uncertainty,
            cable_l=_cable_scale('cable_l', number),
            cable_s=_cable_scale('cable_s', number),
            plausibility=Plausibility(
                float(number['max_tension_rate']),
                number['saturation_count'],
                number['frozen_count'],
            ),
            **vector,
            **plain,
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


def _check_directions(values: Mapping[str, Any]) -> None:
    try:
        if GRAVITY_DIRECTION in values:
            Load(tuple(map(float, values[GRAVITY_DIRECTION])))  # type: ignore[arg-type]
    except LoadError as error:
        raise SettingError(str(error)) from None
    try:
        if TIP_DIRECTION in values:
            push_along(tuple(map(float, values[TIP_DIRECTION])), 0.0)
    except LoadError as error:
        raise SettingError(f'tip_{error}') from None


def _cable_scale(cable: str, number: Mapping[str, float]) -> CableScale:
    """Make a cable's scale."""
    return CableScale(**{name: float(number[f'{cable}.{name}']) for name in CableScale._fields})
