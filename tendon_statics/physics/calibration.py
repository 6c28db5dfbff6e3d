"""From a recorded session to a design that fits it, with the uncertainty of every value."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .array_roots import Floats
from .calibration_result import (
    HELD,
    SLIPPING,
    Calibration,
    FittedParameter,
    ResidualStatistics,
)
from .calibration_warnings import calibration_warnings
from .design import DesignParameter, JointDesign, design_parameters
from .errors import CalibrationError, DesignError
from .identification import LOSS_SCALE, identify
from .slip_boundary import BoundaryDistance, Noise, boundary_distance
from .solver import MAX_TENSION

DEFAULT_FIT = ('mass', 'cable_offset', 'friction_coefficient')


class Samples(Protocol):
    """What `calibrate` fits to, such as a `Recording`; arrays of shape ``(n,)``."""

    @property
    def tension_l(self) -> ArrayLike:
        """T_l in N."""

    @property
    def tension_s(self) -> ArrayLike:
        """T_s in N."""

    @property
    def bend_angle(self) -> ArrayLike | None:
        """θ in rad, NaN where it was not measured."""

    @property
    def pressure(self) -> ArrayLike | None:
        """Measured p in Pa, likewise, or None."""

    @property
    def state(self) -> Sequence[str] | None:
        """``slipping``, ``held`` or anything else; None: every sample is slipping."""


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
    it is two. A held sample is admissible: it counts only as far as it lies beyond the boundary.
    Every distance is in units of its own noise, with that of tensions, angle and pressure taken
    to first order (see `slip_boundary`), and enters by a soft L1 loss, so that outliers do not
    rule the fit. Values stay within the ranges of `design_parameters`.

    Standard errors come from the slipping samples alone, for the stated noise; where the distances
    are larger than that explains, the errors are enlarged in proportion.

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
        If `fit` names no parameter or an unknown one, there is no angle, no slipping sample can
        be used, or a deviation is not valid.
    ImportError
        Without SciPy.
    """
    from scipy.optimize import least_squares

    parameters = _checked_fit(fit)
    noise = _checked_noise(tension_stddev, bend_angle_stddev, pressure_stddev, data.pressure)
    samples = _Samples(design, data, noise)
    problem = _Problem(design, parameters, samples)
    solution = least_squares(
        problem.residuals,
        problem.start,
        jac='3-point',
        bounds=problem.bounds,
        loss='soft_l1',
        f_scale=LOSS_SCALE,
        xtol=1e-12,
        ftol=1e-15,
        gtol=1e-15,
    )
    return problem.result(solution.x)


def _checked_fit(fit: Sequence[str]) -> list[DesignParameter]:
    known = {parameter.name: parameter for parameter in design_parameters()}
    for name in fit:
        if name not in known:
            raise CalibrationError(
                f'fit is {name!r}, which is no design parameter; there are {", ".join(known)}'
            )
        if list(fit).count(name) > 1:
            raise CalibrationError(f'fit names {name} twice')
    if not fit:
        raise CalibrationError('fit names no parameter')
    return [known[name] for name in fit]


def _checked_noise(
    tension: float, bend_angle: float, pressure: float | None, pressures: ArrayLike | None
) -> Noise:
    if pressure is None:
        measured = _floats([] if pressures is None else pressures)
        measured = measured[np.isfinite(measured) & (measured != 0.0)]
        pressure = 0.02 * float(np.median(abs(measured))) if len(measured) else 1.0
    for name, value, unit in (
        ('tension_stddev', tension, 'N'),
        ('pressure_stddev', pressure, 'Pa'),
    ):
        if not 0.0 < value < math.inf:
            raise CalibrationError(f'{name} is {value!r} {unit}, which must be above 0')
    if not 0.0 <= bend_angle < math.inf:
        raise CalibrationError(
            f'bend_angle_stddev is {bend_angle!r} rad, which must be at least 0'
        )
    return Noise(tension, bend_angle, pressure)


class _Samples:
    """The samples as arrays, and what each of them is used for."""

    def __init__(self, design: JointDesign, data: Samples, noise: Noise) -> None:
        if data.bend_angle is None:
            raise CalibrationError('there is no measured bend angle in the data')
        self.noise = noise
        self.tension_l = _floats(data.tension_l)
        self.tension_s = _floats(data.tension_s)
        self.bend_angle = _floats(data.bend_angle)
        count = len(self.tension_l)
        missing = np.full(count, math.nan)
        self.pressure = missing if data.pressure is None else _floats(data.pressure)
        self.states_are_known = data.state is not None
        state = [SLIPPING] * count if data.state is None else data.state
        self.roles = self._roles(design, np.array(state, dtype=object), noise.bend_angle)
        self.slipping = self.roles == SLIPPING
        self.held = self.roles == HELD
        self.with_pressure = self.slipping & np.isfinite(self.pressure)
        names, counts = np.unique(self.roles, return_counts=True)
        self.counts = {SLIPPING: 0, 'with pressure': int(self.with_pressure.sum()), HELD: 0}
        self.counts |= {str(name): int(number) for name, number in zip(names, counts, strict=True)}
        if not self.slipping.any():
            unused = ', '.join(f'{n} {name}' for name, n in self.counts.items() if n)
            raise CalibrationError(
                f'none of {count} samples is known to be slipping and can be used ({unused})'
            )

    def _roles(
        self, design: JointDesign, state: NDArray[np.object_], bend_angle_stddev: float
    ) -> NDArray[np.str_]:
        """State of every sample, or why it cannot be used."""
        total = self.tension_l + self.tension_s
        weak = np.minimum(self.tension_l, self.tension_s)
        strong = np.maximum(self.tension_l, self.tension_s)
        stop = design.max_bend_angle
        angle = abs(self.bend_angle)
        # Later ones are stronger.
        reasons = {
            'of no known state': (state != SLIPPING) & (state != HELD),
            'at the stop': angle >= stop - 3.0 * bend_angle_stddev,
            'beyond the stop': angle > stop + 3.0 * bend_angle_stddev,
            'without an angle': ~np.isfinite(self.bend_angle),
            'below the weight': ~(total > design.weight),
            'slack': weak == 0.0,
            'of invalid tensions': ~((weak >= 0.0) & (strong <= MAX_TENSION)),
        }
        roles = np.where(state == SLIPPING, SLIPPING, HELD).astype('<U24')
        for reason, holds in reasons.items():
            roles[holds] = reason
        return roles

    def distance(self, design: JointDesign, of: NDArray[np.bool_]) -> BoundaryDistance:
        """Distance of some of the samples from the boundary of a design."""
        return boundary_distance(
            design,
            self.tension_l[of],
            self.tension_s[of],
            self.bend_angle[of],
            self.pressure[of],
            self.noise,
        )


def _floats(values: ArrayLike) -> Floats:
    return np.atleast_1d(np.asarray(values, dtype=np.float64))


class _Problem:
    """The least-squares problem in parameters that are scaled to about 1."""

    def __init__(
        self, design: JointDesign, parameters: list[DesignParameter], samples: _Samples
    ) -> None:
        self._design, self._parameters, self._samples = design, parameters, samples
        start = np.array([getattr(design, parameter.name) for parameter in parameters])
        widths = np.array([parameter.maximum - parameter.minimum for parameter in parameters])
        self._scale = np.where(start != 0.0, abs(start), 1e-3 * widths)
        self.start = start / self._scale
        self.bounds = (
            np.array([parameter.minimum for parameter in parameters]) / self._scale,
            np.array([self._largest(parameter) for parameter in parameters]) / self._scale,
        )

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

    def residuals(self, scaled: Floats) -> Floats:
        """Equations of the slipping samples, then what held ones lie beyond the boundary.

        They are NaN where there is no such design, from which the search turns back.
        """
        held = self._distance(scaled, self._samples.held).standardised
        return np.concatenate([self._equations(scaled), np.maximum(held, 0.0)])

    def _equations(self, scaled: Floats) -> Floats:
        samples = self._samples
        distance = self._distance(scaled, samples.slipping)
        measured = samples.with_pressure[samples.slipping]
        return np.concatenate([distance.standardised, distance.pressure_standardised[measured]])

    def _distance(self, scaled: Floats, of: NDArray[np.bool_]) -> BoundaryDistance:
        try:
            return self._samples.distance(self._design_at(scaled), of)
        except DesignError:
            return BoundaryDistance(*(np.full((4, int(of.sum())), math.nan)))

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
                self._parameters, (scaled * self._scale).tolist(), strict=True
            )
        }
        return dataclasses.replace(self._design, **values)

    def _jacobian(self, scaled: Floats) -> Floats:
        """Derivatives of the equations by the scaled parameters, from central differences."""
        columns = []
        for index, value in enumerate(scaled):
            ends = np.stack([scaled, scaled])
            step = 1e-5 * max(abs(value), 1.0)
            low, high = (bound[index] for bound in self.bounds)
            ends[:, index] = max(value - step, low), min(value + step, high)
            change = self._equations(ends[1]) - self._equations(ends[0])
            columns.append(change / (ends[1, index] - ends[0, index]))
        jacobian: Floats = np.nan_to_num(np.stack(columns, axis=1))
        return jacobian

    def result(self, scaled: Floats) -> Calibration:
        """Work out what is to be said of a solution."""
        samples, names = self._samples, [parameter.name for parameter in self._parameters]
        equations = self._equations(scaled)
        identification = identify(self._jacobian(scaled), equations)
        errors = identification.standard_errors * self._scale
        design = self._design_at(scaled)
        fitted = tuple(
            FittedParameter(
                name,
                getattr(design, name),
                getattr(self._design, name),
                None if math.isnan(error) else float(error),
            )
            for name, error in zip(names, errors, strict=True)
        )
        residuals = self._statistics(scaled, equations)
        low, high = (bound * self._scale for bound in self.bounds)
        ranges = list(zip(self._parameters, low.tolist(), high.tolist(), strict=True))
        used = samples.slipping | samples.held
        everywhere = self._distance(scaled, np.full(len(used), True))
        return Calibration(
            start=self._design,
            design=design,
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

    def _statistics(self, scaled: Floats, equations: Floats) -> ResidualStatistics:
        held = self._distance(scaled, self._samples.held).standardised
        sizes = abs(equations)
        return ResidualStatistics(
            root_mean_square=float(np.sqrt(np.mean(equations**2))),
            median=float(np.median(sizes)),
            largest=float(sizes.max()),
            outliers=int((sizes > 3.0).sum()),
            degrees_of_freedom=len(equations) - len(scaled),
            held_violations=int((held > 3.0).sum()),
        )
