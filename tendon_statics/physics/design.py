"""The geometry, mass and friction of one ball-joint unit."""

from __future__ import annotations

import dataclasses
import math
import numbers
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from .errors import DesignError
from .geometry import SlipGeometry


@dataclasses.dataclass(frozen=True)
class DesignParameter:
    """What is known of one field of `JointDesign`: its meaning, unit and closed range."""

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
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
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

    Fields and their ranges are listed by `design_parameters`. The contact angles are polar angles
    from the unit's vertical axis, at zero bend.

    Raises
    ------
    DesignError
        If a value is not a number or out of its range, or the contact zone is empty.
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

    def __post_init__(self) -> None:
        for parameter in design_parameters():
            value = parameter.check(getattr(self, parameter.name))
            object.__setattr__(self, parameter.name, value)
        span = self.contact_end_angle - self.contact_start_angle
        if not span >= _SMALLEST_CONTACT_SPAN:
            raise DesignError(
                f'contact_end_angle is {self.contact_end_angle!r} and contact_start_angle is '
                f'{self.contact_start_angle!r}: the end must exceed the start by at least '
                f'{_SMALLEST_CONTACT_SPAN:g} rad',
                key='contact_end_angle',
            )

    @classmethod
    def from_mapping(cls, values: Mapping[str, object]) -> JointDesign:
        """Build a design from a mapping of field names to numbers.

        Raises
        ------
        DesignError
            As the constructor does, and for unknown or missing names.
        """
        known = {parameter.name: parameter for parameter in design_parameters()}
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
        """C w, in m²: contact force over mean pressure."""
        return self.contact_length * self.contact_width

    @cached_property
    def slip_geometry(self) -> SlipGeometry:
        """What the slip equation takes from the design alone."""
        return SlipGeometry(self)


# Below this the contact length C, and with it every pressure, loses its digits.
_SMALLEST_CONTACT_SPAN = 1e-6

_PARAMETERS = tuple(
    DesignParameter(name=field.name, **field.metadata) for field in dataclasses.fields(JointDesign)
)


def design_parameters() -> tuple[DesignParameter, ...]:
    """Meaning, unit and range of every field of `JointDesign`, in its order."""
    return _PARAMETERS
