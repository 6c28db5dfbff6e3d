"""The base class of the package's errors, and what can be wrong with the input of the physics."""

from __future__ import annotations


class TendonStaticsError(Exception):
    """What the package raises itself: one line for a person, who can mend it.

    Every error of the package derives from it, and from `ValueError` too where a value is at
    fault. A `TypeError` is a call that no input makes right.
    """


class DesignError(TendonStaticsError, ValueError):
    """A joint design that cannot be used.

    Attributes
    ----------
    key : str
        The design parameter at fault; empty if the fault is not in a single one.
    """

    def __init__(self, message: str, *, key: str = '') -> None:
        super().__init__(message)
        self.key = key


class DesignMisfitError(DesignError):
    """Values of a design that do not fit together, though each is allowed by itself."""


class ArmError(TendonStaticsError, ValueError):
    """An arm that cannot be used, or what is asked of one.

    Attributes
    ----------
    key : str
        Where in the arm the fault is, say ``units[2].length``, counted from 1; empty if it is
        nowhere in particular.
    """

    def __init__(self, message: str, *, key: str = '') -> None:
        super().__init__(message)
        self.key = key


class LoadError(TendonStaticsError, ValueError):
    """A dead load that the model does not take."""


class TensionError(TendonStaticsError, ValueError):
    """A pair of cable tensions that the model does not take."""


class BendAngleError(TendonStaticsError, ValueError):
    """A bend angle that the unit cannot have."""


class UnreachableError(TendonStaticsError, ValueError):
    """A bend angle and joint pressure that no pair of tensions gives."""


class CalibrationError(TendonStaticsError, ValueError):
    """Data or parameters from which no design can be fitted."""
