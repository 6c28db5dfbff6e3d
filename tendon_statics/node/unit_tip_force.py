"""The force at the tip of a unit, on its node."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from ..estimation.tip_force_watch import TipForceWatch
from ..physics import LoadError, TipForce, tip_force
from .tip_force import Line, TipForces

if TYPE_CHECKING:
    from .estimator import Estimator

# The interfaces may be missing, or older than the node.
try:
    from tendon_statics_interfaces.srv import SolveTipForce
except ImportError:
    SolveTipForce = None


class UnitTipForces(TipForces):
    """The forces along a line at a distance along the unit's axis."""

    service = SolveTipForce
    _node: Estimator
    _watch: TipForceWatch

    def __init__(self, node: Estimator) -> None:
        super().__init__(node, TipForceWatch())

    def note_angle(self, bend_angle: float) -> None:
        """Take a measured angle in rad.

        Raises
        ------
        BendAngleError
            If it is not a number or lies beyond the stop.
        """
        self._watch.note_angle(bend_angle, time.monotonic(), self._node.core.settings)

    @property
    def _line(self) -> Line:
        settings = self._node.core.settings
        return settings.tip_direction, settings.tip_distance

    def _answer(self, request: Any) -> TipForce:
        settings = self._node.core.settings
        direction, distance = tuple(map(float, request.direction)), request.tip_distance
        if not any(direction):
            if distance:
                raise LoadError(
                    f'tip_distance is {distance!r} m, but direction is 0, which asks for the line '
                    'of the node: give the direction too'
                )
            direction, distance = self._line
        return tip_force(
            settings.design,
            request.tension_l,
            request.tension_s,
            bend_angle=request.bend_angle,
            direction=direction,
            distance=distance,
            load=self._node.known_load().load,
            tension_stddev=settings.tension_stddev,
            bend_angle_stddev=settings.measured_bend_angle_stddev,
            design_covariance=settings.design_uncertainty,
            level=settings.tip_force_level,
            slipping=request.slipping,
            at_stop=request.at_stop,
        )
