"""A way from tensions to an estimate: the interface of those that ``estimation`` names."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Any, ClassVar, Generic, TypeVar

from ..physics import JointDesign
from .estimate import Estimate, Sample
from .measuring import Measuring
from .settings import Settings

S = TypeVar('S', bound=Measuring)
E = TypeVar('E')


class WayOfEstimating(ABC, Generic[S, E]):
    """Says of each set of tensions where what they move is; those with memory know where it was.

    What they move is one unit, see `Method`, or an arm.

    Parameters
    ----------
    settings : Settings
        Those to begin with.

    Raises
    ------
    BendAngleError
        If what is remembered cannot begin where it is said to.
    """

    remembers: ClassVar[bool]
    """Whether it knows where the unit was, so that it can be told, and can doubt it"""

    def __init__(self, settings: S) -> None:
        self.settings = settings

    @classmethod
    def refusal(cls, _settings: S) -> str:
        """Return why it cannot work with settings, for the user; empty if it can."""
        return ''

    @abstractmethod
    def update(self, sample: Sample) -> E:
        """Take a set of tensions; the unit may move.

        Raises
        ------
        TensionError
            If they do not seat a joint.
        """

    @abstractmethod
    def imagine(self, sample: Sample) -> E:
        """As `update`, but the unit stays as it was.

        Raises
        ------
        TensionError
            As `update` does.
        """

    def again(self, sample: Sample) -> E:
        """Work out the newest tensions again with the settings of now; the unit stays.

        Raises
        ------
        TensionError
            As `update` does.
        """
        return self.imagine(sample)

    def change_settings(self, settings: S) -> str:
        """Go on with other settings; return what is to be said of the unit, mostly nothing."""
        self.settings = settings
        return ''

    # Of those with memory

    def doubt(self) -> None:
        """Take it that the unit may have moved unseen."""
        return

    def put(self, _place: Any) -> None:
        """Put the unit to an angle in rad, or the arm to its angles, where it is for sure.

        Raises
        ------
        BendAngleError
            If one is not a number or beyond the stop; it then stays.
        """
        return

    def measure(self, bend_angle: Any) -> None:
        """Take an angle in rad that a sensor says; of an arm by joint.

        Raises
        ------
        BendAngleError
            As `put` does.
        """
        self.put(bend_angle)

    def take_committed(self) -> list[E]:
        """Return the estimates that will not be taken back, each once, where others may be.

        Those that the newest sample has committed.
        """
        return []


Method = WayOfEstimating[Settings, Estimate]
"""One for a single unit"""


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
