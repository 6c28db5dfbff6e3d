"""``estimation: filtering`` of an arm: with the memory of an `ArmFilter`, for noisy load cells."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .arm_settings import ArmSettings
from .estimate import KnownLoad, Sample
from .filtered_arm_estimate import FilteredArmEstimate
from .filtering import BEYOND_STOP, ForwardClock, Waiting, refused_without_noise
from .method import WayOfEstimating

if TYPE_CHECKING:
    from ..physics import ArmFilter, ArmFilterState

Place = tuple[tuple[float, ...], tuple[float, ...]]
"""Angles of the joints, and their deviations, in rad"""


class ArmFiltering(WayOfEstimating[ArmSettings, FilteredArmEstimate]):
    """Follows an arm, and takes each set of tensions for a noisy reading."""

    remembers = True

    def __init__(self, settings: ArmSettings) -> None:
        super().__init__(settings)
        self._place: Place = (settings.start, (0.0,) * len(settings.start))
        self._unsure: set[int] = set()
        """Joints, counted from 1, that may have moved unseen"""
        self._filter = self._new_filter()
        self._clock = ForwardClock()
        self._newest: FilteredArmEstimate | None = None
        self._waiting = Waiting()

    @classmethod
    def refusal(cls, settings: ArmSettings) -> str:
        """Return why it cannot work with settings: noise is what it is made for."""
        return refused_without_noise(settings)

    def _new_filter(self) -> ArmFilter:
        """Return a filter of an arm that is where it was last."""
        from ..physics import ArmFilter  # Here, for who only follows needs no more of NumPy.

        settings, (angles, stddevs) = self.settings, self._place
        found = ArmFilter(
            settings.arm,
            bend_angles=angles,
            bend_angle_stddev=stddevs,
            tension_stddev=settings.tension_stddev,
            tension_bias_stddev=settings.tension_bias_stddev,
            lag=settings.filter_lag,
        )
        if self._unsure:
            found.doubt()
        return found

    def update(self, sample: Sample) -> FilteredArmEstimate:
        """Follow the arm through a set of tensions."""
        self._waiting.take_committed(self._filter)  # by the sample before; nobody wanted it
        time = self._clock.time(sample)
        self._newest = self._updated(self._filter, sample, time)
        state = self._newest.state
        if state.bend_angles is not None:
            self._waiting.add(time, sample.measured)
            self._place = state.bend_angles, tuple(state.members.std(axis=0).tolist())
        assured = enumerate(state.angles_assured, start=1)
        self._unsure = {joint for joint, is_assured in assured if not is_assured}
        return self._newest

    def imagine(self, sample: Sample) -> FilteredArmEstimate:
        """Work out where a set of tensions would take the arm."""
        return self._updated(self._new_filter(), sample, 0.0)

    def again(self, sample: Sample) -> FilteredArmEstimate:
        """Return the newest estimate, which has the samples before it in it."""
        return self._newest or self.imagine(sample)

    def _updated(self, found: ArmFilter, sample: Sample, time: float) -> FilteredArmEstimate:
        names, known = self.settings.arm.cable_names, sample.known
        by_name = dict(zip(names, sample.tensions, strict=True))
        state = found.update(by_name, time, known.load)
        return self._estimate(state, known, sample.measured)

    def _estimate(
        self, state: ArmFilterState, known: KnownLoad, measured: float
    ) -> FilteredArmEstimate:
        return FilteredArmEstimate(state, known, self.settings, measured)

    def take_committed(self) -> list[FilteredArmEstimate]:
        """Return the estimates that will not be taken back, each once; tensions are smoothed."""
        return [
            self._estimate(state, KnownLoad(state.load), measured)
            for state, measured in self._waiting.take_committed(self._filter)
        ]

    def change_settings(self, settings: ArmSettings) -> str:
        """Go on with other settings, from where the arm is; the samples before are forgotten."""
        before, self.settings = self.settings, settings
        if _made_of(settings) != _made_of(before):
            self._begin_anew(self._new_filter())
        return ''

    def doubt(self) -> None:
        """Take it that the arm may have moved unseen."""
        self._filter.doubt()
        self._unsure = {*range(1, len(self.settings.start) + 1)}
        self._waiting.clear()  # They will not be committed.

    def put(self, bend_angles: Sequence[float]) -> None:
        """Put the joints to angles in rad."""
        self._filter.reset(bend_angles)
        self._place, self._unsure = (tuple(bend_angles), (0.0,) * len(bend_angles)), set()
        self._begin_anew(self._filter)

    def measure(self, bend_angles: Mapping[int, float]) -> None:
        """Take angles in rad that sensors say; a little beyond the stop is at the stop."""
        stddev = self.settings.measured_bend_angle_stddev
        for joint, angle in bend_angles.items():
            stop = self.settings.arm.stops[joint - 1]
            if stop < abs(angle) <= stop + BEYOND_STOP * stddev:
                angle = math.copysign(stop, angle)
            self._filter.measure(joint, angle, stddev)
            self._note(joint, angle, stddev)
        self._newest = None

    def _note(self, joint: int, bend_angle: float, stddev: float) -> None:
        """Take it that a joint is where a sensor says, if that is better than what is known."""
        angles, stddevs = map(list, self._place)
        if joint in self._unsure or stddevs[joint - 1] > stddev:
            angles[joint - 1], stddevs[joint - 1] = bend_angle, stddev
            self._place = tuple(angles), tuple(stddevs)
        self._unsure.discard(joint)

    def _begin_anew(self, found: ArmFilter) -> None:
        self._filter = found
        self._newest = None
        self._waiting.clear()


def _made_of(settings: ArmSettings) -> tuple[Any, ...]:
    """What of the settings a filter is made of, or its samples are."""
    return (
        *(settings.scales, settings.filter_lag),
        *(settings.tension_stddev, settings.tension_bias_stddev),
    )
