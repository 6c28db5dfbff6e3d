"""Draws of what is uncertain, the same each time: no answer hangs on chance."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator

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
