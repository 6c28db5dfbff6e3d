"""The node ``arm_estimator``: all joints of an arm for every set of tensions of its cables."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

from sensor_msgs.msg import JointState

from ..estimation.arm_estimate import ArmEstimate
from ..estimation.arm_follower import ArmFollower
from ..estimation.arm_settings import ArmSettings
from ..estimation.health import Health
from ..files.arm_parameters import cable_prefix
from ..files.arm_settings import check_cables
from .arm_services import offer_arm_services
from .arm_tip_force import ArmTipForces
from .inputs.measured_joints import measured_joints
from .inputs.sources import arm_tension_source
from .inputs.tension_source import TensionSource
from .managed_estimator import ManagedEstimator
from .outputs import arm_messages
from .outputs.arm_finding import arm_topics
from .outputs.arm_markers import arm_markers
from .outputs.committed import CommittedOutput
from .outputs.publishers import Outputs
from .parameters.arm import ArmWiring, arm_table, declare_arm_wiring


class ArmEstimator(ManagedEstimator[ArmSettings, ArmEstimate]):
    """Publishes what every set of tensions that arrives says of the arm."""

    core: ArmFollower
    _tip_forces: ArmTipForces | None

    def __init__(self) -> None:
        super().__init__('arm_estimator')

    def _declare(self) -> None:
        self._wiring, self.arm = declare_arm_wiring(self)
        self.table = arm_table(self.arm, self._wiring)
        # rclpy has no public view of overrides that nobody declares, as a misspelt one.
        given = {name: of.value for name, of in self._parameter_overrides.items()}
        check_cables(self.arm, given)
        self.table.declare_changeable(self)

    @property
    def wiring(self) -> ArmWiring:
        """How it is connected."""
        return self._wiring

    def _new_health(self, *, counts_lost: bool) -> Health:
        return Health(
            counts_lost=counts_lost,
            solved_are='readings solved',
            foreign_are='messages about no cable',
        )

    def _new_outputs(self) -> Outputs:
        draw = arm_markers if self._wiring.markers else None
        return Outputs(self, self._wiring.frame_id, arm_topics(self._wiring.joint_names), draw)

    def _new_source(self, max_skew: Callable[[], float]) -> TensionSource:
        return arm_tension_source(
            self._on_reading,
            self._on_drop,
            self._wiring.tension_source,
            self.arm.cable_names,
            max_skew,
        )

    def _connect(self) -> None:
        wiring = self._wiring
        if wiring.estimation == 'filtering' and not arm_messages.ARM_INTERFACES_MISSING:
            self._committed = CommittedOutput(
                self, arm_messages.ArmEstimate, arm_messages.fill_arm_estimate, wiring.frame_id
            )
        if wiring.tip_force:
            self._tip_forces = ArmTipForces(self)
        self._inputs.add('measured_joint_states', JointState, self._on_measured_joint_states)
        offer_arm_services(self)

    def _new_core(self, settings: ArmSettings) -> ArmFollower:
        return ArmFollower(settings, self._wiring.estimation, self.health)

    @property
    def bias_parameters(self) -> Mapping[str, str]:
        """Cable → the parameter of its bias."""
        return {name: f'{cable_prefix(name)}bias' for name in self.arm.cable_names}

    def values_to_report(self) -> dict[str, str]:
        """What has become of each joint."""
        newest = self.health.newest
        if not isinstance(newest, ArmEstimate):
            return {}
        return {
            'worst joint': self._wiring.joint_names[newest.worst],
            **{
                f'regime of {name}': regime.value
                for name, regime in zip(self._wiring.joint_names, newest.regimes, strict=True)
            },
        }

    def _on_measured_joint_states(self, message: JointState) -> None:
        angles, fault = measured_joints(message, self._wiring.joint_names)
        if fault:
            self._reject_correction(fault)
        if self._tip_forces is not None:
            self._tip_forces.note_angles(angles)
        for error in self.core.measure(angles, time.monotonic()):
            self._reject_correction(error)
