"""Many pairs of cable tensions at once, as NumPy arrays."""

from .results import INVALID, REGIME_CODES, EquilibriumBatch
from .solver import solve_batch

__all__ = ['INVALID', 'REGIME_CODES', 'EquilibriumBatch', 'solve_batch']
