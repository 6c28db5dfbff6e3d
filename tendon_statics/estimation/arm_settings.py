"""What an estimator of an arm computes with: the arm, how it is measured, and what is believed."""

from __future__ import annotations

import dataclasses
from functools import cached_property

from ..physics import DesignUncertainty
from ..physics.arm import Arm
from ..tensions.cable_scale import CableScale
from .measuring import Measuring
from .settings import MANY_WEIGHTS


@dataclasses.dataclass(frozen=True)
class ArmSettings(Measuring):
    """A valid set of what may change while an estimator of an arm runs, and the arm.

    Attributes
    ----------
    joint_names : tuple of str
        From the base on.
    cables : tuple of CableScale
        Of each cable, in the arm's order; empty: all read in N.
    initial_bend_angles : tuple of float
        In rad, from the base on; empty: the arm is straight.
    design_uncertainties : tuple of DesignUncertainty or None
        How well each unit's design is known, from the base on; None: exactly. Only what is told of
        a force at the tip follows them.
    """

    arm: Arm
    joint_names: tuple[str, ...]
    cables: tuple[CableScale, ...] = dataclasses.field(default=(), kw_only=True)
    initial_bend_angles: tuple[float, ...] = dataclasses.field(default=(), kw_only=True)
    design_uncertainties: tuple[DesignUncertainty | None, ...] | None = dataclasses.field(
        default=None, kw_only=True
    )

    @cached_property
    def scales(self) -> tuple[CableScale, ...]:
        """Those of the cables in their order, with thresholds of slack that fit the noise."""
        cables = self.cables or (CableScale(),) * len(self.arm.cables)
        return tuple(scale.with_noise(self.tension_stddev) for scale in cables)

    what = 'arm'

    @property
    def start(self) -> tuple[float, ...]:
        """Where the joints are at the start in rad."""
        return self.initial_bend_angles or (0.0,) * len(self.arm.units)

    @property
    def weight(self) -> float:
        """Weight of all units in N."""
        return sum(design.weight for design in self.arm.designs)

    @property
    def doubts(self) -> list[str]:
        """What of the settings does not fit the arm, a sentence each."""
        weight = self.weight
        loose = [
            name
            for name, scale in zip(self.arm.cable_names, self.scales, strict=True)
            if scale.is_limited and scale.max_tension > MANY_WEIGHTS * weight > 0.0
        ]
        if not loose:
            return []
        return [
            f'max_tension of {", ".join(loose)} is more than {MANY_WEIGHTS:g} times the weight of '
            'the arm: a wrong reading below that is believed; set cables.NAME.max_tension to what '
            'the cable is made for'
        ]
