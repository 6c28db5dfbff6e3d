"""Why a message, or a sample of a recording, gives no tensions."""

from __future__ import annotations

from enum import Enum

from ..physics.errors import TendonStaticsError


class Reason(str, Enum):
    """Why a message was dropped."""

    WRONG_LENGTH = 'wrong length'
    NOT_FINITE = 'not finite'
    NEGATIVE = 'negative'
    IMPLAUSIBLE = 'implausible'
    TOO_FAST = 'too fast'
    SATURATED = 'saturated'
    FROZEN = 'frozen'
    BELOW_WEIGHT = 'below the weight'
    NOT_FOLLOWED = 'not followed'
    OUT_OF_ORDER = 'out of order'
    REPEATED_STAMP = 'repeated stamp'
    UNPAIRED = 'unpaired'

    @property
    def is_of_content(self) -> bool:
        """Whether the message holds no tensions of use, and not only comes at the wrong time."""
        return self not in (Reason.OUT_OF_ORDER, Reason.REPEATED_STAMP, Reason.UNPAIRED)


Fault = tuple[Reason, str]
"""Why there are no tensions, and the same in a sentence for people"""


class ReadingError(TendonStaticsError, ValueError):
    """A reading that gives no tensions of the unit, or arm; the text is for the user."""

    def __init__(self, reason: Reason, text: str) -> None:
        super().__init__(text)
        self.reason = reason
