"""The least-squares problem of a calibration, and where its search stands."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..array_roots import Floats
from ..errors import CalibrationError
from .identifiability import (
    LOSS_SCALE,
    Identification,
    identify,
    loss,
    scatter_scale,
)
from .parameters import Model, ParameterSpace, Tried
from .samples import SortedSamples

SCALE_TOLERANCE = 1e-3
"""Relative change of the noise's scale at which a fit has settled"""
LARGEST_DISTANCE = 1e100
"""In standard deviations; its square must be a number"""

AT_BOUND = 1e-12
"""Scaled distance from the end of a range within which a value is taken to be there"""

MOST_DESIGNS = 2000
"""Tried in one search, after which it must have ended"""

MOST_AT_ONCE = 20_000
"""Samples times models of which distances are found at once: more take memory and gain no time"""

LARGEST_SCALE = 100.0
"""Of the noise as it is to that which is stated, beyond which something else is wrong"""

MOST_ROUNDS = 30
"""Fits after which it must have"""


class Problem:
    """Equations of slipping samples and inequalities of holds, over the fitted parameters.

    Attributes
    ----------
    space : ParameterSpace
    samples : SortedSamples
    scaled : ndarray
        Where the search stands.
    noise_scale : float
        What the noise is taken to be, as a multiple of the stated.
    """

    def __init__(
        self, space: ParameterSpace, samples: SortedSamples, start: Floats | None = None
    ) -> None:
        self.space, self.samples = space, samples
        self.scaled = space.start if start is None else start
        self.noise_scale = 1.0

    @property
    def model(self) -> Model:
        """The model where the search stands."""
        return self.space.model_at(self.scaled)

    def settle(self) -> Problem:
        """Fit, over and over, until the scale of the noise is the one that the distances tell.

        Raises
        ------
        CalibrationError
            If a search or the scale does not settle, or a sample gives no number at the start.
        """
        for _ in range(MOST_ROUNDS):
            self.search()
            before, self.noise_scale = self.noise_scale, max(1.0, self._told_scale())
            if self.noise_scale > LARGEST_SCALE:
                raise CalibrationError(
                    'no design comes near the data: they scatter '
                    f'{self.noise_scale:.2g} times as much as the stated noise explains; '
                    'look for wrong units, signs or states'
                )
            if abs(self.noise_scale - before) <= SCALE_TOLERANCE * before:
                return self
        raise CalibrationError(
            f'the fit has not settled after {MOST_ROUNDS} rounds: the distances tell a noise of '
            f'{before:.3g} and of {self.noise_scale:.3g} times the stated in turn; '
            'fit fewer parameters, or look for wrong states'
        )

    def search(self, *, roughly: bool = False) -> None:
        """Find the best values for the noise as it is taken to be.

        Parameters
        ----------
        roughly : bool
            Whether to stop where the search hardly gains any more, as for a comparison of starts.

        Raises
        ------
        CalibrationError
            If the search does not end, or a sample gives no number at the start.
        """
        from scipy.optimize import least_squares

        # NaN fails this test too.
        if not (abs(self._residuals(self.scaled)) < LARGEST_DISTANCE).all():
            raise CalibrationError(
                'at the start design not every sample has a distance from the boundary of slip: '
                'a value in the data is beyond all measure'
            )
        found = least_squares(
            self._residuals,
            self.scaled,
            jac=lambda scaled: self._jacobian(self._residuals, scaled),
            bounds=self.space.bounds,
            loss='soft_l1',
            f_scale=LOSS_SCALE,
            xtol=1e-5 if roughly else 1e-10,
            ftol=1e-4 if roughly else 1e-12,
            gtol=1e-10,
            max_nfev=MOST_DESIGNS,
        )
        if not found.success:
            raise CalibrationError(
                f'the search for the best design has not ended after {found.nfev} designs: '
                'look for wrong units, signs or states, start from a nearer design, or fit fewer '
                'parameters'
            )
        self.scaled = found.x
        for bound in self.space.bounds:  # which the search does not quite reach
            self.scaled = np.where(abs(self.scaled - bound) < AT_BOUND, bound, self.scaled)

    def loss(self) -> float:
        """Sum of the losses where the search stands: −2 log of the likelihood, but for a constant.

        NaN where a sample has no distance from the boundary.
        """
        return float(np.sum(loss(self._residuals(self.scaled))))

    def degrees_of_freedom(self) -> int:
        """Equations less what they determine of the parameters."""
        return len(self.equations()) - self.identification().rank

    def identification(self) -> Identification:
        """Tell what the equations determine of the parameters, for the noise as it is taken."""
        jacobian = self._jacobian(self._equations, self.scaled)
        return identify(jacobian / self.noise_scale, self.equations() / self.noise_scale)

    def equations(self) -> Floats:
        """Distances of the slipping samples, and of their pressures, in units of stated noise."""
        return self._equations(self.scaled)

    def hold_excesses(self) -> Floats:
        """How far each hold lies beyond the boundary by more than noise explains."""
        return self._hold_excesses_of(self.space.tried_at(self.scaled))[:, 0]

    def _told_scale(self) -> float:
        """Standard deviation of the noise that the distances tell, as a multiple of the stated."""
        return scatter_scale(self.equations(), self.degrees_of_freedom())

    def _residuals(self, scaled: Floats) -> Floats:
        """All equations and inequalities, in units of noise; of each model of several a column.

        They are NaN where there is no such design, from which the search turns back.
        """
        tried = self.space.tried_at(scaled)
        parts = [self._equations_of(tried), self._hold_excesses_of(tried)]
        residuals: Floats = np.concatenate(parts) / self.noise_scale
        return residuals if scaled.ndim > 1 else residuals[:, 0]

    def _equations(self, scaled: Floats) -> Floats:
        equations = self._equations_of(self.space.tried_at(scaled))
        return equations if scaled.ndim > 1 else equations[:, 0]

    def _equations_of(self, tried: Tried) -> Floats:
        samples = self.samples
        distances, of_pressures = self._distances(tried, samples.slipping)
        measured = samples.with_pressure[samples.slipping]
        return np.concatenate([distances, of_pressures[measured]])

    def _hold_excesses_of(self, tried: Tried) -> Floats:
        if not self.samples.counts['holds']:
            return np.zeros((0, len(tried.are_there)))
        held, _ = self._distances(tried, self.samples.held)
        return self.samples.hold_excesses(held, self.noise_scale)

    def _distances(self, tried: Tried, of: NDArray[np.bool_]) -> Floats:
        """Distances in units of noise, and what pressures say beyond, shape ``(2, n, models)``."""
        found = np.full((2, np.count_nonzero(of), len(tried.are_there)), math.nan)
        if tried.models is not None:
            distance = self.samples.distances(tried.models, of)
            found[0][:, tried.are_there] = distance.standardised
            found[1][:, tried.are_there] = distance.pressure_standardised
        return found

    def _jacobian(self, function: Callable[[Floats], Floats], scaled: Floats) -> Floats:
        """Derivatives by the scaled parameters, from central differences; 0 for no number."""
        low, high = self.space.bounds
        step = 1e-5 * np.maximum(abs(scaled), 1.0)
        below, above = np.maximum(scaled - step, low), np.minimum(scaled + step, high)
        count, own = len(scaled), np.eye(len(scaled), dtype=bool)
        ends = np.concatenate([np.where(own, end, scaled) for end in (below, above)])
        at_once = max(1, MOST_AT_ONCE // len(self.samples.tension_l))
        values = np.concatenate(
            [function(ends[i : i + at_once]) for i in range(0, len(ends), at_once)], axis=1
        )
        change = values[:, count:] - values[:, :count]
        jacobian: Floats = np.nan_to_num(change / (above - below))
        return jacobian
