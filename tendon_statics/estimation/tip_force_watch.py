"""What pushes at the tip of one unit over time, from what is measured of its angle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from ..physics import (
    BendAngleError,
    Equilibrium,
    Regime,
    TipForce,
    tip_force_of_state,
)
from ..physics.admissible import check_bend_angle
from ..physics.tip_force_state import StateUnderNoise, stddev_of_angle
from .measured_angle import MeasuredAngle
from .settings import Settings

if TYPE_CHECKING:
    from ..physics.arm import ArmTipForce


class Pushed(NamedTuple):
    """What is known of the tip force, and with which angle."""

    found: TipForce | ArmTipForce
    bend_angle: float
    """rad; NaN of an arm, which has several"""
    bend_angle_stddev: float
    """rad, likewise"""
    is_measured: bool
    """Whether the angle, or each of them, was measured; an estimated one takes the tip force for
    known"""


class TipForceWatch:
    """Asks of each state what pushes at the tip, with the newest measured angle.

    While the measured angle moves steadily, friction is at its limit to the side to which it does.
    Without a measured angle, or where the newest is older than the input timeout, the estimated
    one has to do.
    """

    def __init__(self) -> None:
        self._angle = MeasuredAngle()

    def note_angle(self, bend_angle: float, now: float, settings: Settings) -> None:
        """Take a measured angle in rad.

        Raises
        ------
        BendAngleError
            If it is not a number or lies beyond the stop.
        """
        self._angle.note(check_bend_angle(settings.design, bend_angle), now)

    def forget(self) -> None:
        """Forget what was measured."""
        self._angle.forget()

    def motion(self, now: float, settings: Settings) -> str:
        """Return the cable towards which the measured angle moves, empty if it does not."""
        return self._angle.motion(now, settings.measured_bend_angle_stddev, settings.input_timeout)

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
        slipping = None
        if angle is not None:  # With which a state that has only begun to slip would agree.
            is_free = abs(angle) < settings.design.max_bend_angle
            slipping = self.motion(now, settings) if is_free else ''
        try:
            found = tip_force_of_state(state, bend_angle=angle, slipping=slipping, **asked)
        except BendAngleError:
            return None
        if angle is not None:
            return Pushed(found, angle, stddev, is_measured=True)
        assert state.bend_angle is not None
        own_stddev = stddev_of_angle(state, settings.tension_stddev)
        return Pushed(found, state.bend_angle, own_stddev, is_measured=False)

    def _measured(self, now: float, settings: Settings) -> float | None:
        """Return the newest measured angle in rad, unless it is too old."""
        angle = self._angle.newest(now, settings.input_timeout)
        if angle is None or abs(angle) > settings.design.max_bend_angle:  # which may have changed
            return None
        return angle
