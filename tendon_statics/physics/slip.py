"""The slip function g(θ) = M − K: above 0 the unit slips, below friction holds it.

It is written for slipping towards cable s. Slipping towards cable l is the mirror image (cables
swapped, angle and what lies across the axis negated), which is made here and nowhere else: angles
are counted *ahead*, positive to the side of slip.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from .contact.law import ContactLaw, LoadShare, Turn
from .design import JointDesign
from .load import DeadLoad
from .moment import Moment
from .roots import Bracket, brackets

NEGLIGIBLE_LOAD = 1e-9
"""Share of the tensions below which what turns with the unit moves g too little to determine an
angle"""


ROUNDING = 1e-12
"""Excess of a margin over 1 that may be rounding"""


class SlipPoint(NamedTuple):
    """The slip function at one angle, in units of r T; floats, or arrays of one shape."""

    turn: tuple[Any, Any]
    """cos θ and sin θ of the angle ahead"""
    cosine: Any
    """cos ψ, with the tilt ψ of the unit's axis from the dead load"""
    sine: Any
    """sin ψ"""
    moment: Any
    """M / (r T)"""
    slope: Any
    """∂g/∂θ"""
    capacity: Any
    """K / (r T)"""
    by_share: Any
    """Its derivative by |P| / T"""
    by_tilt: Any
    """Its derivative by ψ, so by θ"""

    @property
    def excess(self) -> Any:
        """The slip function g."""
        return self.moment - self.capacity


class Slip:
    """The slip function of one unit and one pair of tensions, for slipping to one side.

    Attributes
    ----------
    side : float
        1 for slipping towards cable s, −1 for cable l.
    total : float
        T in N.
    law : ContactLaw
    load : LoadShare
        Size of the dead load as a share of T.
    tilt : tuple of float
        cos ψ and sin ψ at zero bend.
    moment : Moment
        M / (r T).
    """

    __slots__ = ('law', 'load', 'moment', 'side', 'tilt', 'total')

    def __init__(
        self,
        law: ContactLaw,
        load: LoadShare,
        tilt: tuple[Any, Any],
        moment: Moment,
        total: Any,
        side: float = 1.0,
    ) -> None:
        self.law = law
        self.load = load
        self.tilt = tilt
        self.moment = moment
        self.total = total
        self.side = side

    @classmethod
    def towards_s(
        cls, design: JointDesign, dead: DeadLoad, excess: Any, tension_l: Any, tension_s: Any
    ) -> Slip:
        """Return the slip function towards cable s.

        Parameters
        ----------
        dead : DeadLoad
            Of floats, or of arrays.
        excess : float
            T − |P| in N, above 0.
        tension_l, tension_s : float
            In N.
        """
        total = tension_l + tension_s
        size = dead.size
        share, spare = size / total, excess / total
        nothing = size == 0.0  # has no direction; along the axis is as good as any
        tilt = (nothing - dead.force_z) / (size + nothing), dead.force_x / (size + nothing)
        return cls(
            design.law,
            LoadShare(share, spare, spare * (1.0 + share)),
            tilt,
            Moment.of(design, dead, tension_s - tension_l, total),
            total,
        )

    def facing(self, side: Any) -> Slip:
        """Return the slip function of the mirror image where `side` is −1, the same where it is 1.

        Parameters
        ----------
        side : float
            Or an array of them, beside tensions in arrays.
        """
        cosine, sine = self.tilt
        offset, of_cosine, of_sine, stiffness = self.moment
        return Slip(
            self.law,
            self.load,
            (cosine, side * sine),
            Moment(side * offset, side * of_cosine, of_sine, stiffness),
            self.total,
            side * self.side,
        )

    def mirrored(self) -> Slip:
        """Return the slip function towards the other side."""
        return self.facing(-1.0)

    def driving(self, bend_angle: float) -> Slip:
        """Return the slip function towards the side to which the moment drives at an angle.

        Parameters
        ----------
        bend_angle : float
            θ in rad; this has to be the slip function towards cable s.
        """
        moment = self.moment.at(bend_angle, math.cos(bend_angle), math.sin(bend_angle))
        return self.mirrored() if moment < 0.0 else self

    def tilted(self, cosine: Any, sine: Any) -> tuple[Any, Any]:
        """Cos ψ and sin ψ at the angle ahead that has this cosine and sine."""
        of_cosine, of_sine = self.tilt
        return of_cosine * cosine - of_sine * sine, of_sine * cosine + of_cosine * sine

    def value(self, angle: float) -> float:
        """Return g / (r T) at an angle ahead in rad."""
        value: float = self.value_turn(angle, math.cos(angle), math.sin(angle))
        return value

    def value_turn(self, angle: Any, cosine: Any, sine: Any) -> Any:
        """Return the same from the cosine and sine of the angle, which may be arrays."""
        moment = self.moment.at(angle, cosine, sine)
        return moment - self.law.capacity(self.load, *self.tilted(cosine, sine))

    def margin(self, angle: float) -> float:
        """M / K at an angle ahead in rad, with the capacity on the side of M.

        Above 1 the unit slips ahead, below −1 it slips back. A root is exact to the rounding of
        the margin, so what exceeds 1 by that alone is taken for 1.
        """
        cosine, sine = math.cos(angle), math.sin(angle)
        moment = self.moment.at(angle, cosine, sine)
        of_tilt, across = self.tilted(cosine, sine)
        across = -across if moment < 0.0 else across  # as the mirror image has it
        margin = moment / self.law.capacity(self.load, of_tilt, across)
        if 1.0 < abs(margin) <= 1.0 + ROUNDING:
            return math.copysign(1.0, margin)
        return margin  # type: ignore[no-any-return]

    def value_and_slope(self, angle: float) -> tuple[float, float]:
        """Return g and ∂g/∂θ in units of r T."""
        cosine, sine = math.cos(angle), math.sin(angle)
        capacity, _, by_tilt = self.law.slopes(self.load, *self.tilted(cosine, sine))
        return (
            self.moment.at(angle, cosine, sine) - capacity,
            self.moment.slope(cosine, sine) - by_tilt,
        )

    def slope_bounds(self, low: float, high: float) -> tuple[float, float]:
        """Return bounds of ∂g/∂θ in units of r T over an interval in rad."""
        middle, turn = 0.5 * (low + high), Turn.by(0.5 * (high - low))
        return self.slope_bounds_turn(math.cos(middle), math.sin(middle), turn)

    def slope_bounds_turn(self, cosine: Any, sine: Any, turn: Turn) -> tuple[Any, Any]:
        """Return the same for all angles within a turn of the one with this cosine and sine."""
        of_moment = turn.bounds(*self.moment.turn(cosine, sine))
        of_capacity = self.law.slope_bounds(self.load, *self.tilted(cosine, sine), turn)
        centre = of_moment.centre - self.moment.stiffness - of_capacity.centre
        radius = of_moment.radius + of_capacity.radius
        return centre - radius, centre + radius

    def at(self, angle: float) -> SlipPoint:
        """Return all that is known at an angle ahead in rad."""
        return self.at_turn(angle, math.cos(angle), math.sin(angle))

    def at_turn(self, angle: Any, cosine: Any, sine: Any) -> SlipPoint:
        """Return the same from the cosine and sine of the angle, which may be arrays."""
        tilted = self.tilted(cosine, sine)
        capacity, by_share, by_tilt = self.law.slopes(self.load, *tilted)
        return SlipPoint(
            (cosine, sine),
            *tilted,
            self.moment.at(angle, cosine, sine),
            self.moment.slope(cosine, sine) - by_tilt,
            capacity,
            by_share,
            by_tilt,
        )

    def brackets(self, low: float, high: float) -> list[Bracket]:
        """Bracket all roots of g between two angles ahead in rad; see `roots.brackets`.

        There are none where nothing that turns with the unit counts beside the tensions: the
        angle is then not determined by them.
        """
        return brackets(self, low, high) if self.is_determined else []

    @property
    def is_determined(self) -> Any:
        """Whether anything that turns with the unit counts beside the tensions."""
        moment, friction = self.moment, self.law.friction
        turning = abs(moment.cosine) + abs(moment.sine) + moment.stiffness
        return turning / friction + friction * self.load.share >= NEGLIGIBLE_LOAD
