"""Bend angle and joint pressure of a tendon-driven unit from its cable tensions."""

from typing import TYPE_CHECKING, Any

from . import physics
from .design_file import default_design_path, load_design
from .physics import (
    DesignError,
    Equilibrium,
    JointDesign,
    Regime,
    TensionError,
    solve,
)

if TYPE_CHECKING:
    from .physics import EquilibriumBatch, solve_batch

__all__ = [
    'DesignError',
    'Equilibrium',
    'EquilibriumBatch',
    'JointDesign',
    'Regime',
    'TensionError',
    'default_design_path',
    'load_design',
    'solve',
    'solve_batch',
]


def __getattr__(name: str) -> Any:
    if name in ('EquilibriumBatch', 'solve_batch'):
        return getattr(physics, name)
    raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
