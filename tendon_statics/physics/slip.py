"""The slip function g(θ) = M − K: above 0 the unit slips, below friction holds it.

It is written for slipping towards cable s. Slipping towards cable l is the mirror image (cables
swapped, angle and what lies across the axis negated), which is made here and nowhere else: angles
are counted *ahead*, positive to the side of slip.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from .contact.law import ContactLaw, LoadShare, State
from .contact.numbers import FLOATS, Numbers, wave_bounds
from .design import JointDesign
from .load import DeadLoad, Load
from .moment import Moment
from .roots import Bracket, brackets

NEGLIGIBLE_LOAD = 1e-9
"""Share of the tensions below which what turns with the unit moves g too little to determine an
angle"""


ROUNDING = 1e-12
"""Excess of a margin over 1 that may be rounding"""

Probe = tuple[Any, ...]
"""What the search for roots takes from one angle, as a plain tuple, since a search makes eight:
θ ahead, g and ∂g/∂θ in units of r T, cos θ, sin θ, M / (r T), the wave in ∂M/∂θ and minus its
slope, and the state of the contact law. `Slip.point` gives them names"""


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
    by_tilt: Any
    """Its derivative by ψ, so by θ"""
    by_share: Any
    """Its derivative by |P| / T"""
    state: State
    """Of the contact law"""

    @property
    def excess(self) -> Any:
        """The slip function g."""
        return self.moment - self.capacity


class LoadedJoint(NamedTuple):
    """One joint under a dead load, before the cables pull; what a slip function takes from it."""

    law: ContactLaw
    size: Any
    """|P| in N"""
    tilt: tuple[Any, Any]
    """cos ψ and sin ψ at zero bend"""
    lever: float
    """(r + δ) / r"""
    moment_x: Any
    """Q_x / r in N"""
    moment_z: Any
    """Q_z / r in N"""
    stiffness: float
    """k / r in N"""
    turning: Any
    """Size in N of all that turns with the unit"""

    @classmethod
    def of(cls, design: JointDesign, dead: DeadLoad) -> LoadedJoint:
        """Return a joint under a dead load of floats, or of arrays."""
        radius, friction = design.ball_radius, design.friction_coefficient
        size = dead.size
        nothing = size == 0.0  # has no direction; along the axis is as good as any
        moment_x, moment_z = dead.moment_x / radius, dead.moment_z / radius
        stiffness = design.stiffness / radius
        return cls(
            design.law,
            size,
            ((nothing - dead.force_z) / (size + nothing), dead.force_x / (size + nothing)),
            design.relative_lever,
            moment_x,
            moment_z,
            stiffness,
            (abs(moment_x) + abs(moment_z) + stiffness) / friction + friction * size,
        )


def loaded_joint(design: JointDesign, load: Load) -> LoadedJoint:
    """Return a joint under a load; the last of a design is kept, since loads seldom change.

    That saves a twelfth of `solve`.
    """
    kept: tuple[Load, LoadedJoint] | None = design.__dict__.get('_loaded')
    if kept is not None and kept[0] is load:
        return kept[1]
    joint = LoadedJoint.of(design, load.on(design))
    design.__dict__['_loaded'] = load, joint
    return joint


class Slip:
    """The slip function of one unit and one pair of tensions, for slipping to one side.

    Floats, or arrays of one shape for many pairs.

    Parameters
    ----------
    joint : LoadedJoint
    load : LoadShare
        Size of the dead load as a share of T.
    tilt : tuple of float
        cos ψ and sin ψ at zero bend, ahead.
    moment : Moment
        M / (r T), ahead.
    total : float
        T in N.
    side : float
        1 for slipping towards cable s, −1 for cable l.
    numbers : Numbers
        Of floats, or of arrays.

    Attributes
    ----------
    law : LoadedLaw
        The contact law under this load.
    """

    __slots__ = ('joint', 'law', 'load', 'moment', 'numbers', 'side', 'tilt', 'total')

    def __init__(
        self,
        joint: LoadedJoint,
        load: LoadShare,
        tilt: tuple[Any, Any],
        moment: Moment,
        total: Any,
        side: Any = 1.0,
        numbers: Numbers = FLOATS,
    ) -> None:
        self.joint = joint
        self.load = load
        self.tilt = tilt
        self.moment = moment
        self.total = total
        self.side = side
        self.numbers = numbers
        self.law = joint.law.under(load, tilt, numbers)

    @classmethod
    def of(
        cls,
        joint: LoadedJoint,
        excess: Any,
        tension_l: Any,
        tension_s: Any,
        side: Any = 1.0,
        numbers: Numbers = FLOATS,
    ) -> Slip:
        """Return the slip function towards a side.

        Parameters
        ----------
        excess : float
            T − |P| in N, above 0.
        tension_l, tension_s : float
            In N.
        side : float
            1 for slipping towards cable s, −1 for cable l.
        """
        total = tension_l + tension_s
        share, spare = joint.size / total, excess / total
        cosine, sine = joint.tilt
        return cls(
            joint,
            LoadShare(share, spare, spare * (1.0 + share)),
            (cosine, side * sine),
            Moment(
                side * (tension_s - tension_l) / total * joint.lever,
                side * joint.moment_x / total,
                -joint.moment_z / total,
                joint.stiffness / total,
            ),
            total,
            side,
            numbers,
        )

    def mirrored(self) -> Slip:
        """Return the slip function towards the other side."""
        return self.facing(-1.0)

    def facing(self, sign: Any) -> Slip:
        """Return the slip function towards the other side where `sign` is −1, the same for 1."""
        cosine, sine = self.tilt
        offset, of_cosine, of_sine, stiffness = self.moment
        return Slip(
            self.joint,
            self.load,
            (cosine, sign * sine),
            Moment(sign * offset, sign * of_cosine, of_sine, stiffness),
            self.total,
            sign * self.side,
            self.numbers,
        )

    def probe(self, angle: Any) -> Probe:
        """Look at an angle ahead in rad."""
        numbers = self.numbers
        cosine, sine = numbers.cosine(angle), numbers.sine(angle)
        state = self.law.at(cosine, sine)
        offset, of_cosine, of_sine, stiffness = self.moment
        wave, wave_slope = of_sine * cosine - of_cosine * sine, of_cosine * cosine + of_sine * sine
        moment = offset + wave_slope - stiffness * angle
        excess, slope = moment - state[0], wave - stiffness - state[1]
        return angle, excess, slope, cosine, sine, moment, wave, wave_slope, state

    def slope_bounds(self, one: Probe, other: Probe) -> tuple[Any, Any]:
        """Return bounds of ∂g/∂θ in units of r T between two angles, at most half a turn apart."""
        angle, _, _, _, _, _, wave, wave_slope, state = one
        other_angle, _, _, _, _, _, other_wave, other_wave_slope, other_state = other
        moment, numbers = self.moment, self.numbers
        low, high = wave_bounds(
            numbers,
            *(wave, -wave_slope),
            *(other_wave, -other_wave_slope),
            abs(moment.cosine) + abs(moment.sine),
        )
        least, greatest = self.law.slope_bounds(state, other_state, other_angle - angle)
        return low - moment.stiffness - greatest, high - moment.stiffness - least

    def brackets(self, one: Probe, other: Probe) -> list[Bracket]:
        """Bracket all roots of g between two angles ahead; see `roots.brackets`.

        There are none where nothing that turns with the unit counts beside the tensions: the
        angle is then not determined by them.
        """
        found = brackets(self, one, other)
        return found if found and self.is_determined else []

    @property
    def is_determined(self) -> Any:
        """Whether anything that turns with the unit counts beside the tensions."""
        return self.joint.turning >= NEGLIGIBLE_LOAD * self.total

    def point(self, probe: Probe) -> SlipPoint:
        """Return all that is known where it was probed."""
        _, _, slope, cosine, sine, moment, _, _, state = probe
        of_cosine, of_sine = self.tilt
        return SlipPoint(
            (cosine, sine),
            of_cosine * cosine - of_sine * sine,
            of_sine * cosine + of_cosine * sine,
            moment,
            slope,
            state[0],
            state[1],
            self.law.by_share(state),
            state,
        )

    def at(self, angle: Any) -> SlipPoint:
        """Return all that is known at an angle ahead in rad."""
        return self.point(self.probe(angle))

    def value(self, angle: Any) -> Any:
        """Return g in units of r T at an angle ahead in rad."""
        return self.probe(angle)[1]

    def margin(self, angle: float) -> float:
        """M / K at an angle ahead in rad, with the capacity on the side of M.

        Above 1 the unit slips ahead, below −1 it slips back. A root is exact to the rounding of
        the margin, so what exceeds 1 by that alone is taken for 1.
        """
        slip, probe = self.driving(angle)
        margin = slip.share_of_limit(probe)
        return margin if slip is self else -margin

    def driving(self, angle: float) -> tuple[Slip, Probe]:
        """Return the slip function towards the side to which M drives at an angle ahead in rad.

        And its probe there.
        """
        probe = self.probe(angle)
        if not probe[5] < 0.0:
            return self, probe
        mirrored = self.mirrored()
        return mirrored, mirrored.probe(-angle)

    @staticmethod
    def share_of_limit(probe: Probe) -> float:
        """`margin` where it was probed, for M towards the side of slip."""
        margin: float = probe[5] / probe[8][0]
        return 1.0 if 1.0 < margin <= 1.0 + ROUNDING else margin
