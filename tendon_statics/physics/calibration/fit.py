"""From a recorded session to a design that fits it, with the uncertainty of every value."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..array_roots import Floats
from .result import CONFIDENCE, Calibration, FittedParameter, ResidualStatistics
from .samples import Samples, SortedSamples, as_floats
from .fit_warnings import calibration_warnings
from ..design import DesignParameter, JointDesign, design_parameters
from ..errors import CalibrationError, DesignError
from .identifiability import (
    LOSS_SCALE,
    Identification,
    identify,
    scatter_scale,
    scatter_significance,
)
from .boundary_distance import BoundaryDistance, Noise

DEFAULT_FIT = ('mass', 'cable_offset', 'friction_coefficient')

TENSION_STDDEVS = (1e-9, 1e3)
BEND_ANGLE_STDDEVS = (0.0, 1.0)
PRESSURE_STDDEVS = (1e-9, 1e15)
"""Ranges of standard deviations that are taken, in N, rad and Pa"""

SCALE_TOLERANCE = 1e-3
"""Relative change of the noise's scale at which a fit has settled"""
LARGEST_DISTANCE = 1e100
"""In standard deviations; its square must be a number"""

MOST_DESIGNS = 2000
"""Tried in one search, after which it must have ended"""

LARGEST_SCALE = 100.0
"""Of the noise as it is to that which is stated, beyond which something else is wrong"""

MOST_ROUNDS = 30
"""Fits after which it must have"""


def calibrate(
    design: JointDesign,
    data: Samples,
    fit: Sequence[str] = DEFAULT_FIT,
    *,
    tension_stddev: float = 0.01,
    bend_angle_stddev: float = math.radians(0.5),
    pressure_stddev: float | None = None,
) -> Calibration:
    """Fit parameters of a design to samples of a unit that slips or is held.

    A slipping sample lies on the boundary of slip, which is an equation; with a measured pressure
    it is two. A hold, that is held samples at one angle, is an inequality: it counts only as far
    as it lies beyond the boundary by more than noise explains. Every distance is in units of its
    own noise, with that of tensions, angle and pressure taken to first order (see
    `boundary_distance`), and enters by a soft L1 loss, so that outliers do not rule the fit. Values
    stay within the ranges of `design_parameters`.

    Standard errors come from the slipping samples alone, for the stated noise, or, where the
    distances scatter more than that, for the noise that they tell themselves (see
    `identifiability`).

    Parameters
    ----------
    design : JointDesign
        Where the search starts; also holds the parameters that are not fitted.
    data : Samples
        A `Recording`, say. Samples that cannot be used are counted, by reason.
    fit : sequence of str
        Names of design parameters.
    tension_stddev : float
        Standard deviation of each measured tension in N.
    bend_angle_stddev : float
        Standard deviation of the measured angle in rad.
    pressure_stddev : float, optional
        Standard deviation of the measured pressure in Pa; by default 2 % of the median.

    Raises
    ------
    CalibrationError
        If `fit` names no parameter or an unknown one, there is no angle, it is not known which
        samples are slipping or none of them can be used, a deviation is not valid, or the search
        does not settle.
    ImportError
        Without SciPy.
    """
    parameters = _checked_fit(fit)
    noise = _checked_noise(tension_stddev, bend_angle_stddev, pressure_stddev, data.pressure)
    samples = SortedSamples(design, data, noise)
    return _Problem(design, parameters, samples).settled().result()


def _checked_fit(fit: Sequence[str]) -> list[DesignParameter]:
    known = {parameter.name: parameter for parameter in design_parameters()}
    fit = [fit] if isinstance(fit, str) else list(fit)
    for name in fit:
        if name not in known:
            raise CalibrationError(
                f'fit is {name!r}, which is no design parameter; there are {", ".join(known)}'
            )
        if fit.count(name) > 1:
            raise CalibrationError(f'fit names {name} twice')
    if not fit:
        raise CalibrationError('fit names no parameter')
    return [known[name] for name in fit]


def _checked_noise(
    tension: float, bend_angle: float, pressure: float | None, pressures: ArrayLike | None
) -> Noise:
    if pressure is None:
        measured = as_floats([] if pressures is None else pressures)
        measured = measured[np.isfinite(measured) & (measured != 0.0)]
        pressure = 0.02 * float(np.median(abs(measured))) if len(measured) else 1.0
    for name, value, unit, (low, high) in (
        ('tension_stddev', tension, 'N', TENSION_STDDEVS),
        ('bend_angle_stddev', bend_angle, 'rad', BEND_ANGLE_STDDEVS),
        ('pressure_stddev', pressure, 'Pa', PRESSURE_STDDEVS),
    ):
        if not low <= value <= high:
            raise CalibrationError(
                f'{name} is {value!r} {unit}, allowed is {low:g} to {high:g} {unit}'
            )
    return Noise(tension, bend_angle, pressure)


class _Problem:
    """The least-squares problem in parameters that are scaled to about 1, and where it stands."""

    def __init__(
        self, design: JointDesign, parameters: list[DesignParameter], samples: SortedSamples
    ) -> None:
        self._design, self._parameters, self._samples = design, parameters, samples
        start = np.array([getattr(design, parameter.name) for parameter in parameters])
        widths = np.array([parameter.maximum - parameter.minimum for parameter in parameters])
        self._unit = np.where(start != 0.0, abs(start), 1e-3 * widths)
        self._bounds = (
            np.array([parameter.minimum for parameter in parameters]) / self._unit,
            np.array([self._largest(parameter) for parameter in parameters]) / self._unit,
        )
        self._scaled = np.clip(start / self._unit, *self._bounds)
        self._noise_scale = 1.0

    def _largest(self, parameter: DesignParameter) -> float:
        """Upper end of a range; of mass and gravity, such that all tensions exceed the weight."""
        other = {'mass': 'gravity', 'gravity': 'mass'}.get(parameter.name)
        factor = 0.0 if other is None else getattr(self._design, other)
        if factor == 0.0:
            return parameter.maximum
        samples = self._samples
        used = samples.slipping | samples.held
        least = float((samples.tension_l + samples.tension_s)[used].min())
        return min(parameter.maximum, (1.0 - 1e-6) * least / factor)

    def settled(self) -> _Problem:
        """Fit, over and over, until the scale of the noise is the one that the distances tell.

        Raises
        ------
        CalibrationError
            If a search or the scale does not settle, or a sample gives no number at the start.
        """
        for _ in range(MOST_ROUNDS):
            self._search()
            before, self._noise_scale = self._noise_scale, max(1.0, self._told_scale())
            if self._noise_scale > LARGEST_SCALE:
                raise CalibrationError(
                    'no design comes near the data: they scatter '
                    f'{self._noise_scale:.2g} times as much as the stated noise explains; '
                    'look for wrong units, signs or states'
                )
            if abs(self._noise_scale - before) <= SCALE_TOLERANCE * before:
                return self
        raise CalibrationError(
            f'the fit has not settled after {MOST_ROUNDS} rounds: the distances tell a noise of '
            f'{before:.3g} and of {self._noise_scale:.3g} times the stated in turn; '
            'fit fewer parameters, or look for wrong states'
        )

    def _search(self) -> None:
        from scipy.optimize import least_squares

        # NaN fails this test too.
        if not (abs(self._residuals(self._scaled)) < LARGEST_DISTANCE).all():
            raise CalibrationError(
                'at the start design not every sample has a distance from the boundary of slip: '
                'a value in the data is beyond all measure'
            )
        found = least_squares(
            self._residuals,
            self._scaled,
            jac='3-point',
            bounds=self._bounds,
            loss='soft_l1',
            f_scale=LOSS_SCALE,
            xtol=1e-10,
            ftol=1e-12,
            gtol=1e-10,
            max_nfev=MOST_DESIGNS,
        )
        if not found.success:
            raise CalibrationError(
                f'the search for the best design has not ended after {found.nfev} designs: '
                'look for wrong units, signs or states, start from a nearer design, or fit fewer '
                'parameters'
            )
        self._scaled = found.x

    def _told_scale(self) -> float:
        """Standard deviation of the noise that the distances tell, as a multiple of the stated."""
        return scatter_scale(self._equations(self._scaled), self._degrees_of_freedom())

    def _degrees_of_freedom(self) -> int:
        """Equations less what they determine of the parameters."""
        identification = self._identification()
        known = len(self._parameters) - len(identification.null_directions)
        return len(self._equations(self._scaled)) - known

    def _identification(self) -> Identification:
        equations = self._equations(self._scaled) / self._noise_scale
        return identify(self._jacobian(self._scaled) / self._noise_scale, equations)

    def _residuals(self, scaled: Floats) -> Floats:
        """Equations of the slipping samples and inequalities of the holds, in units of noise.

        They are NaN where there is no such design, from which the search turns back.
        """
        parts = [self._equations(scaled), self._hold_excesses(scaled)]
        residuals: Floats = np.concatenate(parts) / self._noise_scale
        return residuals

    def _equations(self, scaled: Floats) -> Floats:
        samples = self._samples
        distance = self._distance(scaled, samples.slipping)
        measured = samples.with_pressure[samples.slipping]
        return np.concatenate([distance.standardised, distance.pressure_standardised[measured]])

    def _hold_excesses(self, scaled: Floats) -> Floats:
        held = self._distance(scaled, self._samples.held).standardised
        return self._samples.hold_excesses(held, self._noise_scale)

    def _distance(self, scaled: Floats, of: NDArray[np.bool_]) -> BoundaryDistance:
        samples = self._samples
        try:
            design = self._design_at(scaled)
        except DesignError:
            return BoundaryDistance(*(np.full((4, int(of.sum())), math.nan)))
        return samples.distance(design, of)

    def _design_at(self, scaled: Floats) -> JointDesign:
        """Design with the parameters, rounded into their ranges.

        Raises
        ------
        DesignError
            If they do not fit together.
        """
        values = {
            parameter.name: min(max(value, parameter.minimum), parameter.maximum)
            for parameter, value in zip(
                self._parameters, (scaled * self._unit).tolist(), strict=True
            )
        }
        return dataclasses.replace(self._design, **values)

    def _jacobian(self, scaled: Floats) -> Floats:
        """Derivatives of the equations by the scaled parameters, from central differences."""
        columns = []
        for index, value in enumerate(scaled):
            ends = np.stack([scaled, scaled])
            step = 1e-5 * max(abs(value), 1.0)
            low, high = (bound[index] for bound in self._bounds)
            ends[:, index] = max(value - step, low), min(value + step, high)
            change = self._equations(ends[1]) - self._equations(ends[0])
            columns.append(change / (ends[1, index] - ends[0, index]))
        jacobian: Floats = np.nan_to_num(np.stack(columns, axis=1))
        return jacobian

    def result(self) -> Calibration:
        """Work out what is to be said of the solution."""
        samples = self._samples
        identification = self._identification()
        residuals = self._statistics()
        fitted = self._fitted(identification, residuals)
        design = self._design_at(self._scaled)
        low, high = (bound * self._unit for bound in self._bounds)
        ranges = list(zip(self._parameters, low.tolist(), high.tolist(), strict=True))
        used = samples.slipping | samples.held
        everywhere = samples.distance(design, np.full(len(used), True))
        return Calibration(
            start=self._design,
            design=design if all(value.value is not None for value in fitted) else None,
            parameters=fitted,
            correlation=identification.correlation,
            residuals=residuals,
            noise=samples.noise,
            counts=samples.counts,
            warnings=tuple(
                calibration_warnings(
                    ranges,
                    fitted,
                    identification,
                    residuals,
                    samples.counts,
                    states_are_known=samples.states_are_known,
                )
            ),
            roles=samples.roles,
            distance=BoundaryDistance(*(np.where(used, a, math.nan) for a in everywhere)),
        )

    def _fitted(
        self, identification: Identification, residuals: ResidualStatistics
    ) -> tuple[FittedParameter, ...]:
        """Tell of each parameter what the data do."""
        errors = identification.standard_errors * self._unit
        half_widths = errors / self._noise_scale * _interval_factor(residuals)
        design = self._design_at(self._scaled)
        ends = zip(*(bound * self._unit for bound in self._bounds), strict=True)
        fitted = []
        for parameter, error, half, (low, high) in zip(
            self._parameters, errors, half_widths, ends, strict=True
        ):
            start = getattr(self._design, parameter.name)
            if math.isnan(error):
                fitted.append(FittedParameter(parameter.name, start, None, None, None))
                continue
            value = getattr(design, parameter.name)
            interval = max(value - float(half), float(low)), min(value + float(half), float(high))
            fitted.append(FittedParameter(parameter.name, start, value, float(error), interval))
        return tuple(fitted)

    def _statistics(self) -> ResidualStatistics:
        equations = self._equations(self._scaled)
        degrees_of_freedom = self._degrees_of_freedom()
        sizes = abs(equations)
        return ResidualStatistics(
            root_mean_square=float(np.sqrt(np.mean(equations**2))),
            median=float(np.median(sizes)),
            largest=float(sizes.max()),
            outliers=int((sizes > 3.0).sum()),
            degrees_of_freedom=degrees_of_freedom,
            scale=scatter_scale(equations, degrees_of_freedom),
            significance=scatter_significance(equations, degrees_of_freedom),
            hold_violations=int((self._hold_excesses(self._scaled) > 0.0).sum()),
        )


def _interval_factor(residuals: ResidualStatistics) -> float:
    """Half of a 95 % interval in standard errors of the stated noise.

    That is of the normal distribution, or, where that is more, Student's for the noise that the
    distances tell.
    """
    from scipy.special import ndtri, stdtrit

    share = 0.5 + 0.5 * CONFIDENCE
    normal = float(ndtri(share))
    if residuals.degrees_of_freedom < 1:
        return normal
    return max(normal, residuals.scale * float(stdtrit(residuals.degrees_of_freedom, share)))
