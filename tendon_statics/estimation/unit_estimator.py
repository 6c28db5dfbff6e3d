"""One unit, from the readings of its load cells to where it is and how sure that is.

It needs no ROS: the node feeds it with messages, a replay with samples. An arm would have a list
of them. Times are in s on any one clock that only goes forward.
"""

from __future__ import annotations

import math
import time

from ..physics import TensionError
from ..tensions.cable_scale import scaled, worse
from ..tensions.reason import Fault, ReadingError, Reason
from ..tensions.watch import PairWatch
from .estimate import Estimate, KnownLoad, Sample
from .health import Health
from .methods import METHODS
from .settings import Settings


class UnitEstimator:
    """Says of each pair of tensions where the unit is, and remembers what casts doubt on it.

    A unit that is remembered may have moved unseen after whatever cannot vouch for it: a slack
    cable, a sample that is no pair of tensions, a gap in time, a load that is not known. Its
    angle is then not assured until a stop, or until somebody says where it is. Before the first
    tensions it is where it began.

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
        self.health = Health() if health is None else health
        self.newest: Sample | None = None
        self.invalid_since_newest = 0
        self._settings = settings
        self._watch = PairWatch()
        self._told_at = -math.inf  # when somebody last said where the unit is
        self._method = METHODS[estimation](settings)

    @property
    def settings(self) -> Settings:
        """What it computes with."""
        return self._settings

    @property
    def remembers(self) -> bool:
        """Whether it remembers where the unit was."""
        return self._method.remembers

    def change_settings(self, settings: Settings) -> str:
        """Go on with other settings; return what is to be said of the unit, mostly nothing."""
        before, self._settings = self._settings, settings
        self._watch.rescale(before.scales, settings.scales)
        return self._method.change_settings(settings)

    # Readings

    def take(
        self,
        reading_l: float,
        reading_s: float,
        known: KnownLoad,
        now: float,
        measured: float = math.nan,
    ) -> Estimate:
        """Take what the load cells say, in their own units; the rest is as in `take_tensions`."""
        of_l, of_s = self._settings.scales
        tension_l, fault_l = scaled('tension_l', reading_l, of_l)
        tension_s, fault_s = scaled('tension_s', reading_s, of_s)
        if fault_l or fault_s:
            raise self._refused(worse(fault_l, fault_s))
        return self.take_tensions(tension_l, tension_s, known, now, measured)

    def take_tensions(
        self,
        tension_l: float,
        tension_s: float,
        known: KnownLoad,
        now: float,
        measured: float = math.nan,
    ) -> Estimate:
        """Take a pair of tensions in N, within their limits; return where the unit is.

        Parameters
        ----------
        known : KnownLoad
            What acts beside them.
        now : float
            The present, in s.
        measured : float
            When they were measured, on any clock in s; NaN if that is not known.

        Raises
        ------
        ReadingError
            If they are not plausible, or together do not seat the joint.
        """
        self._doubt_after_gap(now)
        settings = self._settings
        begin = time.monotonic()
        try:
            tension_l, tension_s = self._watch.take(
                (tension_l, tension_s), measured, settings.scales, settings.plausibility
            )
            sample = Sample(tension_l, tension_s, known, now, measured, self._watch.is_confirmed)
            estimate = self._followed(sample)
        except ReadingError as error:
            raise self._refused((error.reason, str(error))) from None
        except TensionError as error:
            raise self._refused((Reason.BELOW_WEIGHT, str(error))) from None
        self.health.note_estimate(estimate, time.monotonic() - begin)
        self.newest = sample
        self.invalid_since_newest = 0
        return estimate

    def drop(self, reason: Reason, text: str) -> None:
        """Count what gives no pair of tensions; if its content is at fault, the unit may move."""
        self.health.note_drop(reason, text)
        if reason.is_of_content:
            self.invalid_since_newest += 1
            self.lose_sight()

    def _refused(self, fault: Fault | None) -> ReadingError:
        assert fault is not None
        self.drop(*fault)
        return ReadingError(*fault)

    def _doubt_after_gap(self, now: float) -> None:
        if self.newest is not None:
            vouched = max(self.newest.time, self._told_at)
            if not now - vouched <= self._settings.input_timeout:
                self.lose_sight()

    def _followed(self, sample: Sample) -> Estimate:
        """Work out where the unit goes; under a load that may be wrong nothing of it is sure."""
        method, known = self._method, sample.known
        if method.remembers and not (known.is_measured and sample.is_confirmed):
            # The unit stays where it is until the load is known, and the tensions are no spike.
            return method.imagine(sample)
        estimate = method.update(sample)
        if not known.is_assured:
            method.doubt()
        return estimate

    def take_committed(self) -> list[Estimate]:
        """Return the estimates that will not be taken back, each once, where others may be."""
        return self._method.take_committed()

    # Where the unit is, by other means

    def lose_sight(self) -> None:
        """Take it that the unit may move unseen; before the first tensions it does not."""
        if self.newest is not None:
            self.doubt()

    def doubt(self) -> None:
        """Take it that a unit that is remembered may have moved."""
        self._method.doubt()

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

    def again(self, newest: Sample) -> Estimate:
        """Work out the newest tensions again with the settings of now; the unit stays.

        Raises
        ------
        TensionError
            If they do not seat the joint of now.
        """
        return self._method.again(newest)

    # Staleness

    def stale_from(self, watched_since: float) -> float:
        """When the input gets stale if no more tensions come; never once it is."""
        if self.health.stale:
            return math.inf
        newest = -math.inf if self.newest is None else self.newest.time
        return max(newest, watched_since) + self._settings.input_timeout
