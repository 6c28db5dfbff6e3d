"""What `calibrate` gives back."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .design import JointDesign
from .slip_boundary import BoundaryDistance, Noise

SLIPPING, HELD = 'slipping', 'held'
"""Values of a sample's state"""

INTERVAL = 1.959963984540054
"""Standard errors on either side of a value that make an interval of 95 %"""


class FittedParameter(NamedTuple):
    """A design parameter as the data say it is."""

    name: str
    value: float
    """The fitted value; not one that the data tell if `standard_error` is None"""
    start: float
    """Where the fit began"""
    standard_error: float | None
    """None if the data do not determine the parameter"""

    @property
    def interval(self) -> tuple[float, float] | None:
        """Ends of the 95 % interval; None if the data do not determine the parameter."""
        if self.standard_error is None:
            return None
        half = INTERVAL * self.standard_error
        return self.value - half, self.value + half


class ResidualStatistics(NamedTuple):
    """How well the fitted design meets the data; distances in units of the stated noise."""

    root_mean_square: float
    """About 1 if noise and model are right"""
    median: float
    """Median of the absolute distances; about 0.67"""
    largest: float
    outliers: int
    """Distances above 3"""
    degrees_of_freedom: int
    """Equations less fitted parameters"""
    held_violations: int
    """Held samples that lie beyond the boundary by more than 3"""


@dataclasses.dataclass(frozen=True, eq=False)
class Calibration:
    """The result of `calibrate`."""

    start: JointDesign
    """Where the fit began"""
    design: JointDesign
    """The start design with the fitted values"""
    parameters: tuple[FittedParameter, ...]
    correlation: NDArray[np.float64]
    """Of the fitted values, shape ``(k, k)``; NaN where the data do not determine one"""
    residuals: ResidualStatistics
    noise: Noise
    """As stated or taken by default"""
    counts: dict[str, int]
    """Samples by what became of them: slipping, with pressure, held, or why not used"""
    warnings: tuple[str, ...]
    """What is to be known before the values are used, a sentence each"""
    roles: NDArray[np.str_]
    """Of every sample, the key of `counts` it was counted under"""
    distance: BoundaryDistance
    """Of every sample from the fitted boundary; NaN where it was not used"""

    def as_dict(self) -> dict[str, Any]:
        """Return the result without the arrays of samples, ready for JSON."""
        return {
            'design': dataclasses.asdict(self.design),
            'parameters': [parameter._asdict() for parameter in self.parameters],
            'correlation': [
                [None if math.isnan(value) else value for value in row]
                for row in self.correlation.tolist()
            ],
            'residuals': self.residuals._asdict(),
            'noise': self.noise._asdict(),
            'counts': self.counts,
            'warnings': list(self.warnings),
        }
