"""From the values of parameters to how something is measured, whether a unit or an arm."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any

from ..estimation.measuring import Measuring
from ..physics import Load
from ..physics.errors import LoadError
from ..physics.load import push_along
from ..tensions.cable_scale import CableScale
from ..tensions.watch import Plausibility
from .parameter_kinds import NumberParameter, Parameter, SettingError, VectorParameter

GRAVITY_DIRECTION, TIP_DIRECTION = 'gravity_direction', 'tip_direction'


def check_directions(values: Mapping[str, Any]) -> None:
    """Check the vectors that are given.

    Raises
    ------
    SettingError
        If one gives no direction.
    """
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


def numbers_in(values: Mapping[str, Any], table: Iterable[NumberParameter]) -> dict[str, Any]:
    """Return the numbers of a table by name; what is not given has its default."""
    return {parameter.name: _given(values, parameter) for parameter in table}


def measuring_in(
    values: Mapping[str, Any],
    numbers: Iterable[NumberParameter],
    vectors: Iterable[VectorParameter],
    kind: type[Measuring],
) -> dict[str, Any]:
    """Return what parameters say of the fields of settings, by the fields' names.

    Parameters
    ----------
    kind : type
        Of the settings.
    """
    number = numbers_in(values, numbers)
    plain = {
        field.name: float(number[field.name])
        for field in dataclasses.fields(kind)
        if field.name in number
    }
    vector = {of.name: tuple(map(float, _given(values, of))) for of in vectors}
    believed = Plausibility(
        float(number['max_tension_rate']), number['saturation_count'], number['frozen_count']
    )
    return {**plain, **vector, 'plausibility': believed}


def cable_scale(prefix: str, number: Mapping[str, float]) -> CableScale:
    """Make the scale of the cable whose parameters have names that begin so."""
    return CableScale(**{name: float(number[f'{prefix}{name}']) for name in CableScale._fields})


def _given(values: Mapping[str, Any], parameter: Parameter) -> Any:
    return values.get(parameter.name, parameter.default)
