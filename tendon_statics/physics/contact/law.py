"""What a contact law has to say, and what every law is written in.

A contact law gives the capacity K of a joint: friction can hold the unit while |M| ≤ K, with the
moment M of all else about the centre of the ball. K is in proportion to the forces and to the
radius r of the ball, so a law is written for the shares

    κ = K / (r T),   w = |P| / T,   n = N / T,   f = |M| / (r T),

with T = T_l + T_s and the dead load P. The direction of P is the tilt ψ of the unit's axis from
it, positive towards the side to which the unit would slip: P presses the unit on the ball with
P_a = |P| cos ψ and drives it to that side with P_t = |P| sin ψ. So no law knows of sides: slipping
to the other one is the mirror image, and `slip` makes it.

Every method takes floats, or NumPy arrays of one shape, through the same formula.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Any, NamedTuple

LEAST = 5e-324
"""Added to a root that may be zero, so that what is divided by it is infinite: no other number
changes by it"""


def square_root(value: Any) -> Any:
    """√ of a float or an array, the same to the last bit, which may decide a regime."""
    return math.sqrt(value) if isinstance(value, float) else value**0.5


class LoadShare(NamedTuple):
    """The size of the dead load beside the cable tensions; floats or arrays."""

    share: Any
    """w = |P| / T"""
    excess: Any
    """1 − w, without loss of digits"""
    product: Any
    """1 − w², likewise"""


class CapacitySlopes(NamedTuple):
    """κ and its derivatives by the size of the load and by its direction."""

    capacity: Any
    by_share: Any
    """∂κ/∂w"""
    by_tilt: Any
    """∂κ/∂ψ; the unit's bend angle turns ψ one to one"""


class NormalSlopes(NamedTuple):
    """n and its derivatives."""

    normal: Any
    by_share: Any
    """∂n/∂w"""
    by_tilt: Any
    """∂n/∂ψ"""
    by_moment: Any
    """∂n/∂f"""


class ContactShares(NamedTuple):
    """Forces on the unit in shares of T, along its axis and across it, to the side of slip."""

    normal: Any
    """n"""
    pressure: tuple[Any, Any]
    """Resultant of the contact pressure"""
    friction: tuple[Any, Any]
    """Resultant of the friction"""
    balanced: tuple[Any, Any]
    """What Eqs. (1) and (2) have in place of the pressure"""
    consistent: Any
    """Whether the forces are those that Eqs. (1) and (2) ask for"""


class Bounds(NamedTuple):
    """A closed interval as its centre and half its width, so that products need no cases."""

    centre: Any
    radius: Any

    def times(self, other: Bounds) -> Bounds:
        """Bounds of the product of two quantities."""
        return Bounds(
            self.centre * other.centre,
            abs(self.centre) * other.radius + self.radius * (abs(other.centre) + other.radius),
        )

    @classmethod
    def between(cls, low: Any, high: Any) -> Bounds:
        """Bounds of a quantity that goes from one value to another and not beyond."""
        return cls(0.5 * (low + high), 0.5 * abs(high - low))


class Turn(NamedTuple):
    """Angles within a half-width h of a middle, h at most π/2."""

    mean: Any
    """(1 + cos h) / 2"""
    spread: Any
    """(1 − cos h) / 2"""
    sine: Any
    """sin h"""
    half_width: Any
    """h in rad"""

    @classmethod
    def by(cls, half_width: float) -> Turn:
        """All angles within a half-width in rad."""
        cosine = math.cos(half_width)
        return cls(0.5 * (1.0 + cosine), 0.5 * (1.0 - cosine), math.sin(half_width), half_width)

    def bounds(self, value: Any, slope: Any) -> Bounds:
        """Bounds of A cos + B sin, from its value and slope in the middle."""
        return Bounds(self.mean * value, self.spread * abs(value) + self.sine * abs(slope))


class ContactLaw(ABC):
    """A contact law of one design.

    Parameters
    ----------
    friction_coefficient : float
        μ
    start_angle, end_angle : float
        θ1 and θ2 in rad: the contact zone, from the unit's axis.

    Raises
    ------
    ValueError
        If the law is not made for such a zone; the text is for the user.
    """

    def __init__(self, friction_coefficient: float, start_angle: float, end_angle: float) -> None:
        self.friction = friction_coefficient
        self.start_angle = start_angle
        self.end_angle = end_angle

    fits: str
    """The construction that the law is for, in a few words"""

    carries_more_than_cables: bool = True
    """Whether a dead load beyond the cable tensions, |P| ≥ T, can be carried while it presses"""

    @abstractmethod
    def capacity(self, load: LoadShare, cosine: Any, sine: Any) -> Any:
        """κ for a unit about to slip, from cos ψ and sin ψ."""

    @abstractmethod
    def slopes(self, load: LoadShare, cosine: Any, sine: Any) -> CapacitySlopes:
        """κ and its derivatives."""

    @abstractmethod
    def slope_bounds(self, load: LoadShare, cosine: Any, sine: Any, turn: Turn) -> Bounds:
        """Bounds of ∂κ/∂ψ over all ψ that lie within a turn of the one given."""

    @abstractmethod
    def normal_slopes(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> NormalSlopes:
        """N and its derivatives, while friction takes up the moment f."""

    @abstractmethod
    def contact(self, load: LoadShare, cosine: Any, sine: Any, moment: Any) -> ContactShares:
        """Forces on the unit while friction takes up f, which is κ for a unit about to slip."""

    @abstractmethod
    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        """T in N at which a unit about to slip has the contact force N.

        Parameters
        ----------
        axial, ahead, normal : float
            P_a, P_t and N in N.
        """

    def contact_area(self, ball_radius: float, contact_width: float) -> float:
        """N / p in m², with the mean pressure p on the contact zone.

        The paper's: C w with the length C = 2 r sin η of the zone's arc, η = (θ2 − θ1) / 2.
        """
        half_span = 0.5 * (self.end_angle - self.start_angle)
        return 2.0 * ball_radius * math.sin(half_span) * contact_width
