"""What an estimator of a unit computes with: the unit, how it is measured, and what is believed.

The defaults stand here and in `measuring`; `tendon_statics.files.estimator_parameters` has their
meaning and ranges.
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

from ..physics import DesignUncertainty, JointDesign
from ..tensions.cable_scale import CableScale
from .measuring import Measuring

_AS_READ = CableScale()

MANY_WEIGHTS = 300.0
"""Times the unit's weight that a cable of such a unit pulls at most"""


@dataclasses.dataclass(frozen=True)
class Settings(Measuring):
    """A valid set of what may change while an estimator runs."""

    design: JointDesign
    design_uncertainty: DesignUncertainty | None = dataclasses.field(default=None, kw_only=True)
    """How well the design is known; None: it is taken as exact"""
    initial_bend_angle: float = dataclasses.field(default=0.0, kw_only=True)
    """rad"""
    cable_l: CableScale = dataclasses.field(default=_AS_READ, kw_only=True)
    cable_s: CableScale = dataclasses.field(default=_AS_READ, kw_only=True)

    @cached_property
    def scales(self) -> tuple[CableScale, CableScale]:
        """Those of cables l and s, with thresholds of slack that fit the noise."""
        stddev = self.tension_stddev
        return self.cable_l.with_noise(stddev), self.cable_s.with_noise(stddev)

    @property
    def weight(self) -> float:
        """Weight of the unit in N."""
        return self.design.weight

    @property
    def doubts(self) -> list[str]:
        """What of the settings does not fit the unit, a sentence each."""
        weight = self.weight
        named = {'cable_l.max_tension': self.cable_l, 'cable_s.max_tension': self.cable_s}
        large = {
            name: scale.max_tension
            for name, scale in named.items()
            if scale.is_limited and scale.max_tension > MANY_WEIGHTS * weight > 0.0
        }
        if not large:
            return []
        limits = ' and '.join(f'{limit:g} N' for limit in sorted(set(large.values())))
        return [
            f'{" and ".join(large)} {"are" if len(large) > 1 else "is"} {limits}, up to '
            f'{max(large.values()) / weight:.3g} times the weight of the unit: a wrong reading '
            'below that is believed; set it to what the cable is made for'
        ]
