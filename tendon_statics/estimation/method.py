"""A way from tensions to an estimate: the interface of those that ``estimation`` names."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import ClassVar

from ..physics import JointDesign
from .estimate import Estimate, Sample
from .settings import Settings


class Method(ABC):
    """Says of each pair of tensions where the unit is; those with memory know where it was.

    Parameters
    ----------
    settings : Settings
        Those to begin with.

    Raises
    ------
    BendAngleError
        If a unit that is remembered cannot begin at its initial angle.
    """

    remembers: ClassVar[bool]
    """Whether it knows where the unit was, so that it can be told, and can doubt it"""

    def __init__(self, settings: Settings) -> None:
        self.settings = settings

    @classmethod
    def refusal(cls, _settings: Settings) -> str:
        """Return why it cannot work with settings, for the user; empty if it can."""
        return ''

    @abstractmethod
    def update(self, sample: Sample) -> Estimate:
        """Take a pair of tensions; the unit may move.

        Raises
        ------
        TensionError
            If they do not seat the joint.
        """

    @abstractmethod
    def imagine(self, sample: Sample) -> Estimate:
        """As `update`, but the unit stays as it was.

        Raises
        ------
        TensionError
            As `update` does.
        """

    def again(self, sample: Sample) -> Estimate:
        """Work out the newest tensions again with the settings of now; the unit stays.

        Raises
        ------
        TensionError
            As `update` does.
        """
        return self.imagine(sample)

    def change_settings(self, settings: Settings) -> str:
        """Go on with other settings; return what is to be said of the unit, mostly nothing."""
        self.settings = settings
        return ''

    # Of those with memory

    def doubt(self) -> None:
        """Take it that the unit may have moved unseen."""
        return

    def put(self, _bend_angle: float) -> None:
        """Put the unit to an angle in rad, where it is for sure.

        Raises
        ------
        BendAngleError
            If it is not a number or beyond the stop; the unit then stays.
        """
        return

    def measure(self, bend_angle: float) -> None:
        """Take an angle in rad that a sensor says.

        Raises
        ------
        BendAngleError
            As `put` does.
        """
        self.put(bend_angle)

    def take_committed(self) -> list[Estimate]:
        """Return the estimates that will not be taken back, each once, where others may be.

        Those that the newest sample has committed.
        """
        return []


def within_stop(bend_angle: float, design: JointDesign) -> tuple[float, str]:
    """Return an angle in rad within the stops of a new design, and what is to be said of that."""
    stop = design.max_bend_angle
    if abs(bend_angle) <= stop:
        return bend_angle, ''
    stopped = math.copysign(stop, bend_angle)
    return stopped, (
        f'The unit was at {bend_angle:.6g} rad, beyond the new stop; it is now taken to be at '
        f'{stopped:.6g} rad'
    )
