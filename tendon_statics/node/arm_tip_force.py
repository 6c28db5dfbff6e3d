"""The force on the end of an arm, on its node."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..estimation.arm_tip_force_watch import ArmTipForceWatch
from ..physics import ArmError
from ..physics.arm import ArmTipForce, arm_tip_force
from .arm_services import asked_tensions
from .tip_force import Line, TipForces

if TYPE_CHECKING:
    from .arm_estimator import ArmEstimator

# The interfaces may be missing, or older than the node.
try:
    from tendon_statics_interfaces.srv import SolveArmTipForce
except ImportError:
    SolveArmTipForce = None


class ArmTipForces(TipForces):
    """The forces along a line that all joints explain."""

    service = SolveArmTipForce
    _node: ArmEstimator
    _watch: ArmTipForceWatch

    def __init__(self, node: ArmEstimator) -> None:
        super().__init__(node, ArmTipForceWatch(len(node.arm.units)))

    def note_angles(self, bend_angles: Mapping[int, float]) -> None:
        """Take measured angles in rad by the joint; those beyond a stop are told by the arm."""
        self._watch.note_angles(bend_angles, time.monotonic(), self._node.core.settings)

    @property
    def _line(self) -> Line:
        return self._node.core.settings.tip_direction, self._node.arm.units[-1].length

    def _answer(self, request: Any) -> ArmTipForce:
        settings, arm = self._node.core.settings, self._node.arm
        count = len(arm.units)
        for name in ('slipping', 'at_stop'):
            given = len(getattr(request, name))
            if given not in (0, count):
                raise ArmError(
                    f'{name} is of {given} joints, but the arm has {count}: one is needed for '
                    'each, or none'
                )
        direction = tuple(map(float, request.direction))
        return arm_tip_force(
            arm,
            asked_tensions(arm, request),
            bend_angles=list(request.bend_angles),
            direction=direction if any(direction) else settings.tip_direction,
            load=self._node.known_load().load,
            at_stop=[joint for joint, leans in enumerate(request.at_stop, start=1) if leans],
            slipping={joint: to for joint, to in enumerate(request.slipping, start=1) if to},
            tension_stddev=settings.tension_stddev,
            bend_angle_stddev=settings.measured_bend_angle_stddev,
            design_covariance=settings.design_uncertainties,
            level=settings.tip_force_level,
        )

    def _filled(self, response: Any, found: ArmTipForce) -> Any:
        response.bounding_joints = [joint or 0 for ends in found.bounding_joints for joint in ends]
        return super()._filled(response, found)
