"""An angle that is measured now and then: what it is, and whether it moves."""

from __future__ import annotations

import math
from collections import deque

MOTION_TIME = 0.5
"""s over which the measured angle is looked at for motion: both its halves have to see it, which
sorts out a jump, in which friction does not balance what drives the unit"""

MOTION_DEVIATIONS = 3.0 * math.sqrt(2.0)
"""Deviations of the angle by which two of it differ where the unit moves: noise alone does so to
one side once in 700, and seldom in both halves"""


class MeasuredAngle:
    """The bend angle of one joint, as a sensor has told it lately.

    While it moves steadily, friction is at its limit to the side to which it does.
    """

    def __init__(self) -> None:
        self._angles: deque[tuple[float, float]] = deque()

    def note(self, bend_angle: float, now: float) -> None:
        """Take an angle in rad, at a time in s."""
        angles = self._angles
        angles.append((now, bend_angle))
        while len(angles) > 2 and angles[1][0] <= now - MOTION_TIME:
            angles.popleft()

    def forget(self) -> None:
        """Forget what was measured."""
        self._angles.clear()

    def newest(self, now: float, timeout: float) -> float | None:
        """Return the newest in rad, unless it is older than a time in s."""
        if not self._angles:
            return None
        at, angle = self._angles[-1]
        return angle if now - at <= timeout else None

    def motion(self, now: float, stddev: float, timeout: float) -> str:
        """Return the cable towards which it moves, ``s`` or ``l``; empty if it does not."""
        angles = self._angles
        if len(angles) < 3 or angles[0][0] < now - timeout:
            return ''
        (_, first), (newest_at, last) = angles[0], angles[-1]
        halfway = newest_at - 0.5 * MOTION_TIME
        middle = next((angle for at, angle in reversed(angles) if at <= halfway), first)
        steps, least = (middle - first, last - middle), MOTION_DEVIATIONS * stddev
        if min(steps) > least:
            return 's'
        return 'l' if max(steps) < -least else ''
