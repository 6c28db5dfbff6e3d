"""One unit, from the readings of its load cells to where it is and how sure that is.

It needs no ROS: the node feeds it with messages, a replay with samples. An arm would have a list
of them. Times are in s on any one clock that only goes forward.
"""

from __future__ import annotations

import copy
import math
import time
from typing import NamedTuple

from ..physics import Equilibrium, Load, StickSlipTracker, TensionError, solve
from ..tensions.cable_scale import scaled, worse
from ..tensions.reason import Fault, ReadingError, Reason
from ..tensions.watch import PairWatch
from .health import Health
from .settings import Settings


class KnownLoad(NamedTuple):
    """What acts on the unit beside its cables, as far as it is known."""

    load: Load
    is_assured: bool = True
    """Whether all of it is of the present"""
    is_measured: bool = True
    """False while a sensor that is to tell it has said nothing at all"""


class Newest(NamedTuple):
    """The newest valid tensions."""

    tension_l: float
    """N, 0 of a slack cable, as `tension_s`"""
    tension_s: float
    known: KnownLoad
    time: float
    """s"""


class UnitEstimator:
    """Says of each pair of tensions where the unit is, and remembers what casts doubt on it.

    With a tracker the unit may have moved unseen after whatever cannot vouch for it: a slack
    cable, a sample that is no pair of tensions, a gap in time, a load that is not known. Its
    angle is then not assured until a stop, or until somebody says where it is. Before the first
    tensions it is where it began.

    Parameters
    ----------
    estimation : str
        ``equilibrium``: each pair by itself; ``tracking``: with a `StickSlipTracker`.
    health : Health
        Counts what becomes of the readings; its own, if none is given.

    Raises
    ------
    BendAngleError
        If a tracked unit cannot begin at its initial angle.
    """

    def __init__(
        self, settings: Settings, estimation: str = 'equilibrium', health: Health | None = None
    ) -> None:
        self.health = Health() if health is None else health
        self.newest: Newest | None = None
        self.invalid_since_newest = 0
        self._settings = settings
        self._watch = PairWatch()
        self._told_at = -math.inf  # when somebody last said where the unit is
        self._tracker: StickSlipTracker | None = None
        if estimation == 'tracking':
            self._tracker = StickSlipTracker(settings.design, settings.initial_bend_angle)

    @property
    def settings(self) -> Settings:
        """What it computes with."""
        return self._settings

    @property
    def is_tracking(self) -> bool:
        """Whether it remembers where the unit was."""
        return self._tracker is not None

    def change_settings(self, settings: Settings) -> str:
        """Go on with other settings; return what is to be said of the unit, mostly nothing."""
        before, self._settings = self._settings, settings
        if settings.scales != before.scales:  # What was watched was in other newtons.
            self._watch = PairWatch()
        if self._tracker is None or settings.design == before.design:
            return ''
        angle = self._tracker.bend_angle
        self._tracker.change_design(settings.design)
        if self._tracker.bend_angle == angle:
            return ''
        return (
            f'The unit was at {angle:.6g} rad, beyond the new stop; it is now taken to be at '
            f'{self._tracker.bend_angle:.6g} rad'
        )

    # Readings

    def take(
        self,
        reading_l: float,
        reading_s: float,
        known: KnownLoad,
        now: float,
        measured: float = math.nan,
    ) -> Equilibrium:
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
    ) -> Equilibrium:
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
            result = self._followed(tension_l, tension_s, known)
        except ReadingError as error:
            raise self._refused((error.reason, str(error))) from None
        except TensionError as error:
            raise self._refused((Reason.BELOW_WEIGHT, str(error))) from None
        self.health.note_result(result, time.monotonic() - begin, load_assured=known.is_assured)
        self.newest = Newest(tension_l, tension_s, known, now)
        self.invalid_since_newest = 0
        return result

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

    def _followed(self, tension_l: float, tension_s: float, known: KnownLoad) -> Equilibrium:
        """Work out where the unit goes; under a load that may be wrong nothing of it is sure."""
        tracker = self._tracker
        if tracker is None or known.is_assured:
            return self._result(tracker, tension_l, tension_s, known.load)
        if not known.is_measured:  # The unit stays where it began until the load is known.
            tracker = copy.copy(tracker)
        result = self._result(tracker, tension_l, tension_s, known.load)
        tracker.doubt()
        return result._replace(angle_assured=False)

    def _result(
        self, tracker: StickSlipTracker | None, tension_l: float, tension_s: float, load: Load
    ) -> Equilibrium:
        if tracker is None:
            return solve(self._settings.design, tension_l, tension_s, load)
        return tracker.update(tension_l, tension_s, load)

    # Where the unit is, by other means

    def lose_sight(self) -> None:
        """Take it that the unit may move unseen; before the first tensions it does not."""
        if self.newest is not None:
            self.doubt()

    def doubt(self) -> None:
        """Take it that a tracked unit may have moved."""
        if self._tracker is not None:
            self._tracker.doubt()

    def put(self, bend_angle: float, now: float) -> None:
        """Put a tracked unit to an angle in rad that was measured.

        Raises
        ------
        BendAngleError
            If it is not a number or beyond the stop; the unit then stays.
        """
        if self._tracker is not None:
            self._tracker.reset(bend_angle)
            self._told_at = now

    def again(self, newest: Newest) -> Equilibrium:
        """Work out the newest tensions again with the settings of now; the unit stays.

        Raises
        ------
        TensionError
            If they do not seat the joint of now.
        """
        return self._result(
            copy.copy(self._tracker), newest.tension_l, newest.tension_s, newest.known.load
        )

    # Staleness

    def stale_from(self, watched_since: float) -> float:
        """When the input gets stale if no more tensions come; never once it is."""
        if self.health.stale:
            return math.inf
        newest = -math.inf if self.newest is None else self.newest.time
        return max(newest, watched_since) + self._settings.input_timeout
