"""What `calibrate` gives back."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..design import JointDesign, design_parameters
from ..design_uncertainty import DesignUncertainty
from ..sample_loads import SampleLoads
from .boundary_distance import BoundaryDistance, Noise
from .load_cells import LoadCells

SLIPPING, HELD = 'slipping', 'held'
"""Values of a sample's state"""

CONFIDENCE = 0.95
"""Of the intervals"""


class FittedParameter(NamedTuple):
    """A design parameter as the data say it is; None for what they do not determine."""

    name: str
    start: float
    """Where the fit began"""
    value: float | None
    standard_error: float | None
    interval: tuple[float, float] | None
    """Ends of the 95 % interval, within the parameter's range"""


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
    """Equations less what they determine of the parameters"""
    scale: float
    """Standard deviation of the noise that the distances themselves tell, outliers left aside;
    0 where there are no degrees of freedom"""
    significance: float
    """By how many standard deviations they scatter more than the stated noise would"""
    hold_violations: int
    """Holds that lie beyond the boundary by more than noise explains"""


@dataclasses.dataclass(frozen=True, eq=False)
class Calibration:
    """The result of `calibrate`."""

    start: JointDesign
    """Where the fit began"""
    design: JointDesign | None
    """The start design with the fitted values; None if the data do not determine one of them"""
    cells: LoadCells | None
    """What the load cells make of tensions, likewise"""
    parameters: tuple[FittedParameter, ...]
    correlation: NDArray[np.float64]
    """Of the fitted values, shape ``(k, k)``; NaN where the data do not determine one"""
    residuals: ResidualStatistics
    noise: Noise
    """As stated or taken by default"""
    counts: dict[str, int]
    """Samples by what became of them: slipping, with pressure, held, or why not used; and holds"""
    warnings: tuple[str, ...]
    """What is to be known before the values are used, a sentence each"""
    roles: NDArray[np.str_]
    """Of every sample, the key of `counts` it was counted under"""
    loads: SampleLoads
    """What acts on every sample beside the cables"""
    distance: BoundaryDistance
    """Of every sample from the fitted boundary; NaN where it was not used"""

    @property
    def undetermined(self) -> list[str]:
        """Names of the parameters that the data do not determine."""
        return [parameter.name for parameter in self.parameters if parameter.value is None]

    @property
    def uncertainty(self) -> DesignUncertainty | None:
        """Covariance of the fitted parameters of the design; None without a fitted design.

        What is known of the load cells is not in it, but has widened it.
        """
        names = {parameter.name for parameter in design_parameters()}
        fitted = [place for place, of in enumerate(self.parameters) if of.name in names]
        errors = np.array([self.parameters[place].standard_error for place in fitted])
        if self.design is None or not fitted:
            return None
        correlation = self.correlation[np.ix_(fitted, fitted)]
        covariance = correlation * np.outer(errors, errors)
        return DesignUncertainty(
            tuple(self.parameters[place].name for place in fitted),
            tuple(map(tuple, (0.5 * (covariance + covariance.T)).tolist())),
        )

    def as_dict(self) -> dict[str, Any]:
        """Return the result without the arrays of samples, ready for JSON."""
        return {
            'design': None if self.design is None else dataclasses.asdict(self.design),
            'load_cells': None if self.cells is None else self.cells._asdict(),
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
