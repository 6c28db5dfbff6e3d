"""Kinds of parameters: what each means and what it may be. A table of them describes a node."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Iterable, Mapping
from typing import Any, TypeGuard

from ..physics.errors import TendonStaticsError


class SettingError(TendonStaticsError, ValueError):
    """A parameter has a value that is not allowed; the text is for the user."""


class MisfitError(SettingError):
    """Values of parameters do not fit together, though each is allowed by itself."""


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A parameter of a node, of any kind."""

    name: str
    default: Any
    description: str
    is_fixed: bool = dataclasses.field(default=True, kw_only=True)
    """Whether it can only be set at the start"""

    @property
    def allowed(self) -> str:
        """What it may be, as a person reads it; empty if that is all of its type."""
        return ''

    def converted(self, value: Any) -> Any:
        """Return a value in the type that the node keeps, if it can be meant as such."""
        return value

    def check(self, value: object) -> None:
        """Raise a `SettingError` for a value that is not allowed."""
        if type(value) is not type(self.default):
            kind = {bool: 'true or false', str: 'a text'}[type(self.default)]
            raise SettingError(f'{self.name} is {value!r}, but {kind} is needed')


@dataclasses.dataclass(frozen=True)
class SwitchParameter(Parameter):
    """True or false."""

    default: bool

    @property
    def allowed(self) -> str:
        """True or false."""
        return 'true or false'


@dataclasses.dataclass(frozen=True)
class TextParameter(Parameter):
    """A text."""

    default: str


@dataclasses.dataclass(frozen=True)
class ChoiceParameter(Parameter):
    """One of a few texts."""

    default: str
    choices: tuple[str, ...] = dataclasses.field(kw_only=True)

    @property
    def allowed(self) -> str:
        """The choices, with an ``or`` between them."""
        return ' or '.join(self.choices)

    def check(self, value: object) -> None:
        """Raise a `SettingError` for any other value."""
        if value not in self.choices:
            raise SettingError(f'{self.name} is {value!r}, allowed is {self.allowed}')


@dataclasses.dataclass(frozen=True)
class NamePairParameter(Parameter):
    """Two different names, of cables l and s."""

    default: tuple[str, str]

    @property
    def allowed(self) -> str:
        """Two names."""
        return 'two different names'

    def check(self, value: object) -> None:
        """Raise a `SettingError` unless it is a sequence of two different names."""
        names = list(value) if isinstance(value, (list, tuple)) else value
        if not (
            isinstance(names, list)
            and len(names) == 2
            and all(isinstance(name, str) and name for name in names)
            and names[0] != names[1]
        ):
            raise SettingError(
                f'{self.name} is {names!r}, two different names are needed, of cables l and s'
            )


@dataclasses.dataclass(frozen=True)
class NumberParameter(Parameter):
    """A number in a closed range; an integer if its default is one."""

    default: float
    minimum: float = dataclasses.field(kw_only=True)
    maximum: float = dataclasses.field(kw_only=True)
    unit: str = dataclasses.field(default='', kw_only=True)
    may_be_zero: bool = dataclasses.field(default=True, kw_only=True)
    is_fixed: bool = dataclasses.field(default=False, kw_only=True)

    @property
    def allowed(self) -> str:
        """The range as a person reads it, say ``0 to 1000 N``."""
        unit = f' {self.unit}' if self.unit else ''
        zero = '' if self.may_be_zero else ', not 0'
        return f'{self.minimum:.10g} to {self.maximum:.10g}{unit}{zero}'

    def converted(self, value: Any) -> Any:
        """Return a float for a whole number, unless it counts, and a number for its text.

        ``ros2 param set`` makes an integer of ``1`` and a text of ``1e-2``.
        """
        if isinstance(value, str) and _NUMBER.fullmatch(value):
            value = int(value) if value.lstrip('+-').isdecimal() else float(value)
        return value if self.is_integer else _as_float(value)

    def fixed(self) -> NumberParameter:
        """Return the same for a node in which it can only be set at the start."""
        return dataclasses.replace(self, is_fixed=True)

    @property
    def is_integer(self) -> bool:
        """Whether it counts."""
        return isinstance(self.default, int)

    def check(self, value: object) -> None:
        """Raise a `SettingError` for a value that is not allowed; NaN never is, nor is a bool."""
        kinds, name = (int, 'an integer') if self.is_integer else ((int, float), 'a number')
        if isinstance(value, bool) or not isinstance(value, kinds):
            raise SettingError(
                f'{self.name} is {value!r}, which is not {name}: allowed is {self.allowed}'
            )
        if not self.minimum <= value <= self.maximum or (value == 0 and not self.may_be_zero):
            raise SettingError(f'{self.name} is {value!r}, allowed is {self.allowed}')


@dataclasses.dataclass(frozen=True)
class VectorParameter(Parameter):
    """Three finite numbers."""

    default: tuple[float, float, float]
    unit: str = dataclasses.field(default='', kw_only=True)
    is_fixed: bool = dataclasses.field(default=False, kw_only=True)

    @property
    def allowed(self) -> str:
        """Three numbers."""
        return 'three finite numbers'

    def converted(self, value: Any) -> Any:
        """Return floats for whole numbers."""
        return [_as_float(number) for number in value] if _is_list(value) else value

    def check(self, value: object) -> None:
        """Raise a `SettingError` unless it is a sequence of three finite numbers."""
        given = list(value) if _is_list(value) else []
        if len(given) != 3 or not all(map(_is_finite, given)):
            raise SettingError(f'{self.name} is {value!r}, but {self.allowed} are needed')


@dataclasses.dataclass(frozen=True)
class ListParameter(Parameter):
    """Texts, or numbers if it says so, as many as it takes; none at first."""

    default: tuple[()]
    of_numbers: bool = dataclasses.field(default=False, kw_only=True)
    is_fixed: bool = dataclasses.field(default=False, kw_only=True)

    @property
    def allowed(self) -> str:
        """What is in it."""
        return 'finite numbers' if self.of_numbers else 'names'

    def converted(self, value: Any) -> Any:
        """Return a list, with floats for whole numbers."""
        return [_as_float(one) for one in value] if _is_list(value) else value

    def check(self, value: object) -> None:
        """Raise a `SettingError` unless it is a sequence of what is in it."""
        if not _is_list(value):
            raise SettingError(f'{self.name} is {value!r}, a list is needed')
        fits, needed = (_is_finite, 'a finite number') if self.of_numbers else (_is_text, 'a name')
        for one in value:
            if not fits(one):
                raise SettingError(f'{self.name} has {one!r}, {needed} is needed')


def in_their_types(parameters: Iterable[Parameter], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values by name as a node with these parameters keeps them; others as they are."""
    by_name = {parameter.name: parameter for parameter in parameters}
    return {
        name: by_name[name].converted(value) if name in by_name else value
        for name, value in values.items()
    }


def check_given(parameters: Iterable[Parameter], values: Mapping[str, object]) -> None:
    """Raise a `SettingError` for the first of these parameters whose value is not allowed."""
    for parameter in parameters:
        if parameter.name in values:
            parameter.check(values[parameter.name])


_NUMBER = re.compile(r'[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?')


def _as_float(value: Any) -> Any:
    """Return a float for an integer, and anything else as it is."""
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _is_list(value: object) -> TypeGuard[Iterable[Any]]:
    """Whether it has members, as an array from ROS does, too."""
    return isinstance(value, Iterable) and not isinstance(value, (str, bytes))


def _is_finite(value: object) -> bool:
    return type(value) in (int, float) and math.isfinite(value)  # type: ignore[arg-type]


def _is_text(value: object) -> bool:
    return isinstance(value, str)
