"""What a contact law has to say, and what every law is written in.

A contact law gives the capacity K of a joint: friction can hold the unit while |M| ≤ K, with the
moment M of all else about the centre of the ball. K is in proportion to the forces and to the
radius r of the ball, so a law is written for the shares

    κ = K / (r T),   w = |P| / T,   n = N / T,   f = |M| / (r T),

with T = T_l + T_s and the dead load P. The direction of P is the tilt ψ of the unit's axis from
it, positive towards the side to which the unit would slip: P presses the unit on the ball with
P_a = |P| cos ψ and drives it to that side with P_t = |P| sin ψ. So no law knows of sides: slipping
to the other one is the mirror image, and `slip` makes it.

A `ContactLaw` belongs to a design. `ContactLaw.under` binds it to the dead load of one pair of
tensions, or of many in arrays of one shape: a `LoadedLaw`, whose formulas serve both.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any

from .numbers import Numbers
from .quadratic import Line, real_roots

State = tuple[Any, ...]
"""A law at one angle: κ, ∂κ/∂ψ, and what else the law wants to know of it again"""


LoadShare = tuple[Any, Any, Any]
"""The dead load beside the cable tensions: w, and 1 − w and 1 − w² without loss of digits"""


NormalSlopes = tuple[Any, Any, Any, Any]
"""n, ∂n/∂w, ∂n/∂ψ and ∂n/∂f"""

Pair = tuple[Any, Any]
"""A force along the unit's axis and across it, to the side of slip, in shares of T"""

ContactShares = tuple[Pair, Pair, Pair]
"""Resultants of pressure and friction on the unit, and what Eqs. (1) and (2) have in place of the
pressure"""


class LoadedLaw(ABC):
    """A contact law under the dead load of one pair of tensions."""

    __slots__ = ()

    @abstractmethod
    def at(self, cosine: Any, sine: Any) -> State:
        """Return the law's state for a unit about to slip, from cos θ and sin θ."""

    @abstractmethod
    def slope_bounds(self, one: State, other: State, width: Any) -> tuple[Any, Any]:
        """Return bounds of ∂κ/∂ψ between two states; NaN or infinite where there are none.

        The other is `width` in rad ahead of the one, at most half a turn.
        """

    @abstractmethod
    def by_share(self, state: State) -> Any:
        """Return ∂κ/∂w."""

    @abstractmethod
    def normal(self, state: State, moment: Any) -> Any:
        """Return n while friction takes up the moment f, which is κ for a unit about to slip."""

    @abstractmethod
    def normal_slopes(self, state: State, moment: Any) -> NormalSlopes:
        """Return that and its derivatives."""

    @abstractmethod
    def contact(self, state: State, moment: Any, normal: Any) -> ContactShares:
        """Return the forces on the unit while friction takes up f, with n for it."""

    @abstractmethod
    def consistent(self, state: State, moment: Any) -> Any:
        """Return whether Eqs. (1) and (2) ask for these forces."""


class ContactLaw(ABC):
    """A contact law of one design.

    K never falls as the tension of either cable grows, which presses the joint.

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

    is_stacked = False
    """Whether its numbers are arrays, of many designs; see `stacked_design`"""

    carries_more_than_cables: bool = True
    """Whether a dead load beyond the cable tensions, |P| ≥ T, can be carried while it presses"""

    @abstractmethod
    def under(self, load: LoadShare, tilt: tuple[Any, Any], numbers: Numbers) -> LoadedLaw:
        """Return the law under a dead load.

        Parameters
        ----------
        tilt : tuple of float
            cos ψ and sin ψ at zero bend; ψ grows with the bend angle, one to one.
        numbers : Numbers
            Of floats or arrays, whichever the others are.
        """

    @abstractmethod
    def total_tension(self, axial: float, ahead: float, normal: float) -> float:
        """T in N at which a unit about to slip has the contact force N.

        Parameters
        ----------
        axial, ahead, normal : float
            P_a, P_t and N in N.
        """

    @abstractmethod
    def forces_at_slip(self, moment: Line, axial: Line, ahead: Line) -> list[float]:
        """Return all forces φ at which the unit is about to slip ahead, |M| = K.

        In closed form, since with φ along a known line M and the dead load are in proportion to
        it. There may be others among them, as of a quadratic of which one root alone counts.

        Parameters
        ----------
        moment, axial, ahead : Line
            M / (r T), P_a / T and P_t / T by φ, which is in shares of T.
        """

    def seating_tension(self, axial: float, ahead: float) -> float:  # noqa: ARG002
        """T that has to be exceeded for the joint to be seated under a dead load, in its unit.

        So much as keeps it from pulling the unit off the ball, unless a law says otherwise.

        Parameters
        ----------
        axial, ahead : float
            P_a and P_t.
        """
        return -axial

    def forces_at_lift(self, axial: Line, ahead: Line) -> list[float]:  # noqa: ARG002
        """Return all forces φ at which T is just `seating_tension`; see `forces_at_slip`."""
        return real_roots((1.0 + axial[0], axial[1], 0.0))

    def contact_area(self, ball_radius: float, contact_width: float) -> float:
        """N / p in m², with the mean pressure p on the contact zone.

        The paper's: C w with the length C = 2 r sin η of the zone's arc, η = (θ2 − θ1) / 2.
        """
        half_span = 0.5 * (self.end_angle - self.start_angle)
        return 2.0 * ball_radius * math.sin(half_span) * contact_width


def map_arrays(value: Any, change: Callable[[Any], Any]) -> Any:
    """Return a value with a function applied to each array in it, within tuples and laws too."""
    if getattr(value, 'ndim', 0):
        return change(value)
    if isinstance(value, tuple):
        parts = [map_arrays(part, change) for part in value]
        return type(value)(*parts) if hasattr(value, '_fields') else tuple(parts)
    if isinstance(value, ContactLaw) and value.is_stacked:
        changed = object.__new__(type(value))
        changed.__dict__ = {
            name: map_arrays(part, change) for name, part in value.__dict__.items()
        }
        return changed
    return value
