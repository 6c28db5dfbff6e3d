"""The slip function g(θ) = M − K: above 0 the unit slips, below friction holds it.

It is written for slipping towards cable s. Slipping towards cable l is the mirror image (cables
swapped, angle and what lies across the axis negated), which is made here and nowhere else: angles
are counted *ahead*, positive to the side of slip.

The moment M of all but friction about the centre of the ball is Eq. (3),

    M(θ) = ΔT (r + δ) + Q_x cos θ − Q_z sin θ − k θ,

with ΔT = T_s − T_l, the moment Q of the dead load (see `load`) and the stiffness k of a backbone.
For an upright unit with nothing at its tip the middle is W l sin θ, the paper's. K is the contact
law's.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from .contact.law import State, map_arrays
from .contact.numbers import FLOATS, Numbers, wave_bounds
from .loaded_joint import LoadedJoint
from .named import named
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


class Slip:
    """The slip function of one unit and one pair of tensions, for slipping to one side.

    Floats, or for many pairs arrays; those of a joint broadcast to the shape of the pairs.

    Parameters
    ----------
    joint : LoadedJoint
    excess : float
        T − |P| in N, above 0 as a rule.
    tension_l, tension_s : float
        In N.
    side : float
        1 for slipping towards cable s, −1 for cable l.
    numbers : Numbers
        Of floats, or of arrays.

    Attributes
    ----------
    excess : float
        T − |P| in N, as given.
    total : float
        T in N.
    share : float
        w = |P| / T.
    law : LoadedLaw
        The contact law under this load.
    """

    __slots__ = (
        *('_cosine', '_ends', '_of_angle', '_of_cosine', '_of_sine', '_offset', '_sine'),
        *('_tensions', 'excess', 'joint', 'law', 'numbers', 'share', 'side', 'tilt', 'total'),
    )

    def __init__(
        self,
        joint: LoadedJoint,
        excess: Any,
        tension_l: Any,
        tension_s: Any,
        side: Any = 1.0,
        numbers: Numbers = FLOATS,
    ) -> None:
        law, size, (cosine, sine), lever, moment_x, moment_z, stiffness, _ = joint
        total = tension_l + tension_s
        self.joint, self.side, self.numbers, self.total = joint, side, numbers, total
        self.excess, self._tensions = excess, (tension_l, tension_s)
        self._cosine, self._sine = numbers.cosine, numbers.sine
        self.share = share = size / total
        excess_share = excess / total
        self.tilt = tilt = cosine, side * sine
        self.law = law.under((share, excess_share, excess_share * (1.0 + share)), tilt, numbers)
        # M / (r T) by parts
        self._offset = side * (tension_s - tension_l) / total * lever
        self._of_cosine = side * moment_x / total
        self._of_sine = -moment_z / total
        self._of_angle = -stiffness / total
        self._ends: tuple[Probe, Probe] | None = None

    def part(self, rows: Any) -> Slip:
        """Return the slip functions of some of the pairs that there are in arrays."""
        total = self.total

        def taken(values: Any) -> Any:
            return (values if values.shape == total.shape else values + 0.0 * total)[rows]

        return self._each(taken, self.numbers)

    def one(self, index: int) -> Slip:
        """Return the slip function of one of the pairs that there are in arrays, of floats."""
        return self._each(lambda values: float(values[index]), FLOATS)

    def _each(self, change: Callable[[Any], Any], numbers: Numbers) -> Slip:
        """Return the same with a function applied to each array."""
        left, right = self._tensions
        return Slip(
            *(map_arrays(self.joint, change), change(self.excess), change(left), change(right)),
            map_arrays(self.side, change),
            numbers,
        )

    def facing(self, sign: Any) -> Slip:
        """Return the slip function towards the other side where `sign` is −1, the same for 1."""
        left, right = self._tensions
        return Slip(self.joint, self.excess, left, right, sign * self.side, self.numbers)

    def mirrored(self) -> Slip:
        """Return the slip function towards the other side."""
        return self.facing(-1.0)

    def probe(self, angle: Any) -> Probe:
        """Look at an angle ahead in rad."""
        cosine_of, sine_of = self._cosine, self._sine  # in this way a call takes less
        cosine, sine = cosine_of(angle), sine_of(angle)
        state = self.law.at(cosine, sine)
        of_cosine, of_sine, of_angle = self._of_cosine, self._of_sine, self._of_angle
        wave, wave_slope = of_sine * cosine - of_cosine * sine, of_cosine * cosine + of_sine * sine
        moment = self._offset + wave_slope + of_angle * angle
        slope = wave + of_angle - state[1]
        return angle, moment - state[0], slope, cosine, sine, moment, wave, wave_slope, state

    def ends(self, stop: Any) -> tuple[Probe, Probe]:
        """Look at 0 and at the stop ahead in rad, between which a unit may slip; once."""
        if self._ends is None or self._ends[1][0] is not stop:
            self._ends = self.probe(0.0), self.probe(stop)
        return self._ends

    def slope_bounds(self, one: Probe, other: Probe) -> tuple[Any, Any]:
        """Return bounds of ∂g/∂θ in units of r T between two angles ahead.

        They are ascending, and at most half a turn apart.
        """
        angle, _, _, _, _, _, wave, wave_slope, state = one
        other_angle, _, _, _, _, _, other_wave, other_wave_slope, other_state = other
        amplitude = abs(self._of_cosine) + abs(self._of_sine)
        low, high = wave_bounds(
            self.numbers, wave, -wave_slope, other_wave, -other_wave_slope, -amplitude, amplitude
        )
        least, greatest = self.law.slope_bounds(state, other_state, other_angle - angle)
        of_angle = self._of_angle
        return low + of_angle - greatest, high + of_angle - least

    def brackets(self, one: Probe, other: Probe) -> list[Bracket]:
        """Bracket all roots of g between two angles ahead; see `roots.brackets`.

        There are none where nothing that turns with the unit counts beside the tensions: the
        angle is then not determined by them.
        """
        # A flat function would be searched long and in vain.
        return brackets(self, one, other) if self.is_determined else []

    @property
    def is_determined(self) -> Any:
        """Whether anything that turns with the unit counts beside the tensions."""
        return self.joint.turning >= NEGLIGIBLE_LOAD * self.total

    def point(self, probe: Probe) -> SlipPoint:
        """Return all that is known where it was probed."""
        _, _, slope, cosine, sine, moment, _, _, state = probe
        of_cosine, of_sine = self.tilt
        return named(
            SlipPoint,
            (
                (cosine, sine),
                of_cosine * cosine - of_sine * sine,
                of_sine * cosine + of_cosine * sine,
                moment,
                slope,
                state[0],
                state[1],
                self.law.by_share(state),
                state,
            ),
        )

    def at(self, angle: Any) -> SlipPoint:
        """Return all that is known at an angle ahead in rad."""
        return self.point(self.probe(angle))

    def value(self, angle: Any) -> Any:
        """Return g in units of r T at an angle ahead in rad."""
        return self.probe(angle)[1]

    def moment_at(self, angle: Any) -> Any:
        """Return M in units of r T, ahead, at an angle ahead in rad, seated or not."""
        turning = self._of_cosine * self._cosine(angle) + self._of_sine * self._sine(angle)
        return self._offset + turning + self._of_angle * angle

    def moment_side(self, stop: float) -> float:
        """1 where M is ahead at all angles within ±`stop` in rad, −1 where it is back at all.

        Elsewhere 0, and also where that would take a closer look.
        """
        turning = abs(self._of_cosine) + abs(self._of_sine) + abs(self._of_angle) * stop
        return 1.0 if self._offset > turning else -1.0 if -self._offset > turning else 0.0

    def margin(self, angle: float) -> float:
        """M / K at an angle ahead in rad, with the capacity on the side of M.

        Above 1 the unit slips ahead, below −1 it slips back. A root is exact to the rounding of
        the margin, so what exceeds 1 by that alone is taken for 1.
        """
        slip, probe = self.driving(angle)
        margin: float = self.side * slip.margin_at(probe)
        return margin

    def driving(self, angle: float) -> tuple[Slip, Probe]:
        """Return the slip function towards the side to which M drives at an angle ahead in rad.

        And its probe there.
        """
        probe = self.probe(angle)
        if not probe[5] < 0.0:
            return self, probe
        mirrored = self.mirrored()
        return mirrored, mirrored.probe(-angle)

    def margin_at(self, probe: Probe) -> float:
        """M / K where it was probed, for M towards the side of slip; positive towards cable s."""
        margin: float = self.side * self._used(probe)
        return margin

    def is_at_limit(self, probe: Probe) -> bool:
        """Whether M is K, but for rounding, where it was probed."""
        return self._used(probe) == 1.0

    @staticmethod
    def _used(probe: Probe) -> float:
        """Return the share of K that M takes up ahead, negative where M is."""
        share: float = probe[5] / probe[8][0]
        return 1.0 if 1.0 < share <= 1.0 + ROUNDING else share

    def residual_at(self, probe: Probe) -> float:
        """(M − K) / (μ r) in N where it was probed; with the paper's law N_m − N_f, Eq. (4)."""
        residual: float = probe[1] * self.total / self.joint.law.friction
        return residual
