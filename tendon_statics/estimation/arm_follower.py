"""An arm, from the readings of its load cells to where its joints are and how sure that is."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..physics import BendAngleError
from .arm_estimate import ArmEstimate
from .arm_settings import ArmSettings
from .arm_tracking import ArmTracking
from .estimate import KnownLoad, Sample
from .health import Health
from .method import WayOfEstimating
from .reading_estimator import ReadingEstimator

ARM_METHODS: dict[str, type[WayOfEstimating[ArmSettings, ArmEstimate]]] = {'tracking': ArmTracking}
"""Name → the way from tensions to an estimate of an arm; the first is the default"""


class ArmFollower(ReadingEstimator[ArmSettings, ArmEstimate]):
    """Says of each set of tensions where the joints of an arm are; see `ReadingEstimator`.

    Parameters
    ----------
    estimation : str
        Of `ARM_METHODS`.
    health : Health
        Counts what becomes of the readings; its own, if none is given.

    Raises
    ------
    BendAngleError
        If the joints cannot begin at their initial angles.
    """

    def __init__(
        self, settings: ArmSettings, estimation: str = 'tracking', health: Health | None = None
    ) -> None:
        method = ARM_METHODS[estimation](settings)
        names = tuple(f'the tension of {cable}' for cable in settings.arm.cable_names)
        super().__init__(settings, method, names, health)

    def put_back(self, now: float) -> str:
        """Put the joints to where they began; return where that is, for people."""
        start = self.settings.start
        self._method.put(start)
        self._told_at = now
        return f'the joints are at {", ".join(f"{angle:.6g}" for angle in start)} rad'

    def imagine(self, tensions: tuple[float, ...], known: KnownLoad) -> ArmEstimate:
        """Work out where tensions in N would take the arm from where it is; it stays.

        Raises
        ------
        TensionError, ArmError
            If they do not seat a joint, or the arm is not followed to rest.
        """
        return self._method.imagine(Sample(tensions, known, math.nan))

    def measure(self, bend_angles: Mapping[int, float], now: float) -> list[BendAngleError]:
        """Take angles in rad that sensors say, by the joint, counted from 1 at the base.

        Returned is why some are of no use: not a number, or beyond the stop.
        """
        faults = []
        for joint, angle in bend_angles.items():
            try:
                self._method.measure({joint: angle})
            except BendAngleError as error:
                faults.append(error)
        if len(bend_angles) - len(faults) == len(self.settings.arm.units):
            self._told_at = now  # Of the other joints nobody vouches.
        return faults
