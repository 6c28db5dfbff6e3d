"""What noise may change of a pair of tensions beside whether it has the unit slip.

Next to equal tensions it decides which cable is the stronger, next to a slack cable whether that
carries tension at all, and next to what seats the joint whether it is seated. Each is a condition,
that a sum or difference of the tensions is above 0, as it is with the probability Φ(t) of its own
score t. Its correlation ρ with the slip function follows from their gradients, and so does

    P(g > 0 and the condition) = Φ₂(s, t; ρ).

What counts then is the score given the condition, the s' of Φ(s') = Φ₂(s, t; ρ) / Φ(t).
"""

from __future__ import annotations

import math
from statistics import NormalDist
from typing import NamedTuple

from .design import JointDesign
from .load import Load
from .normal_pair import both_below
from .slip import Slip
from .tensions import Tensions

FAR = 4.0
"""Standard deviations that count as never: once in 30,000 times"""

BENT = 6.0
"""Those from its seat up to which K of the paper's law is far from linear in the tensions"""

SURE = 8.3
"""Those of which a normal number is never, but for rounding"""

OUTER = 1e-4
"""Share of a condition's probability up to which `both_below` is not exact enough"""

NARROWEST = 1e-12
"""Least variance, in place of what rounding makes of none"""

SQRT_HALF = math.sqrt(0.5)

_NORMAL = NormalDist()

OUTER_SCORE = -_NORMAL.inv_cdf(OUTER)


class Condition:
    """That a sum or difference of the tensions is above 0.

    Parameters
    ----------
    behind, ahead : float
        Weights of the tension of the cable behind the unit and of that ahead of it, whose squares
        add up to 1.
    score : float
        Its value over its standard deviation.

    Attributes
    ----------
    chance : float
        Its probability.
    """

    def __init__(self, behind: float, ahead: float, score: float) -> None:
        self.behind, self.ahead, self.score = behind, ahead, score
        self.chance = _NORMAL.cdf(score)
        self._shift = _NORMAL.pdf(score) / self.chance

    def given(self, score: float, slope: float, correlation: float) -> tuple[float, float]:
        """Return a score given that the condition holds, and its slope, from those without it."""
        # By mean and deviation of the noise that is left, which is right far out and where
        # rounding leaves no probability to tell from.
        shift = self._shift
        narrowed = 1.0 - correlation * correlation * shift * (shift + self.score)
        narrowed = 1.0 / math.sqrt(max(narrowed, NARROWEST))
        about = (score + correlation * shift) * narrowed
        if abs(about) > SURE:
            return about, slope * narrowed
        share = both_below(score, self.score, correlation) / self.chance
        if share < OUTER:
            return min(about, -OUTER_SCORE), slope * narrowed
        if share > 1.0 - OUTER:
            return max(about, OUTER_SCORE), slope * narrowed
        given = _NORMAL.inv_cdf(share)
        rest = math.sqrt(max(1.0 - correlation * correlation, NARROWEST))
        density = _NORMAL.pdf(score) * _NORMAL.cdf((self.score - correlation * score) / rest)
        return given, slope * density / (self.chance * _NORMAL.pdf(given))

    def opposite(self) -> Condition:
        """Return that of the other cable being the stronger, for this one being it."""
        return Condition(self.behind, self.ahead, -self.score)


class TensionConditions(NamedTuple):
    """The conditions that noise may end; None where it never does."""

    stronger: Condition | None
    """That the stronger cable is"""
    taut: Condition | None
    """That the weaker cable is"""
    seated: Condition | None
    """That the joint is"""
    is_bent: bool
    """Whether K may be far from linear in the tensions"""

    @classmethod
    def of(
        cls, design: JointDesign, load: Load, slip: Slip, tensions: Tensions, stddev: float
    ) -> TensionConditions:
        """Return those of a pair of taut cables.

        Parameters
        ----------
        slip : Slip
            Towards the stronger cable.
        stddev : float
            Standard deviation of each tension in N.
        """
        weak, strong = sorted(tensions)
        lead, tautness = SQRT_HALF * (strong - weak) / stddev, weak / stddev
        seating, seated, is_bent = SQRT_HALF * slip.excess / stddev, None, False
        if seating <= BENT:
            if not design.law.carries_more_than_cables:
                is_bent = True
            else:
                pull = load.on(design).largest_pull(design.max_bend_angle)
                seating = SQRT_HALF * (sum(tensions) - pull) / stddev
                if seating <= FAR:
                    seated = Condition(SQRT_HALF, SQRT_HALF, seating)
        return cls(
            Condition(-SQRT_HALF, SQRT_HALF, lead) if lead <= FAR else None,
            Condition(1.0, 0.0, tautness) if tautness <= FAR else None,
            seated,
            is_bent,
        )

    @property
    def all(self) -> list[Condition]:
        """Those that noise may end."""
        return [one for one in (self.stronger, self.taut, self.seated) if one is not None]
