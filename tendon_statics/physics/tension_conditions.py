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


class TensionConditions:
    """The conditions that noise may end for a pair of taut cables.

    Parameters
    ----------
    slip : Slip
        Towards the stronger cable.
    stddev : float
        Standard deviation of each tension in N.

    Attributes
    ----------
    near : list of Condition
        Those that it may end.
    stronger, taut : Condition or None
        Of these, that the stronger cable is, and that the weaker one is.
    is_bent : bool
        Whether K may be far from linear in the tensions.
    """

    def __init__(
        self, design: JointDesign, load: Load, slip: Slip, tensions: Tensions, stddev: float
    ) -> None:
        left, right = tensions
        lead, weak = abs(right - left), min(left, right)
        far_apart = FAR * stddev / SQRT_HALF
        self.stronger: Condition | None = None
        self.taut: Condition | None = None
        self.near: list[Condition] = []
        if lead <= far_apart:
            self.stronger = Condition(-SQRT_HALF, SQRT_HALF, SQRT_HALF * lead / stddev)
            self.near.append(self.stronger)
        if weak <= FAR * stddev:
            self.taut = Condition(1.0, 0.0, weak / stddev)
            self.near.append(self.taut)
        is_close = slip.excess * SQRT_HALF <= BENT * stddev
        self.is_bent = is_close and not design.law.carries_more_than_cables
        if is_close and not self.is_bent:
            spare = left + right - load.on(design).largest_pull(design.max_bend_angle)
            if spare <= far_apart:
                score = SQRT_HALF * spare / stddev
                self.near.append(Condition(SQRT_HALF, SQRT_HALF, score))
