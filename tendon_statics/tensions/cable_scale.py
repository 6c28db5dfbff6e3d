"""The tension of a cable from the reading of its load cell."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from .reason import Fault, Reason

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

ROUNDING = 1e-15
"""Relative error of a sum of two numbers that nearly cancel"""

DEFAULT_MAX_TENSION = 1000.0
"""N"""

SLACK_STDDEVS = 3.0
"""Standard deviations of the noise up to which a cable is slack, unless its threshold is given"""

RELEASE = 1.5
"""Times the threshold that a slack cable has to exceed to be taut again; as far below 0 a reading
is still one of a slack cable"""


class CableScale(NamedTuple):
    """How a cable's tension in N follows from a reading: gain * reading + bias."""

    gain: float = 1.0
    bias: float = 0.0
    max_tension: float = DEFAULT_MAX_TENSION
    """N; above it a tension is implausible"""
    slack_threshold: float = 0.0
    """N; up to it the cable is slack"""

    @property
    def is_identity(self) -> bool:
        """Whether readings are tensions in N."""
        return self.gain == 1.0 and self.bias == 0.0

    @property
    def is_limited(self) -> bool:
        """Whether somebody has said the largest plausible tension."""
        return self.max_tension != DEFAULT_MAX_TENSION

    @property
    def lowest(self) -> float:
        """Lowest reading in N of a slack cable; below it a tension is negative."""
        return -RELEASE * self.slack_threshold

    def with_noise(self, tension_stddev: float) -> CableScale:
        """Return the scale with a threshold that fits the noise in N, if it has none."""
        if self.slack_threshold > 0.0:
            return self
        return self._replace(slack_threshold=SLACK_STDDEVS * tension_stddev)


def scaled(name: str, reading: float, scale: CableScale) -> tuple[float, Fault | None]:
    """Return a reading as a tension in N, and what is against it.

    A tension of a slack cable may be a little below 0; what it then counts as, `SlackSwitch` says.
    """
    tension = scale.gain * reading + scale.bias
    if abs(tension) < ROUNDING * abs(scale.bias):  # of a slack cable
        tension = 0.0
    if scale.lowest <= tension <= scale.max_tension:
        return tension, None
    allowed = f'allowed is 0 to {scale.max_tension:g} N'
    if not math.isfinite(tension):
        reason = Reason.NOT_FINITE
    elif abs(tension) > scale.max_tension:
        reason = Reason.IMPLAUSIBLE
    else:
        reason = Reason.NEGATIVE
    return tension, (reason, f'{name} is {tension!r} N, {allowed}')


def worse(*faults: Fault | None) -> Fault | None:
    """Return which of the faults of two cables counts: the implausible one, since it is an error.

    The node's diagnostics and a replay count a pair once.
    """
    there = [fault for fault in faults if fault is not None]
    return max(there, key=lambda fault: fault[0] is Reason.IMPLAUSIBLE, default=None)


def scaled_arrays(
    readings: NDArray[np.float64], scale: CableScale
) -> tuple[NDArray[np.float64], NDArray[np.object_]]:
    """Return many readings as tensions in N, and the `Reason` against each, None for none.

    It is `scaled` over arrays.
    """
    import numpy as np

    with np.errstate(over='ignore', invalid='ignore'):
        tensions = scale.gain * readings + scale.bias
        tensions = np.where(abs(tensions) < ROUNDING * abs(scale.bias), 0.0, tensions)
    reasons = np.full(len(tensions), None, dtype=object)
    outside = ~((scale.lowest <= tensions) & (tensions <= scale.max_tension))
    reasons[outside] = Reason.NEGATIVE
    reasons[outside & (abs(tensions) > scale.max_tension)] = Reason.IMPLAUSIBLE
    reasons[~np.isfinite(tensions)] = Reason.NOT_FINITE
    return tensions, reasons
