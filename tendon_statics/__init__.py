"""Bend angle and joint pressure of a tendon-driven unit from its cable tensions."""

from .design_file import default_design_path, load_design
from .physics import (
    DesignError,
    Equilibrium,
    JointDesign,
    Regime,
    TensionError,
    solve,
)

__all__ = [
    'DesignError',
    'Equilibrium',
    'JointDesign',
    'Regime',
    'TensionError',
    'default_design_path',
    'load_design',
    'solve',
]
