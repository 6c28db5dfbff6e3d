"""What can be fitted, and the parameters that are, scaled to about 1 and within their ranges."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..array_roots import Floats
from ..design import DesignParameter, JointDesign, design_parameters
from ..errors import CalibrationError, DesignError
from ..stacked_design import StackedDesign, stacked
from .load_cells import AS_MEASURED, CELL_PARAMETERS, LoadCells

if TYPE_CHECKING:
    from .samples import SortedSamples


class Model(NamedTuple):
    """All that a calibration may change: the unit, and what its load cells make of tensions."""

    design: JointDesign
    cells: LoadCells = AS_MEASURED

    def value(self, name: str) -> float:
        """Value of a parameter by its name."""
        owner = self.cells if name in LoadCells._fields else self.design
        value: float = getattr(owner, name)
        return value

    def with_values(self, values: Mapping[str, float]) -> Model:
        """Return the model with other values.

        Raises
        ------
        DesignError
            If they do not fit together.
        """
        of_cells = {name: values[name] for name in values if name in LoadCells._fields}
        of_design = {name: values[name] for name in values if name not in of_cells}
        return Model(
            dataclasses.replace(self.design, **of_design),  # type: ignore[arg-type]
            self.cells._replace(**of_cells),
        )


class Models(NamedTuple):
    """Several models as one, so that a formula serves all of them at once."""

    design: JointDesign | StackedDesign
    cells: LoadCells
    """Each number an array where it is not the same in all"""

    @classmethod
    def of(cls, models: Sequence[Model]) -> Models:
        """Return models, at least one, as one."""
        designs = [model.design for model in models]
        return cls(
            StackedDesign(designs) if len(designs) > 1 else designs[0],
            stacked([model.cells for model in models]),
        )


class Tried(NamedTuple):
    """What there is of the models that a search tries at once."""

    are_there: NDArray[np.bool_]
    """Which of them, shape ``(models,)``"""
    models: Models | None
    """Those that are there; None where none is"""


def fit_parameters() -> tuple[DesignParameter, ...]:
    """All that `calibrate` can fit: the design's numbers, and gain and bias of each load cell."""
    return design_parameters() + CELL_PARAMETERS


def checked_fit(fit: Sequence[str]) -> list[DesignParameter]:
    """Return the parameters of these names.

    Raises
    ------
    CalibrationError
        If there are none, one is unknown or given twice.
    """
    known = {parameter.name: parameter for parameter in fit_parameters()}
    fit = [fit] if isinstance(fit, str) else list(fit)
    for name in fit:
        if name not in known:
            raise CalibrationError(
                f'fit is {name!r}, which is no design parameter and none of a load cell; '
                f'there are {", ".join(known)}'
            )
        if fit.count(name) > 1:
            raise CalibrationError(f'fit names {name} twice')
    if not fit:
        raise CalibrationError('fit names no parameter')
    return [known[name] for name in fit]


class ParameterSpace:
    """The fitted parameters as a vector that is scaled to about 1.

    Attributes
    ----------
    start_model : Model
        Where the search starts.
    parameters : list of DesignParameter
    unit : ndarray
        What 1 of each is in SI, shape ``(k,)``.
    bounds : tuple of ndarray
        Least and largest value of each, scaled.
    start : ndarray
        The start model's, scaled.
    """

    def __init__(
        self, model: Model, parameters: list[DesignParameter], samples: SortedSamples
    ) -> None:
        self.start_model, self.parameters = model, parameters
        start = np.array([model.value(parameter.name) for parameter in parameters])
        natural = np.array([_natural(parameter, model, samples) for parameter in parameters])
        self.unit: Floats = np.where(start != 0.0, abs(start), natural)
        self.bounds: tuple[Floats, Floats] = (
            np.array([parameter.minimum for parameter in parameters]) / self.unit,
            np.array([_largest(parameter, model, samples) for parameter in parameters])
            / self.unit,
        )
        self.start: Floats = np.clip(start / self.unit, *self.bounds)

    def __len__(self) -> int:
        return len(self.parameters)

    @property
    def names(self) -> list[str]:
        """Names of the parameters."""
        return [parameter.name for parameter in self.parameters]

    def model_at(self, scaled: Floats) -> Model:
        """Return the model with the parameters, rounded into their ranges.

        Raises
        ------
        DesignError
            If they do not fit together.
        """
        return self.start_model.with_values(
            {
                parameter.name: min(max(value, parameter.minimum), parameter.maximum)
                for parameter, value in zip(
                    self.parameters, (scaled * self.unit).tolist(), strict=True
                )
            }
        )

    def tried_at(self, scaled: Floats) -> Tried:
        """Return the models with the parameters, which may be of several, in rows."""
        asked = [self._model_if_any(row) for row in np.atleast_2d(scaled)]
        there = [model for model in asked if model is not None]
        are_there = np.array([model is not None for model in asked])
        return Tried(are_there, Models.of(there) if there else None)

    def _model_if_any(self, scaled: Floats) -> Model | None:
        """Return the model with the parameters, None where they do not fit together."""
        try:
            return self.model_at(scaled)
        except DesignError:
            return None

    def starting_at(self, name: str, value: float) -> Floats:
        """The start with another value for one parameter, within its bounds, scaled."""
        index = self.names.index(name)
        scaled = self.start.copy()
        scaled[index] = value / self.unit[index]
        within: Floats = np.clip(scaled, *self.bounds)
        return within


def _natural(parameter: DesignParameter, model: Model, samples: SortedSamples) -> float:
    """A size of a parameter that starts at 0, in its unit."""
    if parameter.name == 'stiffness':
        used = samples.slipping | samples.held
        total = (samples.tension_l + samples.tension_s)[used]
        return 0.1 * model.design.ball_radius * float(np.median(total))
    if parameter.name in LoadCells._fields:
        return samples.noise.tension
    return 1e-3 * (parameter.maximum - parameter.minimum)


def _largest(parameter: DesignParameter, model: Model, samples: SortedSamples) -> float:
    """Upper end of a range; of mass and gravity, such that all tensions exceed the dead load."""
    other = {'mass': 'gravity', 'gravity': 'mass'}.get(parameter.name)
    factor = 0.0 if other is None else model.value(other)
    if factor == 0.0 or model.design.law.carries_more_than_cables:
        return parameter.maximum
    used = samples.slipping | samples.held
    loads = samples.loads.part(used)
    total = (samples.tension_l + samples.tension_s)[used]
    # |W d + F|² = T² with the direction d of gravity in the plane, its length at most 1.
    square = loads.gravity_x**2 + loads.gravity_z**2
    along = loads.gravity_x * loads.force_x + loads.gravity_z * loads.force_z
    rest = total**2 - loads.force_x**2 - loads.force_z**2
    with np.errstate(divide='ignore', invalid='ignore'):
        # The larger root, in the form that does not cancel where F is along d.
        root = np.sqrt(along**2 + square * rest)
        weight = np.where(along > 0.0, rest / (root + along), (root - along) / square)
    least = float(np.nanmin(weight))
    return min(parameter.maximum, (1.0 - 1e-6) * least / factor)
