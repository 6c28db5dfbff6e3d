"""Which contact law the data speak for, if they speak for one.

Each law is fitted to the same equations, with the same parameters free. Its likelihood is that of
its best values: −2 log of it is the sum of losses, with the noise of the law that fits best, which
is the stated one or more. Laws are compared by Akaike's criterion, that sum plus twice the number
of parameters that the data determine. A law is ruled out if the data are `RATIO` times as likely,
parameters counted, under the best one; and the best one is told only if it meets the data and all
others are ruled out.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

from ..contact import CONTACT_LAWS
from ..design import JointDesign
from ..deviations import BEND_ANGLE_STDDEV, TENSION_STDDEV
from ..errors import CalibrationError, DesignError
from ..load import UPRIGHT, Load
from .experiments import advice
from .fit import DEFAULT_FIT, checked_noise, settled
from .law_comparison import RATIO, LawComparison, LawFit
from .measured import Samples
from .parameters import Model, ParameterSpace, checked_fit
from .problem import Problem
from .samples import SortedSamples
from .summary import calibration_of

UNKNOWN_WIDTH = 1.0
"""m; a `contact_width` that only says that it is not known, as no joint of this size has it"""


def compare_laws(
    design: JointDesign,
    data: Samples,
    fit: Sequence[str] = DEFAULT_FIT,
    *,
    tension_stddev: float = TENSION_STDDEV,
    bend_angle_stddev: float = BEND_ANGLE_STDDEV,
    pressure_stddev: float | None = None,
    load: Load = UPRIGHT,
    with_advice: bool = True,
) -> LawComparison:
    """Fit every contact law to the same samples, and say which of them the data speak for.

    Parameters are those of `calibrate`. Values that are not fitted are taken as right, so what is
    not known should be fitted. Where a pressure is measured and the design's `contact_width` is
    1 m, which stands for one that is not known, it is fitted too for the laws whose pressure
    depends on it.

    Parameters
    ----------
    with_advice : bool
        Whether to work out what would tell the laws apart that the data do not.

    Raises
    ------
    CalibrationError
        As `calibrate` does, but for a search that does not settle for some law.
    ImportError
        Without SciPy.
    """
    checked_fit(fit)
    noise = checked_noise(tension_stddev, bend_angle_stddev, pressure_stddev, data.pressure)
    designs, fits = {}, []
    for law in CONTACT_LAWS:
        try:
            designs[law] = dataclasses.replace(design, contact_law=law)
        except DesignError as error:
            fits.append(LawFit(law, None, str(error), is_applicable=False))
    samples = SortedSamples(design, data, noise, load, others=list(designs.values()))
    solutions: dict[str, list[Problem]] = {}
    for law, start in designs.items():
        parameters = checked_fit(_fitted_with(start, fit, samples))
        try:
            solutions[law] = settled(ParameterSpace(Model(start), parameters, samples), samples)
        except CalibrationError as error:
            fits.append(LawFit(law, None, str(error)))
    if not solutions:
        raise CalibrationError(
            'no contact law could be fitted: '
            + '; '.join(f'{failed.law}: {failed.failure}' for failed in fits)
        )
    scale = min(found[0].noise_scale for found in solutions.values())
    problems = {law: _best_at(found, scale) for law, found in solutions.items()}
    criterion = {
        law: problem.loss() + 2.0 * problem.identification().rank
        for law, problem in problems.items()
    }
    least = min(criterion.values())
    for law, problem in problems.items():
        calibration = calibration_of(*_first_and_rest(solutions[law]))
        fits.append(
            LawFit(
                *(law, calibration),
                loss=problem.loss(),
                parameter_count=problem.identification().rank,
                difference=criterion[law] - least,
            )
        )
    fits.sort(key=lambda fitted: fitted.difference)
    compared = LawComparison(tuple(fits), scale, len(problems[fits[0].law].equations()), ())
    if not (with_advice and compared.meets_data and len(compared.possible) > 1):
        return compared
    possible = [problems[law] for law in compared.possible]
    needed = 2.0 * math.log(RATIO)
    return dataclasses.replace(compared, advice=tuple(advice(possible, needed)))


def _fitted_with(design: JointDesign, fit: Sequence[str], samples: SortedSamples) -> list[str]:
    """What is fitted with a law: a contact width where it is unknown, and only where it counts."""
    radius = design.ball_radius
    counts = design.law.contact_area(radius, 1.0) != design.law.contact_area(radius, 2.0)
    names = [name for name in ([fit] if isinstance(fit, str) else fit) if name != 'contact_width']
    unknown = design.contact_width == UNKNOWN_WIDTH and bool(samples.with_pressure.any())
    return [*names, 'contact_width'] if counts and (unknown or len(names) < len(fit)) else names


def _best_at(found: Sequence[Problem], scale: float) -> Problem:
    """Return the best of some solutions for another scale of the noise."""
    moved = []
    for problem in found:
        again = Problem(problem.space, problem.samples, problem.scaled)
        again.noise_scale = scale
        try:
            again.search()
        except CalibrationError:
            again.scaled = problem.scaled
        moved.append(again)
    return min(moved, key=lambda problem: problem.loss())


def _first_and_rest(found: Sequence[Problem]) -> tuple[Problem, Sequence[Problem]]:
    return found[0], found[1:]
