"""What can be wrong with the input of the physics."""

from __future__ import annotations


class DesignError(ValueError):
    """A joint design that cannot be used.

    Attributes
    ----------
    key : str
        The design parameter at fault; empty if the fault is not in a single one.
    """

    def __init__(self, message: str, *, key: str = '') -> None:
        super().__init__(message)
        self.key = key


class LoadError(ValueError):
    """A dead load that the model does not take."""


class TensionError(ValueError):
    """A pair of cable tensions that the model does not take."""


class BendAngleError(ValueError):
    """A bend angle that the unit cannot have."""


class UnreachableError(ValueError):
    """A bend angle and joint pressure that no pair of tensions gives."""


class CalibrationError(ValueError):
    """Data or parameters from which no design can be fitted."""
