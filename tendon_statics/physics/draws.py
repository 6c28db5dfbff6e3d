"""Draws of what is uncertain, the same each time: no answer hangs on chance."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from .design import JointDesign, design_parameters
from .design_uncertainty import DesignUncertainty
from .errors import DesignError

Floats = NDArray[np.float64]


def draw_normals(count: int, variables: int, seed: int = 0) -> Floats:
    """Return standard normals, each variable in its own order through even quantiles.

    A Latin hypercube: any one variable is spread more evenly than chance would have it.

    Returns
    -------
    ndarray
        Shape ``(variables, count)``.
    """
    from statistics import NormalDist

    random = np.random.default_rng(seed)
    scores = np.array([NormalDist().inv_cdf((rank + 0.5) / count) for rank in range(count)])
    return np.array([random.permutation(scores) for _ in range(variables)]).reshape(-1, count)


@lru_cache(maxsize=4)
def even_normals(count: int, variables: int) -> Floats:
    """Return standard normals that fill the space of all variables evenly, through a lattice.

    The first goes through even quantiles. Each step along it takes the others on by powers of the
    golden ratio, or of what that is in more variables (Roberts, "The unreasonable effectiveness of
    quasirandom sequences", 2018), which leaves no gaps. As long as variables are few, an average
    over so many is as exact as one over five times as many of `draw_normals`.

    Returns
    -------
    ndarray
        Shape ``(variables, count)``; kept, and so not to be changed.
    """
    from statistics import NormalDist

    ratio = 1.0
    for _ in range(64):
        ratio = (1.0 + ratio) ** (1.0 / variables)
    steps = [1.0 / count, *(ratio**-power for power in range(1, variables))]
    places = np.outer(steps, np.arange(count) + 0.5) % 1.0
    normals = np.array([NormalDist().inv_cdf(place) for place in places.flat])
    normals = normals.reshape(places.shape)
    normals.setflags(write=False)
    return normals


def draw_designs(
    design: JointDesign, uncertainty: DesignUncertainty, normals: Floats
) -> Iterator[JointDesign]:
    """Yield designs with the uncertain parameters drawn; kept within what a design may be.

    Parameters
    ----------
    normals : ndarray
        Shape ``(parameters, count)``.
    """
    names = uncertainty.parameters
    ranges = {parameter.name: parameter for parameter in design_parameters()}
    values, vectors = np.linalg.eigh(np.array(uncertainty.covariance))
    changes = vectors @ (np.sqrt(np.clip(values, 0.0, None))[:, None] * normals)
    for change in changes.T:
        drawn = {
            name: min(max(getattr(design, name) + by, ranges[name].minimum), ranges[name].maximum)
            for name, by in zip(names, change.tolist(), strict=True)
        }
        try:
            yield dataclasses.replace(design, **drawn)
        except DesignError:  # together they are no design
            yield design
