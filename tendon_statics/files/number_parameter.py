"""A number that is set by parameter: what it means and what it may be."""

from __future__ import annotations

import dataclasses

from ..physics.errors import TendonStaticsError


class SettingError(TendonStaticsError, ValueError):
    """A parameter has a value that is not allowed; the text is for the user."""


@dataclasses.dataclass(frozen=True)
class NumberParameter:
    """Meaning, unit and closed range of a parameter; an integer if its default is one."""

    name: str
    default: float
    minimum: float
    maximum: float
    unit: str
    description: str

    @property
    def allowed(self) -> str:
        """The range as a person reads it, say ``0 to 1000 N``."""
        unit = f' {self.unit}' if self.unit else ''
        return f'{self.minimum:.10g} to {self.maximum:.10g}{unit}'

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
        if not self.minimum <= value <= self.maximum:
            raise SettingError(f'{self.name} is {value!r}, allowed is {self.allowed}')
