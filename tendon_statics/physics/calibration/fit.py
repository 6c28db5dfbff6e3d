"""From a recorded session to a design that fits it, with the uncertainty of every value."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..contact import CONTACT_LAWS
from ..design import JointDesign
from ..deviations import BEND_ANGLE_STDDEV, TENSION_STDDEV
from ..errors import CalibrationError
from ..load import UPRIGHT, Load
from .boundary_distance import Noise
from .measured import Samples
from .parameters import Model, ParameterSpace, checked_fit
from .problem import Problem
from .result import Calibration
from .samples import SortedSamples, as_floats
from .summary import AS_GOOD, calibration_of

DEFAULT_FIT = ('mass', 'cable_offset', 'friction_coefficient')

TENSION_STDDEVS = (1e-9, 1e3)
BEND_ANGLE_STDDEVS = (0.0, 1.0)
PRESSURE_STDDEVS = (1e-9, 1e15)
"""Ranges of standard deviations that are taken, in N, rad and Pa"""

NEAR = 0.05
"""Relative difference of all values up to which two solutions are one"""

FRICTIONS = (0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.2)
"""Friction coefficients that are tried as starts beside the design's"""


def calibrate(
    design: JointDesign,
    data: Samples,
    fit: Sequence[str] = DEFAULT_FIT,
    *,
    tension_stddev: float = TENSION_STDDEV,
    bend_angle_stddev: float = BEND_ANGLE_STDDEV,
    pressure_stddev: float | None = None,
    load: Load = UPRIGHT,
    contact_law: str | None = None,
) -> Calibration:
    """Fit parameters of a unit to samples in which it slips or is held.

    A slipping sample lies on the boundary of slip, which is an equation; with a measured pressure
    it is two. A hold, that is held samples at one angle, is an inequality: it counts only as far
    as it lies beyond the boundary by more than noise explains. Every distance is in units of its
    own noise, with that of tensions, angle and pressure taken to first order (see
    `boundary_distance`), and enters by a soft L1 loss, so that outliers do not rule the fit.
    Values stay within the ranges of `fit_parameters`.

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
        Names of design parameters, and ``gain_l``, ``gain_s``, ``bias_l``, ``bias_s`` of the load
        cells: the true tension is gain · tension + bias.
    tension_stddev : float
        Standard deviation of each measured tension in N.
    bend_angle_stddev : float
        Standard deviation of the measured angle in rad.
    pressure_stddev : float, optional
        Standard deviation of the measured pressure in Pa; by default 2 % of the median.
    load : Load
        What acts beside the cables; what `data` has of base tilt and tip force comes first.
    contact_law : str, optional
        Law to fit instead of the design's.

    Raises
    ------
    CalibrationError
        If `fit` names no parameter or an unknown one, there is no such law, there is no angle, it
        is not known which samples are slipping or none of them can be used, a deviation is not
        valid, or the search does not settle.
    DesignError
        If the law is not made for the design.
    ImportError
        Without SciPy.
    """
    parameters = checked_fit(fit)
    noise = checked_noise(tension_stddev, bend_angle_stddev, pressure_stddev, data.pressure)
    if contact_law is not None:
        if contact_law not in CONTACT_LAWS:
            raise CalibrationError(
                f'contact_law is {contact_law!r}, there are {", ".join(CONTACT_LAWS)}'
            )
        design = dataclasses.replace(design, contact_law=contact_law)
    samples = SortedSamples(design, data, noise, load)
    space = ParameterSpace(Model(design), parameters, samples)
    best, *others = settled(space, samples)
    return calibration_of(best, others)


def settled(space: ParameterSpace, samples: SortedSamples) -> list[Problem]:
    """Fit from the start and, with a friction coefficient, from others; the best comes first.

    A law may hold as much with one coefficient as with another, so that there may be two
    solutions. The others that are tried are those of `FRICTIONS` at which the sum of losses has a
    valley.

    Raises
    ------
    CalibrationError
        If none of the searches settles.
    """
    problems = [Problem(space, samples)]
    if 'friction_coefficient' in space.names:
        tried = [
            Problem(space, samples, space.starting_at('friction_coefficient', friction))
            for friction in FRICTIONS
        ]
        losses = np.nan_to_num([problem.loss() for problem in tried], nan=math.inf)
        walls = np.concatenate([[math.inf], losses, [math.inf]])
        is_valley = np.isfinite(losses) & (losses <= walls[:-2]) & (losses < walls[2:])
        problems += [tried[place] for place in np.flatnonzero(is_valley)]
    explored: list[Problem] = []
    failure = None
    for problem in problems:
        try:
            if len(problems) > 1:
                problem.search(roughly=True)
        except CalibrationError as error:
            failure = failure or error
            continue
        if not any(np.allclose(problem.scaled, other.scaled, rtol=NEAR) for other in explored):
            explored.append(problem)
    explored.sort(key=Problem.loss)
    found: list[Problem] = []
    for problem in explored:
        # With more noise than stated, losses are smaller and nearer to each other.
        if found and problem.loss() > found[0].noise_scale ** 2 * (found[0].loss() + AS_GOOD):
            break
        try:
            found.append(problem.settle())
        except CalibrationError as error:
            failure = failure or error
    if failure is not None and not found:
        raise failure
    return sorted(found, key=lambda problem: (round(problem.noise_scale, 2), problem.loss()))


def checked_noise(
    tension: float, bend_angle: float, pressure: float | None, pressures: ArrayLike | None
) -> Noise:
    """Return the standard deviations of what is measured.

    Raises
    ------
    CalibrationError
        If one is not allowed.
    """
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
