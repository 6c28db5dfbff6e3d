"""``estimation: tracking`` of an arm: with the memory of an `ArmTracker`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..physics.arm import ArmTracker
from .arm_estimate import ArmEstimate
from .arm_settings import ArmSettings
from .estimate import Sample
from .method import WayOfEstimating


class ArmTracking(WayOfEstimating[ArmSettings, ArmEstimate]):
    """Follows an arm, and takes each set of tensions as it is."""

    remembers = True

    def __init__(self, settings: ArmSettings) -> None:
        super().__init__(settings)
        self.tracker = ArmTracker(settings.arm, settings.start)

    def update(self, sample: Sample) -> ArmEstimate:
        """Follow the arm through a set of tensions."""
        return self._updated(self.tracker, sample)

    def imagine(self, sample: Sample) -> ArmEstimate:
        """Work out where a set of tensions would take the arm."""
        return self._updated(self.tracker.copy(), sample)

    def _updated(self, tracker: ArmTracker, sample: Sample) -> ArmEstimate:
        settings, known = self.settings, sample.known
        by_name = dict(zip(settings.arm.cable_names, sample.tensions, strict=True))
        return ArmEstimate(tracker.update(by_name, known.load), known, settings)

    def doubt(self) -> None:
        """Take it that the arm may have moved unseen."""
        self.tracker.doubt()

    def put(self, bend_angles: Sequence[float]) -> None:
        """Put the joints to angles in rad."""
        self.tracker.reset(bend_angles)

    def measure(self, bend_angles: Mapping[int, float]) -> None:
        """Put joints, counted from 1 at the base, to angles in rad that encoders told."""
        for joint, angle in bend_angles.items():
            self.tracker.measure(joint, angle)
