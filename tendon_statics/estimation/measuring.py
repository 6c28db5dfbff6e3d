"""How the cables of anything that is estimated are measured, and what is believed of it."""

from __future__ import annotations

import dataclasses
from functools import cached_property

from ..physics import UPRIGHT, Load
from ..physics.deviations import BEND_ANGLE_STDDEV, TENSION_STDDEV
from ..tensions.cable_scale import DEFAULT_MAX_TENSION, CableScale
from ..tensions.watch import Plausibility

UPRIGHT_DIRECTION = UPRIGHT.gravity_direction

_BELIEVED = Plausibility()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Measuring:
    """What an estimator is set to, whether of one unit or of an arm.

    Attributes
    ----------
    scales : tuple of CableScale
        Those of the cables, in their order, with thresholds of slack that fit the noise.
    """

    tension_stddev: float = TENSION_STDDEV
    """N"""
    confidence: float = 0.95
    """Probability with which an interval holds the angle"""
    filter_lag: float = 0.15
    """s"""
    tension_bias_stddev: float = 0.0
    """N"""
    measured_bend_angle_stddev: float = BEND_ANGLE_STDDEV
    """rad"""
    input_timeout: float = 0.5
    """s"""
    max_skew: float = 0.005
    """s"""
    max_clock_offset: float = 1.0
    """s"""
    plausibility: Plausibility = _BELIEVED
    gravity_direction: tuple[float, float, float] = UPRIGHT_DIRECTION
    """In the frame of the base; where gravity's direction is not measured"""
    imu_mounting: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Roll, pitch and yaw in rad of the IMU in the same frame"""
    load_timeout: float = 0.5
    """s"""
    tip_distance: float = 0.0
    """m"""
    tip_direction: tuple[float, float, float] = (1.0, 0.0, 0.0)
    """In the same frame; along which a force at the tip is looked for"""
    tip_force_level: float = 0.95
    tare_time: float = 2.0
    """s"""
    tare_limit: float = 0.5
    """N"""

    @property
    def scales(self) -> tuple[CableScale, ...]:
        """Those of the cables."""
        raise NotImplementedError

    what = 'unit'
    """What the cables move, for people"""

    @property
    def weight(self) -> float:
        """Its weight in N."""
        raise NotImplementedError

    @cached_property
    def load(self) -> Load:
        """The load that no sensor measures: gravity alone."""
        return Load(self.gravity_direction)

    @property
    def doubts(self) -> list[str]:
        """What of the settings does not fit together well, a sentence each."""
        return []

    @property
    def defaults(self) -> list[str]:
        """What is better set than left at its default, a sentence each."""
        if all(scale.is_limited for scale in self.scales):
            return []
        return [
            f'Tensions up to {DEFAULT_MAX_TENSION:g} N are believed, the default of max_tension: '
            'set it to what the cables are made for, so that wrong readings are found'
        ]
