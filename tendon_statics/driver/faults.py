"""Faults of a motor driver, made on purpose: which one befalls which message, and what it does."""

from __future__ import annotations

import itertools
import math
import random
from bisect import bisect
from typing import NamedTuple

from ..files.fault_settings import IMPLAUSIBLE_TENSION, STAMP_FAULTS, Fault, FaultSettings

LAG = 1_000_000
"""ns; how much earlier than the newest sound message one that is out of order says to be"""


class Reading(NamedTuple):
    """What the driver says at one time."""

    tensions: tuple[float, ...]
    """Of each cable in N"""
    stamp: int
    """ns"""
    fault: Fault
    cable: int
    """the one that the fault befalls, if it befalls one, counted from 0"""


class FaultMaker:
    """Makes readings out of tensions, one after the other.

    Which fault befalls the k-th reading depends on the settings and on k only.

    Parameters
    ----------
    cables
        How many there are.
    """

    def __init__(self, settings: FaultSettings, cables: int = 2) -> None:
        self._settings = settings
        self._cables = cables
        self._faults = [fault for fault in Fault if settings.probability(fault) > 0.0]
        self._bounds = list(itertools.accumulate(map(settings.probability, self._faults)))
        self._random = random.Random(settings.seed)
        # Of its own, so that more noise is not other faults.
        self._noise = random.Random(f'noise {settings.seed}')
        self._episode: tuple[Fault, int] = (Fault.NONE, 0)
        self._left_of_episode = 0
        self._now: int | None = None
        self._stamp = 0
        self._newest_sound: int | None = None

    def reading(self, tensions: tuple[float, ...], now: int) -> Reading:
        """Return the next reading.

        Parameters
        ----------
        tensions
            True ones of all cables in N.
        now
            Time in ns. Readings at one and the same time get stamps 1 ns apart.
        """
        fault, cable = self._next_fault()
        values = [self._noisy(tension) for tension in tensions]
        if fault is Fault.NAN_BURST:
            values[cable] = math.nan
        elif fault is Fault.SLACK:
            values[cable] = 0.0
        elif fault is Fault.IMPLAUSIBLE:
            values[cable] = IMPLAUSIBLE_TENSION
        stamp = self._next_stamp(now)
        if self._newest_sound is not None:
            if fault is Fault.OUT_OF_ORDER:
                stamp = self._newest_sound - LAG
            elif fault is Fault.REPEATED_STAMP:
                stamp = self._newest_sound
        if fault in (Fault.NONE, Fault.SLACK):
            self._newest_sound = stamp
        return Reading(tuple(values), stamp, fault, cable)

    def _next_fault(self) -> tuple[Fault, int]:
        # Drawn in an episode too, so that its length does not change what comes after it.
        place, cable = (
            bisect(self._bounds, self._random.random()),
            self._random.randrange(self._cables),
        )
        if self._left_of_episode > 0:
            self._left_of_episode -= 1
            return self._episode
        fault = self._faults[place] if place < len(self._faults) else Fault.NONE
        if fault in STAMP_FAULTS and self._newest_sound is None:
            fault = Fault.NONE
        self._episode = fault, cable
        self._left_of_episode = self._settings.length(fault) - 1
        return self._episode

    def _next_stamp(self, now: int) -> int:
        # A simulated clock stands still while a batch is sent.
        self._stamp = self._stamp + 1 if now == self._now else now
        self._now = now
        return self._stamp

    def _noisy(self, tension: float) -> float:
        stddev = self._settings.noise_stddev
        return tension + self._noise.gauss(0.0, stddev) if stddev > 0.0 else tension
