"""How well the parameters of a design are known: the covariance of some of them."""

from __future__ import annotations

import math
import numbers
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from .design import design_parameters
from .errors import DesignError, DesignMisfitError

ROUNDING = 1e-9
"""Share of a variance by which a covariance may fail to be one"""


@dataclass(frozen=True)
class DesignUncertainty:
    """Covariance of some of a design's parameters; the others are taken as exact.

    Parameters
    ----------
    parameters : sequence of str
        Names of k of `design_parameters`.
    covariance : sequence of sequence of float
        Shape ``(k, k)``, in the products of their SI units.

    Raises
    ------
    DesignError
        If a name is unknown or given twice, or the numbers are no covariance.
    DesignMisfitError
        If they are not as many as the parameters need.
    """

    parameters: tuple[str, ...]
    covariance: tuple[tuple[float, ...], ...]

    def __post_init__(self) -> None:
        names = tuple(self.parameters)
        check_names(names)
        rows = tuple(tuple(row) for row in self.covariance)
        if len(rows) != len(names) or any(len(row) != len(names) for row in rows):
            raise DesignMisfitError(
                f'covariance is not of {len(names)} rows of {len(names)} numbers, '
                f'as {len(names)} parameters need',
                key='covariance',
            )
        object.__setattr__(self, 'parameters', names)
        object.__setattr__(self, 'covariance', tuple(map(_numbers, rows)))
        _check_definite(self.covariance)

    @classmethod
    def of_flat(cls, parameters: Sequence[str], covariance: Sequence[float]) -> DesignUncertainty:
        """Return one from its covariance row by row, as a parameter file has it.

        Raises
        ------
        DesignError
            As the constructor does.
        """
        width = len(parameters)
        if len(covariance) != width * width:
            raise DesignMisfitError(
                f'covariance has {len(covariance)} numbers; {width} parameters need '
                f'{width * width}, row by row',
                key='covariance',
            )
        return cls(tuple(parameters), _rows(covariance, width))

    @property
    def flat(self) -> list[float]:
        """The covariance row by row."""
        return [value for row in self.covariance for value in row]

    def stddev(self, parameter: str) -> float:
        """Standard deviation of a parameter in SI; 0 for one that is taken as exact."""
        if parameter not in self.parameters:
            return 0.0
        place = self.parameters.index(parameter)
        return math.sqrt(self.covariance[place][place])

    def variance(self, derivatives: Mapping[str, float]) -> float:
        """Return the variance of what follows the parameters, to first order.

        Parameters
        ----------
        derivatives : mapping
            By each of the parameters; others are left alone.
        """
        slopes = [derivatives[name] for name in self.parameters]
        return sum(
            one * other * covariance
            for one, row in zip(slopes, self.covariance, strict=True)
            for other, covariance in zip(slopes, row, strict=True)
        )


def check_names(names: Sequence[str]) -> None:
    """Check that each name is of a design parameter, and none is there twice.

    Raises
    ------
    DesignError
        If not.
    """
    known = [parameter.name for parameter in design_parameters()]
    for name in names:
        if name not in known:
            raise DesignError(
                f'parameters has {name!r}, which is no design parameter; '
                f'there are {", ".join(known)}',
                key='parameters',
            )
        if names.count(name) > 1:
            raise DesignError(f'parameters has {name} twice', key='parameters')


def check_flat(covariance: Sequence[float]) -> None:
    """Check numbers row by row, of however many parameters, if they are as many as some need.

    Raises
    ------
    DesignError
        If they are no covariance.
    """
    width = math.isqrt(len(covariance))
    if covariance and width * width == len(covariance):
        _check_definite(_rows(covariance, width))


def _rows(flat: Sequence[float], width: int) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(flat[width * row : width * (row + 1)]) for row in range(width))


def _check_definite(rows: Sequence[Sequence[float]]) -> None:
    """Check that a matrix is symmetric and that no combination has a variance below 0.

    Raises
    ------
    DesignError
        If not.
    """
    import numpy as np  # Here, for who only solves should not wait for it.

    covariance = np.array(rows).reshape(len(rows), len(rows))
    scales = np.sqrt(np.clip(np.diag(covariance), 1e-300, None))
    correlation = covariance / np.outer(scales, scales)
    if not np.allclose(correlation, correlation.T, rtol=0.0, atol=ROUNDING):
        raise DesignError('covariance is not symmetric', key='covariance')
    least = np.linalg.eigvalsh(correlation).min(initial=0.0)
    if least < -ROUNDING * len(correlation):
        raise DesignError(
            'covariance gives a combination of the parameters a variance below 0',
            key='covariance',
        )


def _numbers(row: Sequence[object]) -> tuple[float, ...]:
    """Return finite floats.

    Raises
    ------
    DesignError
        If one is not a finite number.
    """
    found = []
    for value in row:
        is_number = isinstance(value, numbers.Real) and not isinstance(value, bool)
        if not is_number or not math.isfinite(value):  # type: ignore[arg-type]
            raise DesignError(
                f'covariance has {value!r}, a finite number is needed', key='covariance'
            )
        found.append(float(value))  # type: ignore[arg-type]
    return tuple(found)
