"""Between ROS messages and the physics."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import Float64MultiArray, Header, MultiArrayDimension, MultiArrayLayout

from ..physics import (
    BendAngleError,
    Equilibrium,
    JointDesign,
    TrackedState,
    UnreachableError,
    tensions_for,
)

__all__ = [
    'INTERFACES_MISSING',
    'Estimate',
    'Solve',
    'SolveInverse',
    'estimate',
    'fill_inverse_response',
    'fill_solve_response',
    'intervals_array',
    'refuse',
    'refuse_inverse',
    'refuse_solve',
    'type_name',
    'unit_pose',
]

# The node works without the package nested in interfaces/, but offers less.
try:
    from tendon_statics_interfaces.msg import Estimate
    from tendon_statics_interfaces.srv import Solve, SolveInverse
except ImportError as _error:
    Estimate = Solve = SolveInverse = None
    INTERFACES_MISSING = str(_error)
else:
    INTERFACES_MISSING = ''


def type_name(message_type: type) -> str:
    """Return a type as ROS writes it, say ``std_msgs/msg/String``."""
    package, kind, *_ = message_type.__module__.split('.')
    return f'{package}/{kind}/{message_type.__name__}'


def intervals_array(intervals: Sequence[tuple[float, float]]) -> Float64MultiArray:
    """Pairs of ends, row by row, with a layout that says so."""
    count = len(intervals)
    return Float64MultiArray(
        layout=MultiArrayLayout(
            dim=[
                MultiArrayDimension(label='interval', size=count, stride=2 * count),
                MultiArrayDimension(label='end', size=2, stride=2),
            ]
        ),
        data=[end for interval in intervals for end in interval],
    )


def unit_pose(
    design: JointDesign, bend_angle: float, bend_angle_stddev: float, header: Header
) -> PoseWithCovarianceStamped:
    """Pose of the unit's centre of gravity in the joint frame.

    The joint frame has its origin in the joint's centre, Z along the unit at zero bend and X
    towards cable s. The covariance follows from the angle's alone: position l (sin θ, 0, cos θ)
    and rotation about Y move together, and what leaves the plane of bending has none.
    """
    sine, cosine = math.sin(bend_angle), math.cos(bend_angle)
    message = PoseWithCovarianceStamped(header=header)
    pose = message.pose.pose
    pose.position.x = design.com_distance * sine
    pose.position.z = design.com_distance * cosine
    pose.orientation.y = math.sin(0.5 * bend_angle)
    pose.orientation.w = math.cos(0.5 * bend_angle)
    # ∂(x, y, z, rotation about x, y, z) / ∂θ
    gradient = (design.com_distance * cosine, 0.0, -design.com_distance * sine, 0.0, 1.0, 0.0)
    variance = bend_angle_stddev * bend_angle_stddev
    message.pose.covariance = [variance * a * b for a in gradient for b in gradient]
    return message


def estimate(
    result: Equilibrium | TrackedState,
    margin: float | None,
    intervals: Sequence[tuple[float, float]],
    tension_stddev: float,
    header: Header,
) -> Estimate:
    """Everything that is known from one pair of tensions; NaN or False where it is not."""
    forces = result.forces or (math.nan,) * 4
    remainder = result.force_remainder or (math.nan,) * 2
    angle_gradient = result.bend_angle_gradient or (math.nan,) * 2
    pressure_gradient = result.pressure_gradient or (math.nan,) * 2
    message = Estimate(
        header=header,
        regime=result.regime.value,
        tension_l=result.tension_l,
        tension_s=result.tension_s,
        bend_angle=_number(result.bend_angle),
        bend_angle_stddev=_number(result.bend_angle_stddev(tension_stddev)),
        pressure=_number(result.pressure),
        pressure_stddev=_number(result.pressure_stddev(tension_stddev)),
        normal_force=_number(result.normal_force),
        slip_margin=_number(margin),
        admissible_angles=[end for interval in intervals for end in interval],
        residual=math.nan,
        branch_consistent=bool(result.branch_consistent),
        pressure_force_x=forces[0],
        pressure_force_z=forces[1],
        friction_force_x=forces[2],
        friction_force_z=forces[3],
        force_remainder_x=remainder[0],
        force_remainder_z=remainder[1],
        bend_angle_by_tension_l=angle_gradient[0],
        bend_angle_by_tension_s=angle_gradient[1],
        pressure_by_tension_l=pressure_gradient[0],
        pressure_by_tension_s=pressure_gradient[1],
    )
    if isinstance(result, Equilibrium):
        message.angle_assured = result.bend_angle is not None
        message.root_count = result.root_count
        message.stable = bool(result.stable)
        message.iterations = result.iterations
        message.residual = _number(result.residual)
    else:
        message.angle_assured = result.angle_assured
    return message


def fill_solve_response(
    response: Solve.Response, equilibrium: Equilibrium, tension_stddev: float
) -> Solve.Response:
    """Put a result into a response of ``~/solve``."""
    response.success = True
    response.regime = equilibrium.regime.value
    response.bend_angle = _number(equilibrium.bend_angle)
    response.pressure = _number(equilibrium.pressure)
    response.bend_angle_stddev = _number(equilibrium.bend_angle_stddev(tension_stddev))
    response.root_count = equilibrium.root_count
    response.stable = bool(equilibrium.stable)
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
    response: SolveInverse.Response, design: JointDesign, request: SolveInverse.Request
) -> SolveInverse.Response:
    """Answer ``~/solve_inverse``, also with the reason for no result."""
    try:
        tensions = tensions_for(
            design,
            request.bend_angle,
            pressure=request.pressure or None,  # 0 stands for not given
            total_tension=request.total_tension or None,
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
