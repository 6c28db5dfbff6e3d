"""One step of a Rosenbrock method for stiff equations θ' = f(θ); no physics.

RODAS3 of Sandu, Verwer, Blom, Spee, Carmichael and Potra, "Benchmarking stiff ODE solvers for
atmospheric chemistry problems II: Rosenbrock solvers", Atmospheric Environment 31 (1997): four
stages, order 3 with an embedded order 2, stable for any step. A step without end is one of
Newton's.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def rosenbrock_step(
    velocity: Callable[[Floats], Floats], at_start: Floats, jacobian: Floats, step: float
) -> tuple[Floats, Floats]:
    """Return the way of one step, and an estimate of its error.

    Parameters
    ----------
    velocity : callable
        f at a way from the start.
    at_start : array
        f at the start.
    jacobian : array
        ∂f/∂θ there.
    step : float

    Raises
    ------
    numpy.linalg.LinAlgError
        If the step happens to be one that the method cannot take; any shorter one will do.
    """
    size = len(at_start)
    inverse = np.linalg.inv(np.eye(size) * (2.0 / step) - jacobian)
    first = inverse @ at_start
    second = inverse @ (at_start + (4.0 / step) * first)
    way = 2.0 * first
    third = inverse @ (velocity(way) + (first - second) / step)
    way = way + third
    last = inverse @ (velocity(way) + (first - second - (8.0 / 3.0) * third) / step)
    return way + last, last


def cubic_path(way: Floats, at_start: Floats, at_end: Floats) -> Callable[[float], Floats] | None:
    """Return the way up to a part of a step, by a cubic; None where that is not how it went.

    Parameters
    ----------
    way : array
        Of the whole step.
    at_start, at_end : array
        The velocities there, times the step.
    """
    if max(abs(at_start).max(), abs(at_end).max()) > 3.0 * abs(way).max():
        return None

    def path(part: float) -> Floats:
        rest = 1.0 - part
        ahead: Floats = part * part * (3.0 - 2.0 * part) * way
        return ahead + part * rest * (rest * at_start - part * at_end)

    return path
