"""Between ROS messages and the physics."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import Float64MultiArray, Header, MultiArrayDimension

from ...estimation.estimate import Estimate as UnitEstimate
from ...estimation.estimate import KnownLoad
from ...estimation.settings import Settings
from ...physics import (
    BendAngleError,
    Equilibrium,
    JointDesign,
    Load,
    LoadError,
    Regime,
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
_UNKNOWN_INTERVAL = (math.nan, math.nan)
_UNKNOWN_FORCES = (math.nan,) * 4
_UNKNOWN_PROBABILITIES = dict.fromkeys(Regime, math.nan)


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


def fill_estimate(message: Estimate, estimate: UnitEstimate, header: Header) -> Estimate:
    """Put all that is known from one pair of tensions into a message.

    It is NaN, False or 0 where it is not known, whatever was in the message before.
    """
    message.header = header
    message.regime = estimate.regime.value
    message.tension_l, message.tension_s = estimate.tension_l, estimate.tension_s
    message.bend_angle = _number(estimate.bend_angle)
    message.bend_angle_stddev = _number(estimate.bend_angle_stddev)
    message.bend_angle_low, message.bend_angle_high = estimate.interval or _UNKNOWN_INTERVAL
    message.provisional = estimate.is_provisional
    probabilities = estimate.regime_probabilities or _UNKNOWN_PROBABILITIES
    message.probability_equilibrium = probabilities[Regime.EQUILIBRIUM]
    message.probability_held = probabilities[Regime.HELD]
    message.probability_slipping = probabilities[Regime.SLIPPING]
    message.probability_driven_to_stop = probabilities[Regime.DRIVEN_TO_STOP]
    message.probability_slack = probabilities[Regime.SLACK]
    message.consistency = estimate.consistency
    message.pressure = _number(estimate.pressure)
    message.pressure_stddev = _number(estimate.pressure_stddev)
    message.normal_force = _number(estimate.normal_force)
    message.slip_margin = _number(estimate.slip_margin)
    intervals = estimate.admissible_angles
    message.admissible_angles = [end for interval in intervals for end in interval]
    message.angle_assured = estimate.angle_assured
    message.branch_consistent = bool(estimate.branch_consistent)
    _fill_load(message, estimate)
    _fill_exact(message, estimate.exact)
    return message


def _fill_load(message: Estimate, estimate: UnitEstimate) -> None:
    """Put what was worked with into a message."""
    load = estimate.load
    message.contact_law = estimate.design.contact_law
    (
        message.gravity_direction_x,
        message.gravity_direction_y,
        message.gravity_direction_z,
    ) = load.gravity_direction
    message.tip_force_x, message.tip_force_z = load.tip_force
    message.tip_distance = load.tip_distance
    message.load_assured = estimate.known.is_assured


def _fill_exact(message: Estimate, exact: Equilibrium | None) -> None:
    """Put into a message what there is where the tensions are believed as they are."""
    if exact is not None and not exact.is_tracked:
        message.root_count = exact.root_count
        message.stable = bool(exact.stable)
        message.iterations = exact.iterations
        message.residual = _number(exact.residual)
    else:
        message.root_count = message.iterations = 0
        message.stable = False
        message.residual = math.nan
    forces: Sequence[float] = _UNKNOWN_FORCES
    remainder: Sequence[float] = _UNKNOWN_INTERVAL
    angle_gradient = pressure_gradient = _UNKNOWN_GRADIENT
    if exact is not None:
        forces = exact.forces or forces
        remainder = exact.force_remainder or remainder
        angle_gradient = exact.bend_angle_gradient or angle_gradient
        pressure_gradient = exact.pressure_gradient or pressure_gradient
    message.pressure_force_x, message.pressure_force_z = forces[:2]
    message.friction_force_x, message.friction_force_z = forces[2:]
    message.force_remainder_x, message.force_remainder_z = remainder
    message.bend_angle_by_tension_l, message.bend_angle_by_tension_s = angle_gradient
    message.pressure_by_tension_l, message.pressure_by_tension_s = pressure_gradient


def asked_load(request: Any, known: KnownLoad) -> KnownLoad:
    """Return the load of a request of ``~/solve`` or ``~/solve_arm``, or the one that is known.

    Raises
    ------
    LoadError
        If it is not valid, or gives a tip force without gravity's direction.
    """
    direction = tuple(map(float, request.gravity_direction))
    tip_force = request.tip_force_x, request.tip_force_z
    distance = getattr(request, 'tip_distance', 0.0)  # of an arm it acts on its end
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
    settings: Settings,
    *,
    load_assured: bool,
) -> Solve.Response:
    """Put a result into a response of ``~/solve``."""
    response.success = True
    response.regime = equilibrium.regime.value
    response.bend_angle = _number(equilibrium.bend_angle)
    response.pressure = _number(equilibrium.pressure)
    response.bend_angle_stddev = _number(
        equilibrium.bend_angle_stddev(settings.tension_stddev, settings.design_uncertainty)
    )
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
