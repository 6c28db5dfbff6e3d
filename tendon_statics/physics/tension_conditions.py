"""What noise may change of a pair of tensions beside whether it has the unit slip.

Next to equal tensions it decides which cable is the stronger, next to a slack cable whether that
carries tension at all, and next to what seats the joint whether it is seated. Each is a condition,
that a sum or difference of the tensions is above 0, as it is with the probability Φ(t) of its own
score t. Its correlation with the slip function follows from their gradients.
"""

from __future__ import annotations

import math

from .design import JointDesign
from .load import Load
from .normal_pair import below
from .slip import Slip
from .tensions import Tensions

FAR = 4.0
"""Standard deviations that count as never: once in 30,000 times"""

BENT = 6.0
"""Those from its seat up to which K of the paper's law is far from linear in the tensions"""

SQRT_HALF = math.sqrt(0.5)


class Condition:
    """That a sum or difference of the tensions is above 0.

    Parameters
    ----------
    of_sum, of_lead : float
        Its correlation with the sum of the tensions, and with the lead of the cable ahead of the
        unit over that behind it.
    score : float
        Its value over its standard deviation.

    Attributes
    ----------
    chance : float
        Its probability.
    """

    def __init__(self, of_sum: float, of_lead: float, score: float) -> None:
        self.of_sum, self.of_lead, self.score = of_sum, of_lead, score
        self.chance = below(score)

    def opposite(self) -> Condition:
        """Return that of the other cable being the stronger, for this one being it."""
        return Condition(self.of_sum, self.of_lead, -self.score)


ALWAYS = Condition(0.0, 0.0, math.inf)
"""That which noise cannot end"""


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
        far, far_apart = FAR * stddev, FAR * stddev / SQRT_HALF
        near: list[Condition] = []
        self.near, self.is_bent = near, False
        self.stronger: Condition | None = None
        self.taut: Condition | None = None
        if lead <= far_apart:
            self.stronger = Condition(0.0, 1.0, SQRT_HALF * lead / stddev)
            near.append(self.stronger)
        if weak <= far:
            self.taut = Condition(SQRT_HALF, -SQRT_HALF, weak / stddev)
            near.append(self.taut)
        if slip.excess * SQRT_HALF <= BENT * stddev:
            self.is_bent = not design.law.carries_more_than_cables
            pull = load.on(design).largest_pull(design.max_bend_angle)
            spare = left + right - pull
            if spare <= far_apart and not self.is_bent:
                near.append(Condition(1.0, 0.0, SQRT_HALF * spare / stddev))
