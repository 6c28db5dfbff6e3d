"""Stick and slip of an arm under noise: where it is, as many possible arms; see docs/arm.md."""

from .arm_filter import ArmFilter
from .state import ArmFilterState

__all__ = ['ArmFilter', 'ArmFilterState']
