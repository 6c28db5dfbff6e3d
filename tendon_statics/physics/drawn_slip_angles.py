"""The distribution of the slip angle by draws, where it has no closed form."""

from __future__ import annotations

import math

from .design import JointDesign
from .design_uncertainty import DesignUncertainty
from .errors import TensionError
from .load import Load
from .regime import Regime
from .solver import solve
from .tensions import Tensions

DRAWS = 1597
"""Pairs that are solved where there is no closed form; one of Fibonacci's numbers, for which the
lattice of two variables is the most even"""

DRAWS_OF_DESIGNS = 6765
"""Those with a design each, whose parameters are so many variables more"""


class DrawnSlipAngles:
    """Answers for draws of tensions and design, solved one by one or as a batch."""

    def __init__(
        self,
        design: JointDesign,
        tensions: Tensions,
        load: Load,
        tension_stddev: float,
        uncertainty: DesignUncertainty | None,
    ) -> None:
        import numpy as np  # Here, for who stays in closed form should not wait for it.

        from .batch import INVALID, REGIME_CODES, solve_batch
        from .draws import draw_designs, even_normals

        if uncertainty is None:
            normals = even_normals(DRAWS, 2)
        else:
            normals = even_normals(DRAWS_OF_DESIGNS, 2 + len(uncertainty.parameters))
        pairs = np.array(tensions)[:, None] + tension_stddev * normals[:2]
        # A tension below zero is one of a slack cable.
        pairs = np.maximum(pairs, 0.0)
        if uncertainty is not None:
            designs = draw_designs(design, uncertainty, normals[2:])
            # One by one: a batch is of one design.
            answers = [
                _answer(one, left, right, load)
                for one, (left, right) in zip(designs, pairs.T.tolist(), strict=True)
            ]
            regimes = np.array(
                [INVALID if regime is None else REGIME_CODES[regime] for regime, _ in answers]
            )
            angles = np.array([angle for _, angle in answers])
        else:
            batch = solve_batch(design, pairs[0], pairs[1], load)
            regimes, angles = batch.regime, batch.bend_angle
        self._side = -1.0 if tensions.tension_l > tensions.tension_s else 1.0
        self._regimes = regimes
        self._codes = REGIME_CODES
        at_root = regimes == REGIME_CODES[Regime.EQUILIBRIUM]
        self._angles: list[float] = sorted(angles[at_root].tolist())
        driven = regimes == REGIME_CODES[Regime.DRIVEN_TO_STOP]
        self._driven = {side: int(np.sum(driven & (side * angles > 0.0))) for side in (1.0, -1.0)}
        self._of_side = {
            1.0: int(np.sum(pairs[1] >= pairs[0])),
            -1.0: int(np.sum(pairs[1] < pairs[0])),
        }

    def probability(self, regime: Regime) -> float:
        """Return the probability of a regime."""
        return float((self._regimes == self._codes[regime]).mean())

    def cdf(self, angle: float) -> float:
        """Return the share of slip angles up to one in rad, on its side."""
        side = -1.0 if angle < 0.0 else 1.0
        count = sum(0.0 <= side * one <= side * angle for one in self._angles)
        return (self._driven[side] + count) / max(self._of_side[side], 1)

    def quantile(self, q: float) -> float | None:
        """Return the angle in rad at which `cdf` is q; None where that is in no equilibrium.

        On the side of the stronger cable.
        """
        ahead = [angle for angle in self._angles if self._side * angle >= 0.0]
        place = math.ceil(q * self._of_side[self._side] - self._driven[self._side])
        if not 0 < place <= len(ahead):
            return None
        return ahead[place - 1] if self._side > 0.0 else ahead[-place]

    def interval(self, level: float) -> tuple[float, float] | None:
        """Return the ends in rad between which roots lie with a probability; None without any."""
        if not self._angles:
            return None
        outside = int(0.5 * (1.0 - level) * len(self._angles))
        return self._angles[outside], self._angles[-1 - outside]


def _answer(
    design: JointDesign, tension_l: float, tension_s: float, load: Load
) -> tuple[Regime | None, float]:
    """Regime and bend angle in rad; None and NaN where there is none."""
    try:
        answer = solve(design, tension_l, tension_s, load)
    except TensionError:
        return None, math.nan
    return answer.regime, math.nan if answer.bend_angle is None else answer.bend_angle
