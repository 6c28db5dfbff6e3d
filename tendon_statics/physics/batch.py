"""Many pairs of cable tensions at once, as NumPy arrays."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .contact import ContactForces, ForceRemainder
from .design import JointDesign
from .equilibrium import Regime
from .errors import TensionError
from .sensitivity import TensionGradient
from .solver import solve

REGIME_CODES = {regime: code for code, regime in enumerate(Regime)}
"""Regime → its number in `EquilibriumBatch.regime`"""

INVALID = -1
"""The number in `EquilibriumBatch.regime` of a pair for which `solve` raises"""

_NAMES = np.array([*(regime.value for regime in Regime), 'invalid'])


class EquilibriumBatch(NamedTuple):
    """The answers of `solve_batch`: the fields of `Equilibrium` as arrays of one shape.

    What the model does not determine is NaN, or False for the two that are true or false.
    """

    design: JointDesign
    regime: NDArray[np.int8]
    """Numbers by `REGIME_CODES`; `INVALID` for a pair for which `solve` raises"""
    tension_l: NDArray[np.float64]
    tension_s: NDArray[np.float64]
    root_count: NDArray[np.uint8]
    iterations: NDArray[np.uint8]
    bend_angle: NDArray[np.float64]
    pressure: NDArray[np.float64]
    normal_force: NDArray[np.float64]
    stable: NDArray[np.bool_]
    residual: NDArray[np.float64]
    forces: ContactForces
    force_remainder: ForceRemainder
    branch_consistent: NDArray[np.bool_]
    bend_angle_gradient: TensionGradient
    pressure_gradient: TensionGradient

    @property
    def regime_names(self) -> NDArray[np.str_]:
        """The regimes as text: the values of `Regime`, or ``invalid``."""
        return _NAMES[self.regime]


def solve_batch(
    design: JointDesign, tension_l: ArrayLike, tension_s: ArrayLike
) -> EquilibriumBatch:
    """Solve for many pairs of tensions; one answer of `solve` for each.

    Parameters
    ----------
    tension_l, tension_s : array_like
        Cable tensions T_l and T_s in N, of shapes that broadcast.
    """
    left, right = np.broadcast_arrays(
        np.asarray(tension_l, dtype=np.float64), np.asarray(tension_s, dtype=np.float64)
    )
    rows: list[tuple[Any, ...]] = []
    for pair in zip(left.flat, right.flat, strict=True):
        try:
            answer = solve(design, *pair)
        except TensionError:
            rows.append(
                (INVALID, 0, 0, *(math.nan,) * 3, False, *(math.nan,) * 7, False, *(math.nan,) * 4)
            )
            continue
        rows.append(
            (
                REGIME_CODES[answer.regime],
                answer.root_count,
                answer.iterations,
                answer.bend_angle,
                answer.pressure,
                answer.normal_force,
                bool(answer.stable),
                answer.residual,
                *(answer.forces or (math.nan,) * 4),
                *(answer.force_remainder or (math.nan,) * 2),
                bool(answer.branch_consistent),
                *(answer.bend_angle_gradient or (math.nan,) * 2),
                *(answer.pressure_gradient or (math.nan,) * 2),
            )
        )
    table = np.array(rows, dtype=np.float64).reshape(-1, 19).T.reshape(19, *left.shape)
    return EquilibriumBatch(
        design,
        table[0].astype(np.int8),
        left,
        right,
        table[1].astype(np.uint8),
        table[2].astype(np.uint8),
        table[3],
        table[4],
        table[5],
        table[6].astype(bool),
        table[7],
        ContactForces(*table[8:12]),
        ForceRemainder(*table[12:14]),
        table[14].astype(bool),
        TensionGradient(*table[15:17]),
        TensionGradient(*table[17:19]),
    )
