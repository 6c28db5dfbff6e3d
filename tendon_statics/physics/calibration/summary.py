"""What is to be said of a fit that has settled."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .boundary_distance import BoundaryDistance
from .fit_warnings import calibration_warnings, other_solution
from .identifiability import Identification, scatter_scale, scatter_significance
from .problem import Problem
from .result import CONFIDENCE, Calibration, FittedParameter, ResidualStatistics

AS_GOOD = 6.0
"""Difference of two sums of losses up to which both solutions are to be considered: one is then at
most twenty times as likely as the other"""


def calibration_of(problem: Problem, others: Sequence[Problem] = ()) -> Calibration:
    """Work out what is to be said of the solution.

    Parameters
    ----------
    others : sequence of Problem
        Solutions that searches from other starts have come to.
    """
    space, samples = problem.space, problem.samples
    identification = problem.identification()
    residuals = _statistics(problem)
    fitted = _fitted(problem, identification, residuals)
    model = problem.model
    low, high = (bound * space.unit for bound in space.bounds)
    ranges = list(zip(space.parameters, low.tolist(), high.tolist(), strict=True))
    used = samples.slipping | samples.held
    everywhere = samples.distance(model, np.full(len(used), True))
    warnings = calibration_warnings(
        ranges,
        fitted,
        identification,
        residuals,
        samples.counts,
        states_are_known=samples.states_are_known,
    )
    for other in others:
        if abs(other.loss() - problem.loss()) < AS_GOOD and not len(
            identification.null_directions
        ):
            warnings.append(other_solution(space.names, other.scaled * space.unit))
    is_determined = all(value.value is not None for value in fitted)
    return Calibration(
        start=space.start_model.design,
        design=model.design if is_determined else None,
        cells=model.cells if is_determined else None,
        parameters=fitted,
        correlation=identification.correlation,
        residuals=residuals,
        noise=samples.noise,
        counts=samples.counts,
        warnings=tuple(warnings),
        roles=samples.roles,
        loads=samples.loads,
        distance=BoundaryDistance(*(np.where(used, a, math.nan) for a in everywhere)),
    )


def _fitted(
    problem: Problem, identification: Identification, residuals: ResidualStatistics
) -> tuple[FittedParameter, ...]:
    """Tell of each parameter what the data do."""
    space = problem.space
    errors = identification.standard_errors * space.unit
    half_widths = errors / problem.noise_scale * _interval_factor(residuals)
    ends = zip(*(bound * space.unit for bound in space.bounds), strict=True)
    fitted = []
    for parameter, error, half, (low, high) in zip(
        space.parameters, errors, half_widths, ends, strict=True
    ):
        start = space.start_model.value(parameter.name)
        if math.isnan(error):
            fitted.append(FittedParameter(parameter.name, start, None, None, None))
            continue
        value = problem.model.value(parameter.name)
        interval = max(value - float(half), float(low)), min(value + float(half), float(high))
        fitted.append(FittedParameter(parameter.name, start, value, float(error), interval))
    return tuple(fitted)


def _statistics(problem: Problem) -> ResidualStatistics:
    equations = problem.equations()
    degrees_of_freedom = problem.degrees_of_freedom()
    sizes = abs(equations)
    return ResidualStatistics(
        root_mean_square=float(np.sqrt(np.mean(equations**2))),
        median=float(np.median(sizes)),
        largest=float(sizes.max()),
        outliers=int((sizes > 3.0).sum()),
        degrees_of_freedom=degrees_of_freedom,
        scale=scatter_scale(equations, degrees_of_freedom),
        significance=scatter_significance(equations, degrees_of_freedom),
        hold_violations=int((problem.hold_excesses() > 0.0).sum()),
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
