"""From the readings of load cells to where that is which their cables move, and how sure that is.

It needs no ROS: nodes feed it with messages, a replay with samples. Times are in s on any one
clock that only goes forward.
"""

from __future__ import annotations

import math
import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Generic, TypeVar

from ..physics import ArmError, TensionError
from ..tensions.cable_scale import scaled, worse
from ..tensions.reason import Fault, ReadingError, Reason
from ..tensions.watch import TensionWatch
from .estimate import AnyEstimate, KnownLoad, Sample
from .health import Health
from .measuring import Measuring
from .method import WayOfEstimating

S = TypeVar('S', bound=Measuring)
E = TypeVar('E', bound=AnyEstimate)


class ReadingEstimator(ABC, Generic[S, E]):
    """Says of each set of tensions where a unit or an arm is, and when that is in doubt.

    What is remembered may have moved unseen after whatever cannot vouch for it: a slack cable, a
    sample that is no set of tensions, a gap in time, a load that is not known. Its angles are then
    not assured until a stop, or until somebody says where they are. Before the first tensions it
    is where it began.

    Parameters
    ----------
    method : WayOfEstimating
        That works with the settings.
    names : tuple of str
        What the tensions are called, in the order of the readings.
    health : Health, optional
        Counts what becomes of the readings; its own, if none is given.
    """

    def __init__(
        self,
        settings: S,
        method: WayOfEstimating[S, E],
        names: tuple[str, ...],
        health: Health | None = None,
    ) -> None:
        self.health = Health() if health is None else health
        self.newest: Sample | None = None
        self.invalid_since_newest = 0
        self._settings = settings
        self._names = names
        self._watch = TensionWatch(names)
        self._told_at = -math.inf  # when somebody last said where it is
        self._method = method

    @property
    def settings(self) -> S:
        """What it computes with."""
        return self._settings

    @property
    def remembers(self) -> bool:
        """Whether it remembers where the unit was."""
        return self._method.remembers

    def change_settings(self, settings: S) -> str:
        """Go on with other settings; return what is to be said of that, mostly nothing."""
        before, self._settings = self._settings, settings
        self._watch.rescale(before.scales, settings.scales)
        return self._method.change_settings(settings)

    # Readings

    def take_readings(
        self,
        readings: Sequence[float],
        known: KnownLoad,
        arrived: float,
        measured: float = math.nan,
    ) -> E:
        """Take what the load cells say, in their own units; the rest is as in `take_sample`."""
        tensions, faults = [], []
        for name, reading, scale in zip(self._names, readings, self._settings.scales, strict=True):
            tension, fault = scaled(name, reading, scale)
            tensions.append(tension)
            if fault is not None:
                faults.append(fault)
        if faults:
            raise self._refused(worse(*faults))
        return self.take_sample(tensions, known, arrived, measured)

    def take_sample(
        self,
        tensions: Sequence[float],
        known: KnownLoad,
        arrived: float,
        measured: float = math.nan,
    ) -> E:
        """Take the tensions of all cables in N, within their limits; return what they mean.

        Parameters
        ----------
        known : KnownLoad
            What acts beside them.
        arrived : float
            When they came, in s of a steady clock.
        measured : float
            When they were measured, on any clock in s; NaN if that is not known.

        Raises
        ------
        ReadingError
            If they are not plausible, or together do not seat a joint.
        """
        self._doubt_after_gap(arrived)
        settings = self._settings
        begin = time.monotonic()
        try:
            believed = self._watch.take(tensions, measured, settings.scales, settings.plausibility)
            sample = Sample(believed, known, arrived, measured, self._watch.is_confirmed)
            estimate = self._followed(sample)
        except ReadingError as error:
            raise self._refused((error.reason, str(error))) from None
        except TensionError as error:
            raise self._refused((Reason.BELOW_WEIGHT, str(error))) from None
        except ArmError as error:
            raise self._refused((Reason.NOT_FOLLOWED, str(error))) from None
        self.health.note_estimate(estimate, time.monotonic() - begin)
        self.newest = sample
        self.invalid_since_newest = 0
        return estimate

    def drop(self, reason: Reason, text: str) -> None:
        """Count what gives no set of tensions; if its content is at fault, the unit may move."""
        self.health.note_drop(reason, text)
        if reason.is_of_content:
            self.invalid_since_newest += 1
            self.lose_sight()

    def _refused(self, fault: Fault | None) -> ReadingError:
        assert fault is not None
        self.drop(*fault)
        return ReadingError(*fault)

    def _doubt_after_gap(self, arrived: float) -> None:
        if self.newest is not None:
            vouched = max(self.newest.time, self._told_at)
            if not arrived - vouched <= self._settings.input_timeout:
                self.lose_sight()

    def _followed(self, sample: Sample) -> E:
        """Work out where it goes; under a load that may be wrong nothing of it is sure."""
        method, known = self._method, sample.known
        if method.remembers and not (known.is_measured and sample.is_confirmed):
            # It stays where it is until the load is known, and the tensions are no spike.
            return self._imagined(sample)
        estimate = method.update(sample)
        if not known.is_assured:
            method.doubt()
        return estimate

    def _imagined(self, sample: Sample) -> E:
        found = self._method.imagine(sample)
        found.is_confirmed = sample.is_confirmed
        return found

    def take_committed(self) -> list[E]:
        """Return the estimates that will not be taken back, each once, where others may be."""
        return self._method.take_committed()

    # Where it is, by other means

    @abstractmethod
    def put_back(self, now: float) -> str:
        """Put what is remembered to where it began; return where that is, for people."""

    def lose_sight(self) -> None:
        """Take it that it may move unseen; before the first tensions it does not."""
        if self.newest is not None:
            self.doubt()

    def doubt(self) -> None:
        """Take it that what is remembered may have moved."""
        self._method.doubt()

    def again(self, newest: Sample) -> E:
        """Work out the newest tensions again with the settings of now; nothing moves.

        Raises
        ------
        TensionError
            If they do not seat a joint of now.
        """
        found = self._method.again(newest)
        found.is_confirmed = newest.is_confirmed
        return found

    # Staleness

    def stale_from(self, watched_since: float) -> float:
        """When the input gets stale if no more tensions come; never once it is."""
        if self.health.stale:
            return math.inf
        newest = -math.inf if self.newest is None else self.newest.time
        return max(newest, watched_since) + self._settings.input_timeout
