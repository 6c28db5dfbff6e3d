"""The dead load: what acts on a unit beside its cables and the contact.

In the joint frame (origin in the ball's centre, Z along the unit at zero bend, X towards cable s)
the unit's axis is u = (sin θ, cos θ) at the bend angle θ, and e = (cos θ, −sin θ) is across it.
The dead load has the resultant P and the moment Q·e about the centre, with

    P = W + F,   Q = l W + L F,

the weight W at the distance l along the axis and a force F at the distance L. Both are fixed in
the joint frame, whatever the bend angle is.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

from .design import JointDesign
from .errors import LoadError

if TYPE_CHECKING:
    from .stacked_design import StackedDesign

MAX_FORCE = 1e9
"""Largest force at the tip in N that is taken; far above any instrument, far below overflow."""


@dataclass(frozen=True)
class Load:
    """What acts on a unit beside its cables and the contact, in the joint frame.

    Parameters
    ----------
    gravity_direction : sequence of float
        Direction ``(x, y, z)`` of gravity, of any length but zero. The part across the plane of
        bending (y) is carried by the guides and left out.
    tip_force : sequence of float
        Force ``(x, z)`` on the unit in N, fixed in the joint frame.
    tip_distance : float
        Distance in m along the unit's axis at which it acts.

    Raises
    ------
    LoadError
        If one of them is not made of finite numbers, or the direction is of length zero.
    """

    gravity_direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    tip_force: tuple[float, float] = (0.0, 0.0)
    tip_distance: float = 0.0

    def __post_init__(self) -> None:
        direction = _numbers('gravity_direction', self.gravity_direction, ('x', 'y', 'z'))
        length = math.hypot(*direction)
        if not length > 0.0:
            raise LoadError(
                f'gravity_direction is {self.gravity_direction!r}, which is of length zero: '
                'a direction (x, y, z) in the joint frame is needed'
            )
        x, y, z = (part / length for part in direction)
        object.__setattr__(self, 'gravity_direction', (x, y, z))
        object.__setattr__(self, 'tip_force', _numbers('tip_force', self.tip_force, ('x', 'z')))
        (distance,) = _numbers('tip_distance', (self.tip_distance,), ('distance',))
        object.__setattr__(self, 'tip_distance', distance)

    @classmethod
    def tilted(
        cls,
        base_tilt: float,
        tip_force: Sequence[float] = (0.0, 0.0),
        tip_distance: float = 0.0,
    ) -> Load:
        """Return the load of a unit on a base that is tilted in the plane of bending.

        Parameters
        ----------
        base_tilt : float
            γ in rad, positive towards cable s.

        Raises
        ------
        LoadError
            As the constructor does.
        """
        (tilt,) = _numbers('base_tilt', (base_tilt,), ('tilt',))
        direction = (math.sin(tilt), 0.0, -math.cos(tilt))
        return cls(direction, tip_force, tip_distance)  # type: ignore[arg-type]

    @property
    def base_tilt(self) -> float:
        """γ in rad: the tilt of the base in the plane of bending."""
        x, _, z = self.gravity_direction
        return math.atan2(x, -z)

    def mirrored(self) -> Load:
        """Return the load of the mirror image, with the cables' sides swapped."""
        x, y, z = self.gravity_direction
        force_x, force_z = self.tip_force
        return Load((-x, y, z), (-force_x, force_z), self.tip_distance)

    def on(self, design: JointDesign | StackedDesign) -> DeadLoad:
        """Return the forces and moments that it means for one unit."""
        return DeadLoad.of(design, self.gravity_direction, self.tip_force, self.tip_distance)


class DeadLoad(NamedTuple):
    """Resultant and moment of the dead load of one joint, in the joint frame.

    Floats, or arrays of one shape.
    """

    force_x: Any
    """P_x in N"""
    force_z: Any
    """P_z in N"""
    moment_x: Any
    """Q_x in N·m"""
    moment_z: Any
    """Q_z in N·m"""

    @classmethod
    def of(
        cls,
        design: JointDesign | StackedDesign,
        gravity_direction: tuple[float, float, float],
        force: tuple[float, float],
        distance: float,
    ) -> DeadLoad:
        """Return it for one unit.

        Parameters
        ----------
        gravity_direction : tuple of float
            Of length 1.
        force : tuple of float
            Force (x, z) in N at `distance` in m along the unit's axis.
        """
        weight, lever = design.weight, design.com_distance
        x, _, z = gravity_direction
        force_x, force_z = force
        weight_x, weight_z = weight * x, weight * z
        return cls(
            weight_x + force_x,
            weight_z + force_z,
            lever * weight_x + distance * force_x,
            lever * weight_z + distance * force_z,
        )

    @property
    def size(self) -> Any:
        """|P| in N."""
        if isinstance(self.force_x, float):
            return math.hypot(self.force_x, self.force_z)
        return abs(self.force_x + 1j * self.force_z)

    def plus(self, other: DeadLoad, times: float = 1.0) -> DeadLoad:
        """Return both together, the other so many times."""
        force_x, force_z, moment_x, moment_z = self
        x, z, of_x, of_z = other
        return DeadLoad(
            force_x + times * x,
            force_z + times * z,
            moment_x + times * of_x,
            moment_z + times * of_z,
        )

    def largest_pull(self, stop: float) -> float:
        """Largest −P_a in N, with which it pulls the unit off the ball, within ±`stop` in rad."""
        farthest = min(abs(math.atan2(self.force_x, -self.force_z)) + stop, math.pi)
        return max(0.0, -float(self.size) * math.cos(farthest))

    def at(self, angle: float) -> tuple[float, float]:
        """P_a and P_t in N at a bend angle in rad: along the axis, on the ball; across, to s."""
        cosine, sine = math.cos(angle), math.sin(angle)
        return (
            -self.force_x * sine - self.force_z * cosine,
            self.force_x * cosine - self.force_z * sine,
        )


UNIT_LENGTH = 1e-3
"""By how much the length of a direction may differ from 1, as of numbers typed by hand"""

IN_PLANE = 1e-9
"""Share of a direction across the plane of bending that may be rounding"""

FARTHEST = 10.0
"""m; more than any unit's length"""


def push_along(direction: Sequence[float], distance: float) -> DeadLoad:
    """Return what each newton of a force at the tip adds to a dead load.

    Parameters
    ----------
    direction : sequence of float
        Unit vector ``(x, z)``, or ``(x, y, z)`` with y of 0, in the joint frame.
    distance : float
        Where the force acts along the unit's axis, in m from the centre of the ball.

    Raises
    ------
    LoadError
        If the direction is no unit vector in the plane of bending, or the distance no number.
    """
    is_spatial = hasattr(direction, '__len__') and len(direction) == 3
    parts = ('x', 'y', 'z') if is_spatial else ('x', 'z')
    x, *between, z = _numbers('direction', direction, parts)
    length = math.hypot(x, *between, z)
    if length == 0.0:
        raise LoadError(
            f'direction is {direction!r}, which is of length zero: a unit vector is needed'
        )
    if any(abs(y) > IN_PLANE * length for y in between):
        raise LoadError(
            f'direction is {direction!r}, out of the plane of bending: y has to be 0, since the '
            'guides carry what acts across that plane'
        )
    if not abs(length - 1.0) <= UNIT_LENGTH:
        raise LoadError(
            f'direction is {direction!r}, of length {length:.6g}: a unit vector is needed, '
            f'such as ({x / length:.6g}, {z / length:.6g})'
        )
    (lever,) = _numbers('distance', (distance,), ('distance',))
    if not abs(lever) <= FARTHEST:
        raise LoadError(f'distance is {lever!r} m, allowed is up to {FARTHEST:g} m either way')
    x, z = x / length, z / length
    return DeadLoad(x, z, lever * x, lever * z)


def _numbers(name: str, values: object, parts: Sequence[str]) -> tuple[float, ...]:
    """Return finite floats.

    Raises
    ------
    LoadError
        If there are not as many as there are parts, or one is not a finite number.
    """
    shape = parts[0] if len(parts) == 1 else f'({", ".join(parts)})'
    try:
        given = tuple(values)  # type: ignore[arg-type, var-annotated]
    except TypeError:
        given = ()
    shown = given[0] if len(given) == len(parts) == 1 else values
    is_number = [isinstance(v, numbers.Real) and not isinstance(v, bool) for v in given]
    if len(given) != len(parts) or not all(is_number):
        raise LoadError(f'{name} is {shown!r}, but {shape} in numbers is needed')
    for value in given:
        if not abs(value) <= MAX_FORCE:
            raise LoadError(f'{name} is {shown!r}, allowed is up to {MAX_FORCE:g} either way')
    return tuple(float(value) for value in given)


UPRIGHT = Load()
"""An upright base, and nothing at the tip: the paper's"""


def tension_excess(
    design: JointDesign, load: Load, size: float, tension_l: float, tension_s: float
) -> float:
    """T_l + T_s − |P| in N, without loss of digits where the tensions hardly exceed the load.

    Parameters
    ----------
    size : float
        |P| in N.
    """
    excess = tension_l + tension_s - size
    if excess > 0.01 * size:
        return excess
    exact = Fraction(size)
    if load == UPRIGHT:  # |P| = m g, a product that has been rounded
        exact = Fraction(design.mass) * Fraction(design.gravity)
    return float(Fraction(tension_l) + Fraction(tension_s) - exact)
