"""Faults of a motor driver, made on purpose: which one befalls which message, and what it does."""

from __future__ import annotations

import dataclasses
import enum
import itertools
import math
import random
from bisect import bisect
from typing import Any, NamedTuple

from ..files.number_parameter import NumberParameter, SettingError

IMPLAUSIBLE_TENSION = 1e6
"""N; the height of a spike"""

LAG = 1_000_000
"""ns; how much earlier than the newest sound message one that is out of order says to be"""


class Fault(enum.Enum):
    """What befalls one message; a message has one fault at most, noise aside."""

    NONE = 'good'
    DROPOUT = 'dropout'
    NAN_BURST = 'nan_burst'
    OUT_OF_ORDER = 'out_of_order'
    REPEATED_STAMP = 'repeated_stamp'
    WRONG_LENGTH = 'wrong_length'
    SLACK = 'slack'
    IMPLAUSIBLE = 'implausible'


STAMP_FAULTS = (Fault.OUT_OF_ORDER, Fault.REPEATED_STAMP)
"""Those that a message without a stamp cannot have."""


def _field(default: float, minimum: float, maximum: float, unit: str, description: str) -> Any:
    metadata = {
        'default': default,
        'minimum': minimum,
        'maximum': maximum,
        'unit': unit,
        'description': description,
    }
    return dataclasses.field(default=default, metadata=metadata)


def _probability(description: str) -> Any:
    return _field(0.0, 0.0, 1.0, '', f'probability per message {description}')


def _length(default: int, description: str) -> Any:
    return _field(default, 1, 1_000_000, '', f'messages in {description}')


@dataclasses.dataclass(frozen=True)
class FaultSettings:
    """How often which fault befalls a message; nothing does by default.

    Raises
    ------
    SettingError
        If a value is not allowed, or the probabilities together exceed 1.
    """

    seed: int = _field(0, 0, 2**31 - 1, '', 'the same seed makes the same faults and noise')
    noise_stddev: float = _field(
        0.0, 0.0, 1000.0, 'N', 'standard deviation of normal noise on each tension'
    )
    dropout_probability: float = _probability('that it is not sent')
    nan_burst_probability: float = _probability('that one cable begins to give NaN')
    nan_burst_length: int = _length(10, 'a burst of NaN')
    out_of_order_probability: float = _probability(
        'that its stamp is earlier than that of the newest sound one before it'
    )
    repeated_stamp_probability: float = _probability(
        'that its stamp is that of the newest sound one before it'
    )
    wrong_length_probability: float = _probability('that one cable is missing in it')
    slack_probability: float = _probability('that one cable begins to have no tension')
    slack_length: int = _length(100, 'an episode of slack')
    implausible_probability: float = _probability(f'that one cable has {IMPLAUSIBLE_TENSION:g} N')

    def __post_init__(self) -> None:
        for parameter in fault_parameters():
            parameter.check(getattr(self, parameter.name))
        total = math.fsum(self.probability(fault) for fault in Fault)
        if total > 1.0:
            raise SettingError(
                f'the probabilities of faults are {total:.6g} together, allowed is at most 1, '
                'since a message has one fault at most'
            )

    def probability(self, fault: Fault) -> float:
        """Probability that a fault begins at a message; 0 for none."""
        return float(getattr(self, f'{fault.value}_probability', 0.0))

    def length(self, fault: Fault) -> int:
        """Messages that a fault lasts."""
        return int(getattr(self, f'{fault.value}_length', 1))


_PARAMETERS = tuple(
    NumberParameter(name=field.name, **field.metadata)
    for field in dataclasses.fields(FaultSettings)
)


def fault_parameters() -> tuple[NumberParameter, ...]:
    """Meaning, unit and range of every field of `FaultSettings`, in its order."""
    return _PARAMETERS


class Reading(NamedTuple):
    """What the driver says at one time."""

    tensions: tuple[float, float]
    """T_l and T_s in N"""
    stamp: int
    """ns"""
    fault: Fault
    cable: int
    """the one that the fault befalls, if it befalls one: 0 is cable l, 1 is cable s"""


class FaultMaker:
    """Makes readings out of tensions, one after the other.

    Which fault befalls the k-th reading depends on the settings and on k only.
    """

    def __init__(self, settings: FaultSettings) -> None:
        self._settings = settings
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

    def reading(self, tensions: tuple[float, float], now: int) -> Reading:
        """Return the next reading.

        Parameters
        ----------
        tensions
            True T_l and T_s in N.
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
        return Reading((values[0], values[1]), stamp, fault, cable)

    def _next_fault(self) -> tuple[Fault, int]:
        # Drawn in an episode too, so that its length does not change what comes after it.
        place, cable = bisect(self._bounds, self._random.random()), self._random.randrange(2)
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
