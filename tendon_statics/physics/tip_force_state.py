"""The tip force of a followed unit: its regime says whether friction is at its limit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

from .admissible import check_bend_angle, slip_margin
from .design import JointDesign
from .design_uncertainty import DesignUncertainty
from .errors import BendAngleError
from .force_scores import NORMAL
from .load import Load
from .regime import Regime
from .state import Equilibrium
from .tip_force import TipForce, may_be_at_stop, tip_force

SAME_ANGLE = 1e-9
"""rad within which two angles that are exact are the same"""


class StateUnderNoise(Protocol):
    """What is known of a unit whose angle has a deviation, such as a `FilterState`."""

    @property
    def design(self) -> JointDesign:
        """The unit's design."""

    @property
    def load(self) -> Load:
        """What acts beside the cables."""

    @property
    def regime(self) -> Regime:
        """What the tensions mean for the unit."""

    @property
    def tension_l(self) -> float:
        """In N."""

    @property
    def tension_s(self) -> float:
        """In N."""

    @property
    def bend_angle(self) -> float | None:
        """θ in rad."""

    @property
    def bend_angle_stddev(self) -> float | None:
        """In rad."""

    @property
    def angle_assured(self) -> bool:
        """Whether the unit cannot have moved unseen."""


def tip_force_of_state(
    state: Equilibrium | StateUnderNoise,
    *,
    direction: Sequence[float],
    distance: float,
    bend_angle: float | None = None,
    bend_angle_stddev: float = 0.0,
    slipping: str | None = None,
    tension_stddev: float = 0.0,
    design_covariance: DesignUncertainty | None = None,
    level: float = 0.95,
) -> TipForce:
    """Return what a unit that is followed tells of the force at its tip.

    As `tip_force`, for the tensions and the load of the state. Where a tracker or a filter has the
    unit slipping, and the measured angle agrees, friction is at its limit towards that side and
    the force is a number. Next to a stop the stop is taken to carry what friction does not.

    The load of the state is part of how it was followed: without a measured angle, the angle is
    where the unit is if nothing else acts. Then the set tells which forces would not have moved
    the unit from there, so it always has zero in it; and of a slipping unit the number is zero
    by construction. Only an angle that was measured tells a force.

    That it agrees tells little of a unit that has slipped by no more than the angle's noise: a
    force that the state knows nothing of may hold the real one. So say `slipping` where the motion
    itself was measured.

    Parameters
    ----------
    state : Equilibrium or FilterState
        Of a tracker or a filter; one of `solve` says nothing of friction, so that its unit is
        taken to be at rest.
    direction, distance, tension_stddev, design_covariance, level
        As of `tip_force`.
    bend_angle : float, optional
        Measured θ in rad; without it that of the state.
    bend_angle_stddev : float
        Standard deviation of the measured angle in rad.
    slipping : str, optional
        The cable, ``s`` or ``l``, towards which the unit is known to be slipping, empty if it may
        be at rest, whatever the state has of it; by default the state says.

    Raises
    ------
    BendAngleError
        If the state has no angle, or none that is assured, and none was measured.
    TensionError, LoadError, ValueError
        As `tip_force` does.
    """
    own_stddev = stddev_of_angle(state, tension_stddev)
    angle, stddev = bend_angle, bend_angle_stddev
    if angle is None:
        if state.regime is not Regime.SLACK and state.bend_angle is None:
            raise BendAngleError('the state has no bend angle, and none was measured')
        if not state.angle_assured and state.regime is not Regime.SLACK:
            raise BendAngleError("the state's bend angle is not assured, and none was measured")
        angle, stddev = state.bend_angle or 0.0, own_stddev
    design = state.design
    angle = check_bend_angle(design, angle)
    at_stop = not slipping and may_be_at_stop(design, angle, stddev + SAME_ANGLE)
    own = state.bend_angle
    if slipping is None and (
        not at_stop
        and state.regime is Regime.SLIPPING
        and own is not None
        and (bend_angle is None or agree(angle, stddev, own, own_stddev, level))
    ):
        margin = slip_margin(design, state.tension_l, state.tension_s, own, state.load)
        slipping = 's' if margin > 0.0 else 'l'
    return tip_force(
        *(design, state.tension_l, state.tension_s),
        bend_angle=angle,
        direction=direction,
        distance=distance,
        load=state.load,
        tension_stddev=tension_stddev,
        bend_angle_stddev=stddev,
        design_covariance=design_covariance,
        level=level,
        slipping=slipping or '',
        at_stop=at_stop,
    )


def agree(angle: float, stddev: float, own: float, own_stddev: float, level: float) -> bool:
    """Return whether a measured angle and that of a state may be the same, all in rad."""
    reach = SAME_ANGLE + NORMAL.inv_cdf(0.5 * (1.0 + level)) * stddev
    return abs(angle - own) <= math.hypot(reach, 2.0 * own_stddev)


def stddev_of_angle(state: Equilibrium | StateUnderNoise, tension_stddev: float) -> float:
    """Return the deviation in rad of a state's own angle, 0 where it is not known."""
    if isinstance(state, Equilibrium):
        return state.bend_angle_stddev(tension_stddev) or 0.0
    return state.bend_angle_stddev or 0.0
