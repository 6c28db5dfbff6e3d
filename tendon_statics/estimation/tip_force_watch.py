"""What pushes at the tip of one unit over time, from what is measured of its angle."""

from __future__ import annotations

import math
from collections import deque
from typing import Any, NamedTuple

from ..physics import (
    BendAngleError,
    Equilibrium,
    Regime,
    TipForce,
    tip_force,
    tip_force_of_state,
)
from ..physics.admissible import check_bend_angle
from ..physics.tip_force_state import StateUnderNoise, stddev_of_angle
from .settings import Settings

MOTION_TIME = 0.5
"""s over which the measured angle is looked at for motion: both its halves have to see it, which
sorts out a jump, in which friction does not balance what drives the unit"""

MOTION_DEVIATIONS = 3.0 * math.sqrt(2.0)
"""Deviations of the angle by which two of it differ where the unit moves: noise alone does so to
one side once in 700, and seldom in both halves"""


class Pushed(NamedTuple):
    """What is known of the tip force, and with which angle."""

    found: TipForce
    bend_angle: float
    """rad"""
    bend_angle_stddev: float
    """rad"""
    is_measured: bool
    """Whether the angle was measured; an estimated one takes the tip force for known"""


class TipForceWatch:
    """Asks of each state what pushes at the tip, with the newest measured angle.

    While the measured angle moves steadily, friction is at its limit to the side to which it does.
    Without a measured angle, or where the newest is older than the input timeout, the estimated
    one has to do.
    """

    def __init__(self) -> None:
        self._angles: deque[tuple[float, float]] = deque()

    def note_angle(self, bend_angle: float, now: float, settings: Settings) -> None:
        """Take a measured angle in rad.

        Raises
        ------
        BendAngleError
            If it is not a number or lies beyond the stop.
        """
        angle = check_bend_angle(settings.design, bend_angle)
        angles = self._angles
        angles.append((now, angle))
        while len(angles) > 2 and angles[1][0] <= now - MOTION_TIME:
            angles.popleft()

    def forget(self) -> None:
        """Forget what was measured."""
        self._angles.clear()

    def motion(self, now: float, settings: Settings) -> str:
        """Return the cable towards which the measured angle moves, empty if it does not."""
        angles = self._angles
        if len(angles) < 3 or angles[0][0] < now - settings.input_timeout:
            return ''
        (_, first), (newest_at, last) = angles[0], angles[-1]
        halfway = newest_at - 0.5 * MOTION_TIME
        middle = next((angle for at, angle in reversed(angles) if at <= halfway), first)
        least = MOTION_DEVIATIONS * settings.measured_bend_angle_stddev
        steps = middle - first, last - middle
        if min(steps) > least:
            return 's'
        return 'l' if max(steps) < -least else ''

    def ask(
        self, state: Equilibrium | StateUnderNoise, settings: Settings, now: float
    ) -> Pushed | None:
        """Return what a state tells of the tip force; None where it tells nothing.

        That is while a cable is slack, and without an angle or one that is assured.
        """
        if state.regime is Regime.SLACK:
            return None
        angle, stddev = self._measured(now, settings), settings.measured_bend_angle_stddev
        asked: dict[str, Any] = {
            'direction': settings.tip_direction,
            'distance': settings.tip_distance,
            'tension_stddev': settings.tension_stddev,
            'bend_angle_stddev': stddev,
            'design_covariance': settings.design_uncertainty,
            'level': settings.tip_force_level,
        }
        slipping = '' if angle is None else self.motion(now, settings)
        if angle is not None and slipping and abs(angle) < settings.design.max_bend_angle:
            found = tip_force(
                state.design,
                state.tension_l,
                state.tension_s,
                load=state.load,
                bend_angle=angle,
                slipping=slipping,
                **asked,
            )
            return Pushed(found, angle, stddev, is_measured=True)
        try:
            found = tip_force_of_state(state, bend_angle=angle, **asked)
        except BendAngleError:
            return None
        if angle is not None:
            return Pushed(found, angle, stddev, is_measured=True)
        assert state.bend_angle is not None
        own_stddev = stddev_of_angle(state, settings.tension_stddev)
        return Pushed(found, state.bend_angle, own_stddev, is_measured=False)

    def _measured(self, now: float, settings: Settings) -> float | None:
        """Return the newest measured angle in rad, unless it is too old."""
        if not self._angles:
            return None
        at, angle = self._angles[-1]
        within = abs(angle) <= settings.design.max_bend_angle  # whose stop may have changed
        return angle if now - at <= settings.input_timeout and within else None
