"""The geometry, mass and friction of one ball-joint unit."""

from __future__ import annotations

import dataclasses
import math
import numbers
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from .contact import CONTACT_LAWS, ContactLaw
from .errors import DesignError, DesignMisfitError


@dataclasses.dataclass(frozen=True)
class DesignParameter:
    """What is known of a field of `JointDesign` that is a number: meaning, unit, closed range."""

    name: str
    symbol: str
    unit: str
    minimum: float
    maximum: float
    description: str
    default: float | None = None

    @property
    def allowed(self) -> str:
        """The range as a person reads it, say ``0 to 100 kg``."""
        unit = f' {self.unit}' if self.unit else ''
        return f'{self.minimum:.6g} to {self.maximum:.6g}{unit}'

    def check(self, value: object) -> float:
        """Return `value` as a float.

        Raises
        ------
        DesignError
            If it is not a number (a bool is not) or lies outside the range; NaN always does.
        """
        if type(value) is not float and (  # which is tested in no time
            isinstance(value, bool) or not isinstance(value, numbers.Real)
        ):
            raise DesignError(
                f'{self.name} is {value!r}, which is not a number: '
                f'a number from {self.allowed} is needed',
                key=self.name,
            )
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not self.minimum <= number <= self.maximum:
            hint = (
                ' (angles are in radians)' if self.unit == 'rad' and math.isfinite(number) else ''
            )
            raise DesignError(
                f'{self.name} is {number!r}, allowed is {self.allowed}{hint}', key=self.name
            )
        return number


@dataclasses.dataclass(frozen=True)
class DesignChoice:
    """What is known of a field of `JointDesign` that is a word: its meaning and the choices."""

    name: str
    description: str
    choices: tuple[str, ...]
    symbol: str = ''
    unit: str = ''

    @property
    def default(self) -> str:
        """The first of the choices."""
        return self.choices[0]

    @property
    def allowed(self) -> str:
        """The choices as a person reads them."""
        return ', '.join(self.choices)

    def check(self, value: object) -> str:
        """Return `value` if it is one of the choices.

        Raises
        ------
        DesignError
            If it is not.
        """
        if value not in self.choices:
            raise DesignError(
                f'{self.name} is {value!r}, allowed is one of {self.allowed}', key=self.name
            )
        return str(value)


def _parameter(
    symbol: str, unit: str, minimum: float, maximum: float, description: str, **default: float
) -> Any:
    return dataclasses.field(
        metadata={
            'symbol': symbol,
            'unit': unit,
            'minimum': minimum,
            'maximum': maximum,
            'description': description,
            **default,
        },
        **default,  # type: ignore[call-overload]
    )


@dataclasses.dataclass(frozen=True)
class JointDesign:
    """One ball-joint unit driven by two cables; SI units, angles in radians.

    Fields and what they may be are listed by `design_fields`. The contact angles are polar angles
    from the unit's vertical axis, at zero bend.

    Raises
    ------
    DesignError
        If a value is not a number or out of its range.
    DesignMisfitError
        If the contact zone is empty, or the contact law takes no such zone.
    """

    ball_radius: float = _parameter('r', 'm', 1e-4, 1.0, 'radius of the ball joint')
    cable_offset: float = _parameter('δ', 'm', 0.0, 1.0, 'distance from socket edge to cable')
    com_distance: float = _parameter(
        'l', 'm', -1.0, 1.0, 'joint centre to centre of gravity; negative for a unit hanging down'
    )
    mass: float = _parameter('m', 'kg', 0.0, 100.0, 'mass of the unit')
    friction_coefficient: float = _parameter(
        'μ', '', 1e-3, 10.0, 'static friction coefficient of the joint surface'
    )
    contact_start_angle: float = _parameter(
        'θ1', 'rad', 0.0, math.pi, 'start of the contact zone; smaller than its end'
    )
    contact_end_angle: float = _parameter('θ2', 'rad', 0.0, math.pi, 'end of the contact zone')
    max_bend_angle: float = _parameter(
        'θ_max', 'rad', 1e-3, math.pi / 2, 'bend angle at the mechanical stop'
    )
    gravity: float = _parameter('g', 'm/s^2', 0.0, 100.0, 'gravitational acceleration')
    contact_width: float = _parameter(
        'w', 'm', 1e-6, 10.0, 'depth of the contact zone across the plane of bending', default=1.0
    )

    contact_law: str = dataclasses.field(
        default=next(iter(CONTACT_LAWS)),
        metadata={
            'description': 'how much friction in the contact can hold',
            'choices': tuple(CONTACT_LAWS),
        },
    )
    stiffness: float = _parameter(
        'k', 'N·m/rad', 0.0, 100.0, 'of a backbone or sheath that bends back', default=0.0
    )

    def __post_init__(self) -> None:
        for parameter in design_fields():
            value = parameter.check(getattr(self, parameter.name))
            object.__setattr__(self, parameter.name, value)
        span = self.contact_end_angle - self.contact_start_angle
        if not span >= _SMALLEST_CONTACT_SPAN:
            raise DesignMisfitError(
                f'contact_end_angle is {self.contact_end_angle!r} and contact_start_angle is '
                f'{self.contact_start_angle!r}: the end must exceed the start by at least '
                f'{_SMALLEST_CONTACT_SPAN:g} rad',
                key='contact_end_angle',
            )
        try:
            law = CONTACT_LAWS[self.contact_law](
                self.friction_coefficient, self.contact_start_angle, self.contact_end_angle
            )
        except ValueError as error:
            raise DesignMisfitError(str(error), key='contact_end_angle') from None
        object.__setattr__(self, '_law', law)

    @classmethod
    def from_mapping(cls, values: Mapping[str, object]) -> JointDesign:
        """Build a design from a mapping of field names to numbers.

        Raises
        ------
        DesignError
            As the constructor does, and for unknown or missing names.
        """
        known = {field.name: field for field in design_fields()}
        for key, value in values.items():
            if key not in known:
                raise DesignError(
                    f'{key} is {value!r}, but there is no such design parameter; '
                    f'there are {", ".join(known)}',
                    key=str(key),
                )
        for parameter in known.values():
            if parameter.name not in values and parameter.default is None:
                raise DesignError(
                    f'{parameter.name} is missing: '
                    f'{parameter.description}, a number from {parameter.allowed}',
                    key=parameter.name,
                )
        return cls(**values)  # type: ignore[arg-type]

    @cached_property
    def weight(self) -> float:
        """W = m g, in N."""
        return self.mass * self.gravity

    @cached_property
    def cable_lever(self) -> float:
        """Lever r + δ of the cables about the centre of the ball, in m."""
        return self.ball_radius + self.cable_offset

    @cached_property
    def relative_lever(self) -> float:
        """That lever in radii of the ball, (r + δ) / r."""
        return self.cable_lever / self.ball_radius

    @cached_property
    def contact_centre_angle(self) -> float:
        """β = (θ1 + θ2) / 2, in rad: the direction of the contact force at zero bend."""
        return 0.5 * (self.contact_start_angle + self.contact_end_angle)

    @cached_property
    def contact_length(self) -> float:
        """C = 2 r sin η with η = (θ2 − θ1) / 2, in m: the contact force is N = p C w."""
        half_span = 0.5 * (self.contact_end_angle - self.contact_start_angle)
        return 2.0 * self.ball_radius * math.sin(half_span)

    @cached_property
    def contact_area(self) -> float:
        """N / p in m²: contact force over mean pressure, C w but for ``elastic_seat``."""
        return self.law.contact_area(self.ball_radius, self.contact_width)

    @property
    def law(self) -> ContactLaw:
        """The contact law, with what it takes from the design."""
        return self._law  # type: ignore[attr-defined, no-any-return]


# Below this the contact length C, and with it every pressure, loses its digits.
_SMALLEST_CONTACT_SPAN = 1e-6

_FIELDS: tuple[DesignParameter | DesignChoice, ...] = tuple(
    (DesignChoice if 'choices' in field.metadata else DesignParameter)(
        name=field.name, **field.metadata
    )
    for field in dataclasses.fields(JointDesign)
)


def design_fields() -> tuple[DesignParameter | DesignChoice, ...]:
    """Meaning, unit and allowed values of every field of `JointDesign`, in its order."""
    return _FIELDS


def design_parameters() -> tuple[DesignParameter, ...]:
    """Those of `design_fields` that are numbers."""
    return tuple(field for field in _FIELDS if isinstance(field, DesignParameter))
