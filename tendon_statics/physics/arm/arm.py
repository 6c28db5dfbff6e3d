"""An arm: units on one another's backs, and the cables that run along them."""

from __future__ import annotations

import numbers
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..design import JointDesign
from ..errors import ArmError, TensionError
from ..tensions import MAX_TENSION

Part = TypeVar('Part')

MOST_UNITS = 50
MAX_LENGTH = 10.0
"""Of a unit, in m"""
MAX_OFFSET = 1.0
"""Of a cable from the edge of a socket, in m; as of a design's"""
MAX_CABLE_FRICTION = 2.0

SIDES = ('l', 's')


@dataclass(frozen=True)
class ArmUnit:
    """One unit of an arm.

    Parameters
    ----------
    design : JointDesign
    length : float
        a in m: along the unit, from the centre of its joint to that of the next, or to the tip.

    Raises
    ------
    ArmError
        If the length is not a number from 0 to 10 m, or the design is none.
    """

    design: JointDesign
    length: float

    def __post_init__(self) -> None:
        if not isinstance(self.design, JointDesign):
            raise ArmError(f'design is {self.design!r}, a JointDesign is needed', key='design')
        length = _number('length', self.length, 0.0, MAX_LENGTH, 'm')
        object.__setattr__(self, 'length', length)


@dataclass(frozen=True)
class Cable:
    """A cable, from the base along one side of an arm to the unit at which it ends.

    Parameters
    ----------
    name : str
        What its tension is called by.
    side : str
        ``l`` or ``s``, as of a single unit: a cable s bends the units that it passes to s.
    last_unit : int
        The unit at which it ends, counted from 1 at the base. It crosses the joints up to that
        unit's.
    offset : float, optional
        δ in m, the distance from the sockets' edge to the cable; None: `cable_offset` of the
        design of each unit that it passes.

    Raises
    ------
    ArmError
        If one of them is not allowed.
    """

    name: str
    side: str
    last_unit: int
    offset: float | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip():
            raise ArmError(f'name is {self.name!r}, a text is needed', key='name')
        if self.side not in SIDES:
            raise ArmError(f'side is {self.side!r}, allowed is l or s', key='side')
        number = _number('last_unit', self.last_unit, 1, MOST_UNITS, '')
        if number != int(number):
            raise ArmError(
                f'last_unit is {self.last_unit!r}, a whole number is needed; the unit at the base '
                'is 1',
                key='last_unit',
            )
        object.__setattr__(self, 'last_unit', int(number))
        if self.offset is not None:
            offset = _number('offset', self.offset, 0.0, MAX_OFFSET, 'm')
            object.__setattr__(self, 'offset', offset)

    @property
    def sign(self) -> float:
        """1 for side s, −1 for side l."""
        return 1.0 if self.side == 's' else -1.0


@dataclass(frozen=True)
class Arm:
    """Units in series, from the base on, and their cables.

    Parameters
    ----------
    units : sequence of ArmUnit
        1 to 50, from the base to the tip.
    cables : sequence of Cable
        Every joint is crossed by a cable at least on either side.
    cable_friction_coefficient : float
        μ_c of the cables on their guides; 0: their tension is the same all along.

    Raises
    ------
    ArmError
        If one of them is not allowed, with the reason.
    """

    units: tuple[ArmUnit, ...]
    cables: tuple[Cable, ...]
    cable_friction_coefficient: float = 0.0

    def __post_init__(self) -> None:
        units = _all_of(ArmUnit, 'units', self.units)
        cables = _all_of(Cable, 'cables', self.cables)
        friction = _number(
            'cable_friction_coefficient',
            *(self.cable_friction_coefficient, 0.0, MAX_CABLE_FRICTION, ''),
        )
        count = len(units)
        if not 1 <= count <= MOST_UNITS:
            raise ArmError(f'there are {count} units, allowed are 1 to {MOST_UNITS}', key='units')
        seen: set[str] = set()
        for number, cable in enumerate(cables, start=1):
            if cable.name in seen:
                raise ArmError(
                    f'two cables are called {cable.name!r}; each needs a name of its own',
                    key=f'cables[{number}].name',
                )
            seen.add(cable.name)
            if cable.last_unit > count:
                raise ArmError(
                    f'cable {cable.name!r} ends at unit {cable.last_unit}, '
                    f'but the last unit is {count}',
                    key=f'cables[{number}].last_unit',
                )
        for side in SIDES:
            reached = max((cable.last_unit for cable in cables if cable.side == side), default=0)
            if reached < count:
                raise ArmError(
                    f'no cable {side} crosses joint {reached + 1}: each joint needs a cable at '
                    f'least on either side, so one has to end at unit {count}',
                    key='cables',
                )
        object.__setattr__(self, 'units', units)
        object.__setattr__(self, 'cables', cables)
        object.__setattr__(self, 'cable_friction_coefficient', friction)

    @cached_property
    def designs(self) -> tuple[JointDesign, ...]:
        """Of the units, from the base on."""
        return tuple(unit.design for unit in self.units)

    @cached_property
    def stops(self) -> tuple[float, ...]:
        """θ_max of each joint in rad."""
        return tuple(design.max_bend_angle for design in self.designs)

    @cached_property
    def cable_ends(self) -> tuple[int, ...]:
        """The unit at which each cable ends, counted from 1 at the base."""
        return tuple(cable.last_unit for cable in self.cables)

    @cached_property
    def cable_levers(self) -> NDArray[np.float64]:
        """Lever in m of each cable at each joint, to side s: shape (joints, cables).

        Zero where it does not cross the joint.
        """
        levers = np.zeros((len(self.units), len(self.cables)))
        for index, cable in enumerate(self.cables):
            for joint, design in enumerate(self.designs[: cable.last_unit]):
                offset = design.cable_offset if cable.offset is None else cable.offset
                levers[joint, index] = cable.sign * (design.ball_radius + offset)
        return levers

    @cached_property
    def cable_names(self) -> tuple[str, ...]:
        """In the arm's order."""
        return tuple(cable.name for cable in self.cables)

    def check_tensions(self, tensions: Mapping[str, float]) -> list[float]:
        """Return the tensions of all cables in N, in the arm's order.

        Raises
        ------
        TensionError
            If one is missing or unknown, or is not a number from 0 to `MAX_TENSION`.
        """
        if len(tensions) != len(self.cables) or any(n not in tensions for n in self.cable_names):
            self._refuse_names(tensions)
        return [self._tension(name, tensions[name]) for name in self.cable_names]

    def _refuse_names(self, tensions: Mapping[str, float]) -> None:
        there = ', '.join(self.cable_names)
        for name in self.cable_names:
            if name not in tensions:
                raise TensionError(f'the tension of cable {name} is missing; there are {there}')
        unknown = next(name for name in tensions if name not in self.cable_names)
        raise TensionError(f'there is no cable {unknown!r}; there are {there}')

    def _tension(self, name: str, value: object) -> float:
        if type(value) is float and 0.0 <= value <= MAX_TENSION:
            return value
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise TensionError(
                f'the tension of cable {name} is {value!r}, which is not a number; it is taken in '
                'N'
            )
        tension = float(value)
        if not 0.0 <= tension <= MAX_TENSION:
            raise TensionError(
                f'the tension of cable {name} is {value!r} N, allowed is 0 to {MAX_TENSION:g} N'
            )
        return tension


def _number(name: str, value: object, low: float, high: float, unit: str) -> float:
    """Return a number within a closed range.

    Raises
    ------
    ArmError
        If it is none.
    """
    unit = f' {unit}' if unit else ''
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise ArmError(
            f'{name} is {value!r}, which is not a number: '
            f'a number from {low:g} to {high:g}{unit} is needed',
            key=name,
        )
    number = float(value)
    if not low <= number <= high:
        raise ArmError(
            f'{name} is {value!r}{unit}, allowed is {low:g} to {high:g}{unit}', key=name
        )
    return number


def _all_of(kind: type[Part], name: str, values: object) -> tuple[Part, ...]:
    found = tuple(values) if isinstance(values, Iterable) else (values,)
    for number, value in enumerate(found, start=1):
        if not isinstance(value, kind):
            raise ArmError(
                f'{name}[{number}] is {value!r}, but a {kind.__name__} is needed',
                key=f'{name}[{number}]',
            )
    return found
