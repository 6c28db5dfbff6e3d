"""The node ``estimator``: bend angle and joint pressure for every pair of tensions."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from std_msgs.msg import Float64

from ..estimation.estimate import Estimate
from ..estimation.methods import METHODS
from ..estimation.settings import Settings
from ..estimation.unit_estimator import UnitEstimator
from ..physics import BendAngleError
from .inputs.sources import tension_source
from .inputs.tension_source import TensionSource
from .managed_estimator import ManagedEstimator
from .outputs import messages
from .outputs.committed import CommittedOutput
from .outputs.finding import unit_topics
from .outputs.markers import unit_markers
from .outputs.publishers import Outputs
from .parameters.estimator import Wiring, declare_settings, declare_wiring, unit_table
from .unit_services import offer_unit_services
from .unit_tip_force import UnitTipForces


class Estimator(ManagedEstimator[Settings, Estimate]):
    """Publishes what every pair of tensions that arrives says of the unit."""

    core: UnitEstimator
    _tip_forces: UnitTipForces | None

    def __init__(self) -> None:
        super().__init__('estimator')

    def _declare(self) -> None:
        self.table = unit_table()
        self.left_out = declare_settings(self, self.table)
        self._wiring = declare_wiring(self)

    @property
    def wiring(self) -> Wiring:
        """How it is connected."""
        return self._wiring

    def _new_outputs(self) -> Outputs:
        draw = unit_markers if self._wiring.markers else None
        return Outputs(self, self._wiring.frame_id, unit_topics(self._wiring.joint_name), draw)

    def _new_source(self, max_skew: Callable[[], float]) -> TensionSource:
        return tension_source(self._on_reading, self._on_drop, self._wiring, max_skew)

    def _connect(self) -> None:
        wiring = self._wiring
        if wiring.estimation == 'filtering' and not messages.INTERFACES_MISSING:
            self._committed = CommittedOutput(
                self, messages.Estimate, messages.fill_estimate, wiring.frame_id
            )
        if wiring.tip_force:
            self._tip_forces = UnitTipForces(self)
        if METHODS[wiring.estimation].remembers or wiring.tip_force:
            self._inputs.add('measured_bend_angle', Float64, self._on_measured_bend_angle)
        offer_unit_services(self)

    def _new_core(self, settings: Settings) -> UnitEstimator:
        return UnitEstimator(settings, self._wiring.estimation, self.health)

    @property
    def bias_parameters(self) -> Mapping[str, str]:
        """Cable → the parameter of its bias."""
        return {'cable_l': 'cable_l.bias', 'cable_s': 'cable_s.bias'}

    def values_of_settings(self) -> dict[str, Any]:
        """What ``~/solve_latest`` says of the settings."""
        return {'contact_law': self.core.settings.design.contact_law}

    def values_to_report(self) -> dict[str, str]:
        """What of the design nobody has set."""
        return {
            'design values left at the preliminary design': ', '.join(sorted(self.left_out)),
        }

    def _on_measured_bend_angle(self, message: Float64) -> None:
        try:
            if self._tip_forces is not None:
                self._tip_forces.note_angle(message.data)
            self.core.measure(message.data, time.monotonic())
        except BendAngleError as error:
            self._reject_correction(error)
