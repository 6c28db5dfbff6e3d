"""The answers for many pairs of tensions, and what follows from them, as arrays."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..array_roots import Floats
from ..design import JointDesign
from ..forces import ContactForces, ForceRemainder, contact_forces
from ..gradients import TensionGradient, angle_by_tensions, normal_by_tensions, of_sides
from ..load import Load
from ..regime import Regime
from ..slip import Slip, SlipPoint
from .pairs import chunks, dead_arrays, facing_slips

REGIME_CODES = {regime: code for code, regime in enumerate(Regime)}
"""Regime → its number in `EquilibriumBatch.regime`"""

INVALID = -1
"""The number in `EquilibriumBatch.regime` of a pair for which `solve` raises"""

_NAMES = np.array([*(regime.value for regime in Regime), 'invalid'])


@dataclasses.dataclass(frozen=True, eq=False)
class EquilibriumBatch:
    """The answers of `solve_batch`: the fields of `Equilibrium` as arrays of one shape.

    What the model does not determine is NaN, or False where it would be true or false. The
    pressure, the forces and the gradients are worked out, and then kept, when they are asked for.
    """

    design: JointDesign
    load: Load | NDArray[np.object_]
    """What acts beside the cables: one load, or an array of them of the shape of the results"""
    regime: NDArray[np.int8]
    """Numbers by `REGIME_CODES`; `INVALID` for a pair for which `solve` raises"""
    tension_l: Floats
    """T_l in N, as given: a view where one will do, so leave what it shows as it is"""
    tension_s: Floats
    """T_s in N, likewise"""
    root_count: NDArray[np.uint8]
    iterations: NDArray[np.uint8]
    """Steps to the root: of Newton's method, or of the bisection where that was needed"""
    bend_angle: Floats
    """θ in rad"""
    normal_force: Floats
    """N in N"""
    stable: NDArray[np.bool_]
    residual: Floats
    """(|M| − K) / (μ r) in N"""

    @property
    def regime_names(self) -> NDArray[np.str_]:
        """The regimes as text: the values of `Regime`, or ``invalid``."""
        names: NDArray[np.str_] = _NAMES[self.regime]
        return names

    @cached_property
    def pressure(self) -> Floats:
        """P in Pa."""
        return self.normal_force / self.design.contact_area

    @property
    def slip_margin(self) -> Floats:
        """M / K at the angle: ±1 at the limit of friction, beyond that only against the stop."""
        margins = np.empty(self.bend_angle.shape)
        flat = margins.reshape(-1)
        with np.errstate(all='ignore'):
            for part, slip, point in self._points():
                flat[part] = slip.side * point.moment / point.capacity
        return np.where(np.isnan(self.bend_angle), np.nan, margins)

    @property
    def forces(self) -> ContactForces:
        """The forces on the joint surface in N."""
        return self._contact[0]

    @property
    def force_remainder(self) -> ForceRemainder:
        """What Eqs. (1) and (2) leave over, one by one, in N."""
        return self._contact[1]

    @property
    def branch_consistent(self) -> NDArray[np.bool_]:
        """Whether Eqs. (1) and (2) ask for the contact force taken."""
        return self._contact[2]

    @property
    def bend_angle_gradient(self) -> TensionGradient:
        """∂θ/∂T in rad/N; NaN also where it is infinite."""
        return self._gradients[0]

    @property
    def pressure_gradient(self) -> TensionGradient:
        """∂p/∂T in Pa/N; NaN also where it is infinite."""
        return self._gradients[1]

    def bend_angle_stddev(self, tension_stddev: float) -> Floats:
        """Return the standard deviation of each angle in rad, as `Equilibrium` does."""
        by_l, by_s = self.bend_angle_gradient
        deviation: Floats = tension_stddev * np.hypot(by_l, by_s)
        return deviation

    def pressure_stddev(self, tension_stddev: float) -> Floats:
        """Return the standard deviation of each pressure in Pa."""
        by_l, by_s = self.pressure_gradient
        deviation: Floats = tension_stddev * np.hypot(by_l, by_s)
        return deviation

    @cached_property
    def _contact(self) -> tuple[ContactForces, ForceRemainder, NDArray[np.bool_]]:
        shape = self.bend_angle.shape
        numbers: Any = np.full((6, *shape), np.nan)
        consistent: Any = np.zeros(shape, np.bool_)
        rows, flags = numbers.reshape(6, -1), consistent.reshape(-1)
        with np.errstate(all='ignore'):
            for at, slip, point in self._points():
                state, limit = point.state, point.capacity
                normal = slip.law.normal(state, limit)
                forces, remainder = contact_forces(slip, point, limit, normal)
                for row, values in zip(rows, (*forces, *remainder), strict=True):
                    row[at] = values
                flags[at] = slip.law.consistent(state, limit)
        return ContactForces(*numbers[:4]), ForceRemainder(*numbers[4:]), consistent

    @cached_property
    def _gradients(self) -> tuple[TensionGradient, TensionGradient]:
        numbers: Any = np.full((4, *self.bend_angle.shape), np.nan)
        rows = numbers.reshape(4, -1)
        regimes = self.regime.reshape(-1)
        with np.errstate(all='ignore'):
            for at, slip, point in self._points():
                at_stop = regimes[at] == REGIME_CODES[Regime.DRIVEN_TO_STOP]
                gradients = _gradients_of(self.design, slip, point, at_stop)
                for row, values in zip(rows, gradients, strict=True):
                    row[at] = values
        return TensionGradient(*numbers[:2]), TensionGradient(*numbers[2:])

    def _points(self) -> Iterator[tuple[NDArray[np.intp], Slip, SlipPoint]]:
        """Walk through the pairs with an angle: yield where they are, and the slip functions."""
        for part, chunk in chunks(
            *(self.tension_l, self.tension_s, self.bend_angle),
            *dead_arrays(self.design, self.load),
        ):
            (known,) = np.nonzero(~np.isnan(chunk[2]))
            tension_l, tension_s, angle, *dead = (values[known] for values in chunk)
            at = known + part.start
            load = self.load if isinstance(self.load, Load) else self.load.reshape(-1)[at]
            slip = facing_slips(self.design, load, tension_l, tension_s, dead)
            yield at, slip, slip.at(np.abs(angle))


def _gradients_of(
    design: JointDesign, slip: Slip, point: SlipPoint, at_stop: NDArray[np.bool_]
) -> Floats:
    """∂θ/∂T_l, ∂θ/∂T_s, ∂p/∂T_l and ∂p/∂T_s of units that are about to slip, or at their stop."""
    lever = design.relative_lever
    behind, ahead = angle_by_tensions(slip, point, lever)
    angle = np.where(at_stop, 0.0, behind), np.where(at_stop, 0.0, ahead)
    slopes = slip.law.normal_slopes(point.state, point.capacity)
    normal = normal_by_tensions(slip, point, slopes, lever, angle=angle, at_limit=True)
    gradients = np.array(
        [
            *of_sides(slip, angle, slip.side),
            *(by / design.contact_area for by in of_sides(slip, normal)),
        ]
    )
    gradients[:, ~np.isfinite(gradients).all(axis=0)] = np.nan
    return gradients
