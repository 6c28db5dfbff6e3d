"""The contact force on a unit, and how it and the angle follow the tensions."""

from __future__ import annotations

from typing import NamedTuple

from .design import JointDesign
from .forces import ContactForces, ForceRemainder, contact_forces
from .gradients import TensionGradient, angle_by_tensions, finite, normal_by_tensions, of_sides
from .named import named
from .slip import Probe, Slip

STAYS = TensionGradient(0.0, 0.0)
"""Of an angle that does not follow the tensions"""


class StateDetails(NamedTuple):
    """What follows from where a unit is; gradients are None where they are infinite."""

    normal_force: float
    """N in N"""
    forces: ContactForces
    force_remainder: ForceRemainder
    bend_angle_gradient: TensionGradient | None
    """∂θ/∂T in rad/N; zeros for a unit that stays where it is"""
    pressure_gradient: TensionGradient | None
    """∂p/∂T in Pa/N"""


def state_details(
    slip: Slip,
    probe: Probe,
    friction: float,
    design: JointDesign,
    at_root: bool,
    at_limit: bool,
) -> StateDetails:
    """Work out all of them at once, since they share most of the work.

    Parameters
    ----------
    slip, probe : Slip, Probe
        The slip function towards the side to which the moment drives, probed at the angle.
    friction : float
        Moment that friction takes up, in units of r T.
    at_root : bool
        Whether the angle is a root of the slip function, which moves with the tensions.
    at_limit : bool
        Whether friction is at its limit; otherwise it takes up the moment.
    """
    point, lever = slip.point(probe), design.relative_lever
    normal = slip.law.normal_slopes(point.state, friction)
    normal_force = slip.total * normal[0]
    forces, remainder = contact_forces(slip, point, friction, normal[0])
    angle, by_tension = (0.0, 0.0), STAYS
    if at_root:
        if point.slope == 0.0:
            return named(StateDetails, (normal_force, forces, remainder, None, None))
        angle = angle_by_tensions(slip, point, lever)
        by_tension = of_sides(slip, angle, slip.side)
    behind, ahead = normal_by_tensions(slip, point, normal, lever, angle=angle, at_limit=at_limit)
    area = design.contact_area
    by_pressure = of_sides(slip, (behind / area, ahead / area))
    gradients = finite(by_tension), finite(by_pressure)
    return named(StateDetails, (normal_force, forces, remainder, *gradients))
