"""Stick and slip under noise: where a unit is, as a distribution; see docs/filter.md."""

from .state import FilterState
from .stick_slip_filter import StickSlipFilter

__all__ = ['FilterState', 'StickSlipFilter']
