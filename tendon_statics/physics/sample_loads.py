"""The dead load of every sample: as it was recorded, and for the rest as it was all along."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .array_roots import Floats
from .design import JointDesign
from .load import DeadLoad, Load
from .stacked_design import StackedDesign
from .tensions import NEGLIGIBLE_PULL


class SampleLoads(NamedTuple):
    """Loads of samples, as `Load` has them; arrays of shape ``(n,)``, NaN where not measured."""

    gravity_x: Floats
    """Direction of gravity along X"""
    gravity_z: Floats
    """Along Z; what is left to a length of 1 lies across the plane of bending"""
    force_x: Floats
    """Tip force in N along X"""
    force_z: Floats
    distance: float
    """Of the tip force along the unit's axis, in m"""

    @classmethod
    def of(
        cls,
        load: Load,
        count: int,
        *,
        base_tilt: ArrayLike | None = None,
        base_roll: ArrayLike | None = None,
        tip_force_x: ArrayLike | None = None,
        tip_force_z: ArrayLike | None = None,
    ) -> SampleLoads:
        """Return the loads of so many samples.

        Parameters
        ----------
        load : Load
            What it was where nothing was recorded.
        base_tilt, base_roll : array_like, optional
            Of the base in the plane of bending, towards cable s, and out of it, in rad. Without a
            roll it is 0.
        tip_force_x, tip_force_z : array_like, optional
            In N, in the joint frame.
        """
        x, _, z = load.gravity_direction
        gravity_x, gravity_z = np.full(count, x), np.full(count, z)
        if base_tilt is not None:
            tilt = np.asarray(base_tilt, dtype=np.float64)
            share = 1.0 if base_roll is None else np.cos(np.asarray(base_roll, dtype=np.float64))
            gravity_x, gravity_z = share * np.sin(tilt), -share * np.cos(tilt)
        force_x, force_z = (
            np.full(count, force) if recorded is None else np.asarray(recorded, dtype=np.float64)
            for recorded, force in zip((tip_force_x, tip_force_z), load.tip_force, strict=True)
        )
        return cls(gravity_x, gravity_z, force_x, force_z, load.tip_distance)

    def on(self, design: JointDesign | StackedDesign) -> DeadLoad:
        """Return the forces and moments that they mean for one unit, in arrays."""
        weight, lever = design.weight, design.com_distance
        weight_x, weight_z = weight * self.gravity_x, weight * self.gravity_z
        return DeadLoad(
            weight_x + self.force_x,
            weight_z + self.force_z,
            lever * weight_x + self.distance * self.force_x,
            lever * weight_z + self.distance * self.force_z,
        )

    def part(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> SampleLoads:
        """Return those of some of the samples."""
        return SampleLoads(
            self.gravity_x[which],
            self.gravity_z[which],
            self.force_x[which],
            self.force_z[which],
            self.distance,
        )

    def loads(self) -> list[Load]:
        """Return them one by one.

        What of gravity lies across the plane of bending has no sign here, and no effect.
        """
        across = np.sqrt(np.clip(1.0 - self.gravity_x**2 - self.gravity_z**2, 0.0, 1.0))
        parts = (self.gravity_x, across, self.gravity_z, self.force_x, self.force_z)
        made: dict[tuple[float, ...], Load] = {}  # mostly it stays what it was
        found = []
        for row in zip(*(part.tolist() for part in parts), strict=True):
            if row not in made:
                x, y, z, force_x, force_z = row
                made = {row: Load((x, y, z), (force_x, force_z), self.distance)}
            found.append(made[row])
        return found


def seating_tension(design: JointDesign | StackedDesign, dead: DeadLoad) -> Any:
    """Sum of the tensions in N that has to be exceeded so that the joint is seated.

    It is what `taut_slip` asks for, for a dead load of floats or of arrays.
    """
    size = dead.size
    if not design.law.carries_more_than_cables:
        return size
    # The largest pull of the dead load within the stops.
    tilt = np.abs(np.arctan2(dead.force_x, -dead.force_z))
    farthest = np.minimum(tilt + design.max_bend_angle, math.pi)
    return np.minimum(size, np.maximum(-size * np.cos(farthest), NEGLIGIBLE_PULL * size))
