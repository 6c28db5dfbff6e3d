"""Which faults a stand-in for a motor driver makes on purpose, and how often."""

from __future__ import annotations

import dataclasses
import enum
import math
from typing import Any

from .parameter_kinds import NumberParameter, SettingError

IMPLAUSIBLE_TENSION = 1e6
"""N; the height of a spike"""


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
    NumberParameter(field.name, is_fixed=True, **field.metadata)
    for field in dataclasses.fields(FaultSettings)
)


def fault_parameters() -> tuple[NumberParameter, ...]:
    """Meaning, unit and range of every field of `FaultSettings`, in its order."""
    return _PARAMETERS
