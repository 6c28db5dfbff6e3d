"""Eq. (3): the moment about the centre of the ball, all but that of friction.

    M(θ) = ΔT (r + δ) + Q_x cos θ − Q_z sin θ − k θ

with ΔT = T_s − T_l, the moment Q of the dead load (see `load`) and the stiffness k of a backbone.
For an upright unit with nothing at its tip the middle is W l sin θ, the paper's.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from .design import JointDesign
from .load import DeadLoad


class Moment(NamedTuple):
    """M / (r T) as a function of the bend angle; floats, or arrays of one shape."""

    offset: Any
    """ΔT (r + δ) / (r T)"""
    cosine: Any
    """Q_x / (r T)"""
    sine: Any
    """−Q_z / (r T)"""
    stiffness: Any
    """k / (r T)"""

    @classmethod
    def of(cls, design: JointDesign, dead: DeadLoad, difference: Any, total: Any) -> Moment:
        """Return the function for ΔT and T in N."""
        radius = design.ball_radius
        return cls(
            difference / total * design.relative_lever,
            dead.moment_x / radius / total,
            -dead.moment_z / radius / total,
            design.stiffness / radius / total,
        )

    def at(self, angle: Any, cosine: Any, sine: Any) -> Any:
        """M / (r T) at an angle in rad, from its cosine and sine."""
        return self.offset + self.cosine * cosine + self.sine * sine - self.stiffness * angle

    def slope(self, cosine: Any, sine: Any) -> Any:
        """∂M/∂θ / (r T)."""
        return self.sine * cosine - self.cosine * sine - self.stiffness

    def turn(self, cosine: Any, sine: Any) -> tuple[Any, Any]:
        """The part of the slope that turns with θ, and its own slope."""
        return (
            self.sine * cosine - self.cosine * sine,
            -(self.cosine * cosine + self.sine * sine),
        )
