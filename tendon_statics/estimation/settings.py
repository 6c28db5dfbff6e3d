"""What an estimator computes with: the unit, how it is measured, and what is believed.

The defaults stand here; `tendon_statics.files.estimator_parameters` has their meaning and ranges.
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

from ..physics import UPRIGHT, DesignUncertainty, JointDesign, Load
from ..tensions.cable_scale import CableScale
from ..tensions.watch import Plausibility

UPRIGHT_DIRECTION = UPRIGHT.gravity_direction

_AS_READ, _BELIEVED = CableScale(), Plausibility()

MANY_WEIGHTS = 300.0
"""Times the unit's weight that a cable of such a unit pulls at most"""


@dataclasses.dataclass(frozen=True)
class Settings:
    """A valid set of what may change while an estimator runs."""

    design: JointDesign
    tension_stddev: float = 0.01
    """N"""
    design_uncertainty: DesignUncertainty | None = None
    """How well the design is known; None: it is taken as exact"""
    confidence: float = 0.95
    """Probability with which an interval holds the angle"""
    filter_lag: float = 0.15
    """s"""
    tension_bias_stddev: float = 0.0
    """N"""
    measured_bend_angle_stddev: float = 0.01
    """rad"""
    initial_bend_angle: float = 0.0
    """rad"""
    input_timeout: float = 0.5
    """s"""
    max_skew: float = 0.005
    """s"""
    max_clock_offset: float = 1.0
    """s"""
    cable_l: CableScale = _AS_READ
    cable_s: CableScale = _AS_READ
    plausibility: Plausibility = _BELIEVED
    gravity_direction: tuple[float, float, float] = UPRIGHT_DIRECTION
    """In the joint frame; where gravity's direction is not measured"""
    imu_mounting: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Roll, pitch and yaw in rad of the IMU in the joint frame"""
    load_timeout: float = 0.5
    """s"""
    tip_distance: float = 0.0
    """m"""
    tip_direction: tuple[float, float, float] = (1.0, 0.0, 0.0)
    """In the joint frame; along which a force at the tip is looked for"""
    tip_force_level: float = 0.95
    tare_time: float = 2.0
    """s"""
    tare_limit: float = 0.5
    """N"""

    @cached_property
    def scales(self) -> tuple[CableScale, CableScale]:
        """Those of cables l and s, with thresholds of slack that fit the noise."""
        stddev = self.tension_stddev
        return self.cable_l.with_noise(stddev), self.cable_s.with_noise(stddev)

    @cached_property
    def load(self) -> Load:
        """The load that no sensor measures: gravity alone."""
        return Load(self.gravity_direction)

    @property
    def doubts(self) -> list[str]:
        """What of the settings does not fit the unit, a sentence each."""
        weight = self.design.weight
        named = {'cable_l.max_tension': self.cable_l, 'cable_s.max_tension': self.cable_s}
        large = {
            name: scale.max_tension
            for name, scale in named.items()
            if scale.max_tension > MANY_WEIGHTS * weight > 0.0
        }
        if not large:
            return []
        limits = ' and '.join(f'{limit:g} N' for limit in sorted(set(large.values())))
        return [
            f'{" and ".join(large)} {"are" if len(large) > 1 else "is"} {limits}, up to '
            f'{max(large.values()) / weight:.3g} times the weight of the unit: a wrong reading '
            'below that is believed; set it to what the cable is made for'
        ]
