"""What pushes at the tip of an arm over time, from what is measured of its angles."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..physics import BendAngleError, TensionError
from ..physics.arm import arm_tip_force_of_state
from .arm_estimate import ArmEstimate
from .arm_settings import ArmSettings
from .measured_angle import MeasuredAngle
from .tip_force_watch import Pushed


class ArmTipForceWatch:
    """Asks of each estimate what pushes at the tip, with the newest measured angles.

    As `TipForceWatch`, joint by joint. Of a joint whose angle was not measured lately the
    estimated one has to do, with its deviation.

    Parameters
    ----------
    count : int
        Of joints.
    """

    def __init__(self, count: int) -> None:
        self._angles = [MeasuredAngle() for _ in range(count)]

    def note_angles(
        self, bend_angles: Mapping[int, float], now: float, settings: ArmSettings
    ) -> None:
        """Take measured angles in rad by the joint, counted from 1; none that is not allowed."""
        for joint, angle in bend_angles.items():
            if abs(angle) <= settings.arm.stops[joint - 1]:  # never of a NaN
                self._angles[joint - 1].note(angle, now)

    def forget(self) -> None:
        """Forget what was measured."""
        for angle in self._angles:
            angle.forget()

    def measured(self, now: float, settings: ArmSettings) -> dict[int, float]:
        """Return the angles in rad that were measured lately, by the joint."""
        return {
            joint: angle
            for joint, of in enumerate(self._angles, start=1)
            if (angle := of.newest(now, settings.input_timeout)) is not None
        }

    def ask(self, estimate: ArmEstimate, settings: ArmSettings, now: float) -> Pushed | None:
        """Return what an estimate tells of the tip force; None where it tells nothing.

        That is while a cable is slack, and where of a joint there is no angle, measured lately or
        assured.
        """
        if estimate.state.is_slack:
            return None
        stddev, timeout = settings.measured_bend_angle_stddev, settings.input_timeout
        measured = self.measured(now, settings)
        is_measured = len(measured) == len(self._angles)
        if not (is_measured or estimate.is_sure):
            return None
        stops = settings.arm.stops
        slipping = {
            joint: side
            for joint, angle in measured.items()
            if (side := self._angles[joint - 1].motion(now, stddev, timeout))
            and abs(angle) < stops[joint - 1]
        }
        try:
            found = arm_tip_force_of_state(
                estimate.state,
                direction=settings.tip_direction,
                bend_angles=measured,
                bend_angle_stddev=stddev,
                # With angles measured, a state that has only begun to slip would agree.
                slipping=slipping if measured else None,
                tension_stddev=settings.tension_stddev,
                design_covariance=settings.design_uncertainties,
                level=settings.tip_force_level,
            )
        except (BendAngleError, TensionError):  # smoothed tensions may leave a joint slack
            return None
        return Pushed(found, math.nan, math.nan, is_measured=is_measured)
