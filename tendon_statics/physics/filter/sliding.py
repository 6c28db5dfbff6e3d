"""A unit that has slipped and is pushed on: it is on the boundary of slip all the time."""

from __future__ import annotations

import math

from .scores import Boundary, Excess, Reading, Score

RECEDED = 2.0
"""Errors of the drive by which it is less than before, above which it no longer pushes the unit"""


class Slide:
    """Adds up where the boundary is seen from a slip on, until the drive recedes or a stop comes.

    A unit that has slipped lies where the hardest drive has pushed it. While no drive was harder
    than the newest, its angle is the root of the slip function, however fast it slides and
    whether or not it still does. What is not quite as hard counts once a harder drive follows, so
    that noise neither picks the readings nor ends a rest.

    Parameters
    ----------
    boundary : Boundary
    side : float
        To which it slipped.
    place : float
        Angle in rad at which drives are compared.
    hardest : float
        Hardest drive in N before it was seen to leave.
    """

    def __init__(self, boundary: Boundary, side: float, place: float, hardest: float) -> None:
        self._boundary, self._side, self._place = boundary, side, place
        self._hardest = hardest
        self._sure: Excess | None = None
        self._pending: Excess | None = None
        self._last: Reading | None = None
        self._score: Score | None = None
        self._pushes = True

    def take(self, reading: Reading) -> None:
        """Take what comes after the slip, whether the angle was measured or not."""
        if not self._pushes:
            return
        drive, error = self._boundary.push(reading, self._place, self._side)
        at_stop = self._boundary.is_at_stop(reading, self._side)
        if at_stop or drive < self._hardest - RECEDED * error:
            self._pushes = False
            return
        angle = reading.bend_angle
        if not math.isnan(angle):
            found = self._boundary.excess(reading, angle, reading.stddev, self._side)
            self._pending = found if self._pending is None else self._pending.plus(found)
            self._last = reading
        if drive >= self._hardest:
            self._hardest = drive
            if self._pending is not None:
                sure = self._sure
                self._sure = self._pending if sure is None else sure.plus(self._pending)
                self._pending = self._score = None

    @property
    def score(self) -> Score | None:
        """How far from the boundary it was in the mean; None while nothing is known."""
        if self._score is None and self._sure is not None and self._last is not None:
            last = self._last
            self._score = self._boundary.score(self._sure, last, last.bend_angle, self._side)
        return self._score
