"""One unit, from the readings of its load cells to where it is and how sure that is."""

from __future__ import annotations

import math

from .estimate import Estimate, KnownLoad
from .health import Health
from .methods import METHODS
from .reading_estimator import ReadingEstimator
from .settings import Settings


class UnitEstimator(ReadingEstimator[Settings, Estimate]):
    """Says of each pair of tensions where the unit is; see `ReadingEstimator`.

    Parameters
    ----------
    estimation : str
        Of `METHODS`.
    health : Health
        Counts what becomes of the readings; its own, if none is given.

    Raises
    ------
    BendAngleError
        If a unit that is remembered cannot begin at its initial angle.
    """

    def __init__(
        self, settings: Settings, estimation: str = 'equilibrium', health: Health | None = None
    ) -> None:
        method = METHODS[estimation](settings)
        super().__init__(settings, method, ('tension_l', 'tension_s'), health)

    def take(
        self,
        reading_l: float,
        reading_s: float,
        known: KnownLoad,
        arrived: float,
        measured: float = math.nan,
    ) -> Estimate:
        """Take what the load cells say, as `take_readings` does."""
        return self.take_readings((reading_l, reading_s), known, arrived, measured)

    def put_back(self, now: float) -> str:
        """Put a unit that is remembered to where it began; return where that is, for people."""
        angle = self.settings.initial_bend_angle
        self.put(angle, now)
        return f'the unit is at {angle:.6g} rad'

    def put(self, bend_angle: float, now: float) -> None:
        """Put a unit that is remembered to an angle in rad, where it is for sure.

        Raises
        ------
        BendAngleError
            If it is not a number or beyond the stop; the unit then stays.
        """
        self._method.put(bend_angle)
        self._told_at = now

    def measure(self, bend_angle: float, now: float) -> None:
        """Take an angle in rad that a sensor says.

        Raises
        ------
        BendAngleError
            As `put` does.
        """
        self._method.measure(bend_angle)
        self._told_at = now
