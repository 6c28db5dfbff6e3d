"""What `compare_laws` gives back."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from .experiments import Advice
from .fit_warnings import SIGNIFICANT
from .result import Calibration

RATIO = 1000.0
"""How many times as likely the data have to be under one law so that another is ruled out"""


@dataclasses.dataclass(frozen=True, eq=False)
class LawFit:
    """One law, with its best values."""

    law: str
    calibration: Calibration | None
    """None if it could not be fitted"""
    failure: str = ''
    """Why not"""
    is_applicable: bool = True
    """Whether the law is made for such a unit at all"""
    loss: float = math.inf
    """−2 log of the likelihood, but for a constant that all laws share"""
    parameter_count: int = 0
    """Parameters that the data determine"""
    difference: float = math.inf
    """By how much Akaike's criterion exceeds that of the best law"""

    @property
    def ratio(self) -> float:
        """How many times as likely the data are under the best law, parameters counted."""
        return math.exp(min(0.5 * self.difference, 700.0))

    @property
    def is_ruled_out(self) -> bool:
        """Whether that is too many times."""
        return self.ratio >= RATIO

    def as_dict(self) -> dict[str, Any]:
        """Return it without the arrays of samples, ready for JSON."""
        return {
            'law': self.law,
            'is_applicable': self.is_applicable,
            'failure': self.failure,
            'loss': _finite(self.loss),
            'parameter_count': self.parameter_count,
            'difference': _finite(self.difference),
            'is_ruled_out': self.is_ruled_out,
            'calibration': None if self.calibration is None else self.calibration.as_dict(),
        }


@dataclasses.dataclass(frozen=True, eq=False)
class LawComparison:
    """The result of `compare_laws`."""

    fits: tuple[LawFit, ...]
    """The best first"""
    noise_scale: float
    """The noise for which they are compared, as a multiple of the stated"""
    equations: int
    """To which each was fitted"""
    advice: tuple[Advice, ...]
    """What would tell the laws apart that the data do not"""

    @property
    def best(self) -> LawFit:
        """That under which the data are likeliest, whether or not they tell it."""
        return self.fits[0]

    @property
    def possible(self) -> list[str]:
        """Laws that the data do not rule out."""
        return [fit.law for fit in self.fits if fit.is_applicable and not fit.is_ruled_out]

    @property
    def meets_data(self) -> bool:
        """Whether the best law explains the data with the stated noise."""
        best = self.best.calibration
        return best is not None and best.residuals.significance <= SIGNIFICANT

    @property
    def told(self) -> str | None:
        """The law that the data tell; None if they do not."""
        if len(self.possible) == 1 and self.meets_data:
            return self.possible[0]
        return None

    @property
    def statement(self) -> str:
        """What the data say of the laws, in words."""
        best = self.best.calibration
        if best is None:
            return 'no law could be fitted, so the data tell none'
        if not self.meets_data:
            return (
                'the data tell no law: even under the best of them, '
                f'{self.best.law}, they scatter {best.residuals.scale:.2g} times as much as the '
                'stated noise explains; a state, a sign or a value that is not fitted is wrong, '
                'or the noise is larger than stated'
            )
        out = [fit for fit in self.fits if fit.is_applicable and fit.is_ruled_out]
        others = ' and '.join(fit.law for fit in out)
        if self.told is not None:
            if not out:
                return f'only {self.told} is made for this unit, so the data are not asked'
            least = min(fit.ratio for fit in out)
            return (
                f'the data tell {self.told}: they are {_likely(least)} under it as under '
                f'{others}, each with its best values'
            )
        apart = ', '.join(self.possible[:-1]) + f' and {self.possible[-1]}'
        second = next(fit for fit in self.fits[1:] if fit.law == self.possible[1])
        return (
            f'the data cannot tell {apart} apart: they are {_likely(second.ratio)} under '
            f'{self.best.law} as under {second.law}, each with its best values, and '
            f'{RATIO:g} times as likely would be needed'
            + (f'; they rule out {others}' if out else '')
        )

    def as_dict(self) -> dict[str, Any]:
        """Return the result without the arrays of samples, ready for JSON."""
        return {
            'told': self.told,
            'possible': self.possible,
            'statement': self.statement,
            'advice': [one.text for one in self.advice],
            'noise_scale': self.noise_scale,
            'equations': self.equations,
            'laws': [fit.as_dict() for fit in self.fits],
        }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _likely(ratio: float) -> str:
    """A likelihood ratio as a person reads it."""
    if ratio < 1.05:
        return 'as likely'
    times = f'{ratio:.2g}' if ratio < 1e6 else 'more than a million'
    return f'{times} times as likely'
