"""Between ROS messages and the physics."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import Float64MultiArray, Header, MultiArrayDimension

from ...estimation.unit_estimator import KnownLoad
from ...physics import (
    BendAngleError,
    Equilibrium,
    JointDesign,
    Load,
    LoadError,
    TensionGradient,
    UnreachableError,
    tensions_for,
)

__all__ = [
    'INTERFACES_MISSING',
    'Estimate',
    'LoadDesign',
    'Solve',
    'SolveInverse',
    'asked_load',
    'fill_estimate',
    'fill_intervals',
    'fill_inverse_response',
    'fill_solve_response',
    'fill_unit_pose',
    'refuse',
    'refuse_inverse',
    'refuse_solve',
]

# The node works without the package nested in interfaces/, but offers less.
try:
    from tendon_statics_interfaces.msg import Estimate
    from tendon_statics_interfaces.srv import LoadDesign, Solve, SolveInverse
except ImportError as _error:
    Estimate = LoadDesign = Solve = SolveInverse = None
    INTERFACES_MISSING = str(_error)
else:
    INTERFACES_MISSING = ''


_UNKNOWN_GRADIENT = TensionGradient(math.nan, math.nan)


def fill_intervals(
    message: Float64MultiArray, intervals: Sequence[tuple[float, float]]
) -> Float64MultiArray:
    """Put pairs of ends into a message, row by row, with a layout that says so."""
    if not message.layout.dim:
        message.layout.dim = [
            MultiArrayDimension(label='interval'),
            MultiArrayDimension(label='end', size=2, stride=2),
        ]
    rows = message.layout.dim[0]
    rows.size = len(intervals)
    rows.stride = 2 * len(intervals)
    message.data = [end for interval in intervals for end in interval]
    return message


def fill_unit_pose(
    message: PoseWithCovarianceStamped,
    design: JointDesign,
    bend_angle: float,
    bend_angle_stddev: float,
    header: Header,
) -> PoseWithCovarianceStamped:
    """Put the pose of the unit's centre of gravity in the joint frame into a message.

    The joint frame has its origin in the joint's centre, Z along the unit at zero bend and X
    towards cable s. The covariance follows from the angle's alone: position l (sin θ, 0, cos θ)
    and rotation about Y move together, and what leaves the plane of bending has none.
    """
    sine, cosine = math.sin(bend_angle), math.cos(bend_angle)
    message.header = header
    pose = message.pose.pose
    pose.position.x = design.com_distance * sine
    pose.position.z = design.com_distance * cosine
    pose.orientation.y = math.sin(0.5 * bend_angle)
    pose.orientation.w = math.cos(0.5 * bend_angle)
    # ∂(x, y, z, rotation about x, y, z) / ∂θ
    gradient = (design.com_distance * cosine, 0.0, -design.com_distance * sine, 0.0, 1.0, 0.0)
    variance = bend_angle_stddev * bend_angle_stddev
    message.pose.covariance = [variance * (a * b) for a in gradient for b in gradient]
    return message


def fill_estimate(
    message: Estimate,
    result: Equilibrium,
    margin: float | None,
    intervals: Sequence[tuple[float, float]],
    tension_stddev: float,
    header: Header,
    *,
    load_assured: bool = True,
) -> Estimate:
    """Put all that is known from one pair of tensions into a message.

    It is NaN, False or 0 where it is not known, whatever was in the message before.
    """
    forces = result.forces or (math.nan,) * 4
    remainder = result.force_remainder or (math.nan,) * 2
    angle_gradient = result.bend_angle_gradient or _UNKNOWN_GRADIENT
    pressure_gradient = result.pressure_gradient or _UNKNOWN_GRADIENT
    message.header = header
    message.regime = result.regime.value
    message.tension_l = result.tension_l
    message.tension_s = result.tension_s
    message.bend_angle = _number(result.bend_angle)
    message.bend_angle_stddev = angle_gradient.stddev(tension_stddev)
    message.pressure = _number(result.pressure)
    message.pressure_stddev = pressure_gradient.stddev(tension_stddev)
    message.normal_force = _number(result.normal_force)
    message.slip_margin = _number(margin)
    message.admissible_angles = [end for interval in intervals for end in interval]
    if not result.is_tracked:
        message.angle_assured = result.bend_angle is not None
        message.root_count = result.root_count
        message.stable = bool(result.stable)
        message.iterations = result.iterations
        message.residual = _number(result.residual)
    else:
        message.angle_assured = result.angle_assured
        message.root_count = message.iterations = 0
        message.stable = False
        message.residual = math.nan
    load = result.load
    message.contact_law = result.design.contact_law
    (
        message.gravity_direction_x,
        message.gravity_direction_y,
        message.gravity_direction_z,
    ) = load.gravity_direction
    message.tip_force_x, message.tip_force_z = load.tip_force
    message.tip_distance = load.tip_distance
    message.load_assured = load_assured
    message.branch_consistent = bool(result.branch_consistent)
    message.pressure_force_x, message.pressure_force_z = forces[:2]
    message.friction_force_x, message.friction_force_z = forces[2:]
    message.force_remainder_x, message.force_remainder_z = remainder
    message.bend_angle_by_tension_l, message.bend_angle_by_tension_s = angle_gradient
    message.pressure_by_tension_l, message.pressure_by_tension_s = pressure_gradient
    return message


def asked_load(request: Solve.Request, known: KnownLoad) -> KnownLoad:
    """Return the load of a request of ``~/solve``, or the one that is known.

    Raises
    ------
    LoadError
        If it is not valid, or gives a tip force without gravity's direction.
    """
    direction = tuple(map(float, request.gravity_direction))
    tip_force, distance = (request.tip_force_x, request.tip_force_z), request.tip_distance
    if any(direction):
        return KnownLoad(Load(direction, tip_force, distance))  # type: ignore[arg-type]
    if any((*tip_force, distance)):
        raise LoadError(
            f'the tip force is {tip_force!r} N at {distance!r} m, but gravity_direction is 0, '
            'which asks for the load of the node: give the direction too, say (0, 0, -1)'
        )
    return known


def fill_solve_response(
    response: Solve.Response,
    equilibrium: Equilibrium,
    tension_stddev: float,
    *,
    load_assured: bool,
) -> Solve.Response:
    """Put a result into a response of ``~/solve``."""
    response.success = True
    response.regime = equilibrium.regime.value
    response.bend_angle = _number(equilibrium.bend_angle)
    response.pressure = _number(equilibrium.pressure)
    response.bend_angle_stddev = _number(equilibrium.bend_angle_stddev(tension_stddev))
    response.root_count = equilibrium.root_count
    response.stable = bool(equilibrium.stable)
    response.load_assured = load_assured
    return response


def refuse(response: Any, reason: str) -> Any:
    """Put the reason for no result into the response of a service."""
    response.success = False
    response.message = reason
    return response


def refuse_solve(response: Solve.Response, reason: str) -> Solve.Response:
    """Put the reason for no result into a response of ``~/solve``."""
    refuse(response, reason)
    response.bend_angle = response.pressure = response.bend_angle_stddev = math.nan
    return response


def fill_inverse_response(
    response: SolveInverse.Response,
    design: JointDesign,
    request: SolveInverse.Request,
    load: Load,
) -> SolveInverse.Response:
    """Answer ``~/solve_inverse``, also with the reason for no result."""
    try:
        tensions = tensions_for(
            design,
            request.bend_angle,
            pressure=request.pressure or None,  # 0 stands for not given
            total_tension=request.total_tension or None,
            load=load,
        )
    except (UnreachableError, BendAngleError) as error:
        return refuse_inverse(response, str(error))
    except TypeError:
        return refuse_inverse(
            response,
            f'pressure is {request.pressure!r} Pa and total_tension {request.total_tension!r} N: '
            'give one of the two and leave the other 0',
        )
    response.success = True
    response.tension_l, response.tension_s = tensions
    return response


def refuse_inverse(response: SolveInverse.Response, reason: str) -> SolveInverse.Response:
    """Put the reason for no result into a response of ``~/solve_inverse``."""
    refuse(response, reason)
    response.tension_l = response.tension_s = math.nan
    return response


def _number(value: float | None) -> float:
    return math.nan if value is None else value
