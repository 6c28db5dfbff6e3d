"""What the slip equation takes from the design alone, worked out once for each design."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .design import JointDesign

Attitude = tuple[float, float, float, float, float]
"""A bend angle and what the equations take of it: θ, sin θ, 1 − μ sin φ, μ cos φ, cos φ / cos θ"""


class SlipGeometry:
    """Arms and directions of one design.

    Attributes
    ----------
    friction, weight : float
        μ and W in N.
    friction_excess : float
        μ² − 1.
    cable_gain, weight_gain : float
        (r + δ) / (μ r) and W l / (μ r) in N: the slopes of N_m by ΔT and by sin θ.
    weight_influence : float
        The larger of |W l| / (μ r) and μ W in N: as much as the weight moves g at the most.
    sine, cosine : float
        sin β and cos β.
    """

    __slots__ = (
        '_knots',
        'cable_gain',
        'centre_angle',
        'cosine',
        'friction',
        'friction_excess',
        'sine',
        'weight',
        'weight_gain',
        'weight_influence',
    )

    def __init__(self, design: JointDesign) -> None:
        friction = design.friction_coefficient
        resisting_arm = friction * design.ball_radius
        self.friction = friction
        self.friction_excess = (friction - 1.0) * (friction + 1.0)
        self.weight = design.weight
        self.cable_gain = (design.ball_radius + design.cable_offset) / resisting_arm
        self.weight_gain = design.weight * design.com_distance / resisting_arm
        self.weight_influence = max(abs(self.weight_gain), friction * self.weight)
        self.centre_angle = design.contact_centre_angle
        self.sine = math.sin(design.contact_centre_angle)
        self.cosine = math.cos(design.contact_centre_angle)
        self._knots: dict[tuple[float, float], list[Attitude]] = {}

    def attitude(self, bend_angle: float) -> Attitude:
        """Return what the equations take of a bend angle in rad, without loss of digits."""
        sin_theta, cos_theta = math.sin(bend_angle), math.cos(bend_angle)
        sin_phi = self.sine * cos_theta + self.cosine * sin_theta
        cos_phi = self.cosine * cos_theta - self.sine * sin_theta
        # 1 − sin φ and 1 − μ sin φ in terms that do not cancel.
        below_one = cos_phi * cos_phi / (1.0 + sin_phi) if sin_phi > 0.0 else 1.0 - sin_phi
        friction = self.friction
        spare = 1.0 - friction + friction * below_one
        return bend_angle, sin_theta, spare, friction * cos_phi, cos_phi / cos_theta

    def knots(self, low: float, high: float) -> list[Attitude]:
        """`low`, `high` and what lies between at which sin φ, cos φ or cos θ has an extreme.

        They are kept, since a design's range is always the same one or two.
        """
        found = self._knots.get((low, high))
        if found is None:
            beta = self.centre_angle
            turns = {0.0, -beta, 0.5 * math.pi - beta, math.pi - beta}
            between = sorted(angle for angle in turns if low < angle < high)
            found = [self.attitude(angle) for angle in (low, *between, high)]
            self._knots[low, high] = found
        return found
