"""What pushes at the tip: the forces along a known line that friction does not let one tell apart.

Friction takes any value up to its limit, so a unit at rest at an angle tells its tip force as a
set only: all forces with |M| ≤ K that leave the joint seated. It ends where the unit is about to
slip to one side or the other, or to come off its ball. While it slips to a side, friction is at
its limit, and the set is one of these ends. See `pushed_unit` for the closed form and
`force_scores` for the noise.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from .admissible import Interval, check_bend_angle
from .design import JointDesign
from .design_uncertainty import DesignUncertainty
from .force_ends import STEP, forces_within
from .force_scores import Doubt, ForceScores, Noise
from .load import UPRIGHT, Load, push_along
from .pushed_unit import BOTH_SIDES, PushedUnit
from .tensions import check_taut, check_tensions

SIDES = {'s': 1.0, 'l': -1.0}
"""Cable to which a unit may slip → side"""


NEAR_STOP = 4.0
"""Deviations short of a stop within which a unit may lean on it. The set of forces is the wider
if it does, so that is taken: the share of units that it is wrong for is below 1e-4"""


def may_be_at_stop(design: JointDesign, bend_angle: float, stddev: float) -> bool:
    """Return whether a unit at an angle in rad, with its deviation, may lean on a stop."""
    return abs(bend_angle) + NEAR_STOP * stddev >= design.max_bend_angle


class TipForce(NamedTuple):
    """What is known of the force at the tip, in N along its direction."""

    intervals: list[Interval]
    """Closed intervals that hold it with the probability `level`, rays with an infinite end"""
    level: float
    probability_free: float
    """Probability that nothing at the tip explains the state; at the limit, that of a reading as
    far from nothing"""
    at_limit: bool
    """Whether the unit slips, so that friction is at its limit"""
    force: float | None = None
    """The one force that there is at the limit; None where there are several or none"""
    force_stddev: float | None = None
    """Its standard deviation to first order"""


def tip_force_intervals(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    *,
    bend_angle: float,
    direction: Sequence[float],
    distance: float,
    load: Load = UPRIGHT,
    tension_stddev: float = 0.0,
    bend_angle_stddev: float = 0.0,
    design_covariance: DesignUncertainty | None = None,
    level: float = 0.95,
) -> list[Interval]:
    """Return the forces at the tip with which friction can hold the unit at an angle.

    They are closed intervals in N along the direction, ascending and disjoint: none, where the
    model does not explain the state; one; two or more; rays, with an infinite end. Each end is a
    force at which the unit is about to slip, or the limit of those that leave the joint seated. At
    its stop a unit is not held by friction alone; `tip_force` takes that too, and what the
    arguments mean.

    Without noise the ends are exact, in closed form. With noise they are widened so that the true
    force is inside at the rate `level` if it is at an end of the true set, else more often.

    Raises
    ------
    TensionError, BendAngleError, LoadError
        As `tip_force` does.
    """
    return tip_force(
        *(design, tension_l, tension_s),
        bend_angle=bend_angle,
        direction=direction,
        distance=distance,
        load=load,
        tension_stddev=tension_stddev,
        bend_angle_stddev=bend_angle_stddev,
        design_covariance=design_covariance,
        level=level,
    ).intervals


def tip_force(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    *,
    bend_angle: float,
    direction: Sequence[float],
    distance: float,
    load: Load = UPRIGHT,
    tension_stddev: float = 0.0,
    bend_angle_stddev: float = 0.0,
    design_covariance: DesignUncertainty | None = None,
    level: float = 0.95,
    slipping: str = '',
    at_stop: bool = False,
) -> TipForce:
    """Return what is known of a force at the tip, from tensions and where the unit is.

    Parameters
    ----------
    tension_l, tension_s : float
        Measured cable tensions in N, both above 0.
    bend_angle : float
        Measured θ in rad, within ±θ_max.
    direction : sequence of float
        Unit vector ``(x, z)``, or ``(x, y, z)`` with y of 0, along which the force acts on the
        unit, fixed in the joint frame. Forces against it are negative.
    distance : float
        Where it acts along the unit's axis, in m from the centre of the ball.
    load : Load
        What else acts. A tip force of its own is a known one, to which the one asked for adds.
    tension_stddev : float
        Standard deviation of each tension in N, the two independent.
    bend_angle_stddev : float
        Standard deviation of the angle in rad.
    design_covariance : DesignUncertainty, optional
        Of parameters of the design; without it the design is exact.
    level : float
        Probability with which the intervals hold the true force, from 0.5 to below 1.
    slipping : str
        The cable, ``s`` or ``l``, towards which the unit is known to be slipping; empty if it may
        be at rest.
    at_stop : bool
        Whether the unit may lean on its stop, to the side of the angle, which then carries what
        friction does not.

    Raises
    ------
    TensionError
        If a tension is none, or a cable is slack.
    BendAngleError
        If the angle is not a number or lies beyond the stop.
    LoadError
        If the direction is no unit vector in the plane of bending, or the distance no number.
    ValueError
        If a deviation, the level or `slipping` is not allowed.
    """
    tensions = check_taut(check_tensions(tension_l, tension_s))
    angle = check_bend_angle(design, bend_angle)
    push = push_along(direction, distance)
    noise = checked_noise(tension_stddev, bend_angle_stddev, level, design_covariance)
    if slipping and slipping not in SIDES:
        raise ValueError(f"slipping is {slipping!r}, allowed is 's', 'l' or empty")
    unit = PushedUnit(design, tensions, angle, load.on(design), push)

    def with_design(other: JointDesign) -> PushedUnit:
        return unit._replace(design=other, dead=load.on(other))

    if slipping:
        return _at_limit(unit, with_design, noise, level, SIDES[slipping])
    sides = (-math.copysign(1.0, angle),) if at_stop else BOTH_SIDES
    exact = unit.forces_held(sides)
    if noise.is_none:
        is_free = any(low <= 0.0 <= high for low, high in exact)
        return TipForce(exact, level, float(is_free), at_limit=False)
    doubt = Doubt(ForceScores(unit, noise, with_design), sides)
    cuts = [end for interval in exact for end in interval if math.isfinite(end)]
    for side in sides:
        cuts += unit.forces_at_limit(side)
    return TipForce(
        forces_within(doubt, [(cut, doubt) for cut in cuts], unit.total, level),
        level,
        doubt.probability(0.0),
        at_limit=False,
    )


def _at_limit(
    unit: PushedUnit,
    with_design: Callable[[JointDesign], PushedUnit],
    noise: Noise,
    level: float,
    side: float,
) -> TipForce:
    """What is known while friction is at its limit against slipping to a side."""
    forces = sorted(unit.forces_at_limit(side))
    force = forces[0] if len(forces) == 1 else None
    if noise.is_none:
        points = [(one, one) for one in forces]
        stddev = None if force is None else 0.0
        return TipForce(points, level, float(0.0 in forces), True, force, stddev)
    scores = ForceScores(unit, noise, with_design)
    doubt = Doubt(scores, (), side)
    intervals = forces_within(doubt, [(one, doubt) for one in forces], unit.total, level)
    stddev = None if force is None else stddev_at_limit(scores, force, side, unit.total)
    return TipForce(intervals, level, doubt.probability(0.0), True, force, stddev)


def stddev_at_limit(scores: ForceScores, force: float, side: float, scale: float) -> float | None:
    """Return the deviation in N of a force at which friction is at its limit, if it has one.

    Parameters
    ----------
    scale : float
        Of the forces, in N.
    """
    step = STEP * (scale + abs(force))
    before, after = (scores.towards(force + by, side) for by in (-step, step))
    slope = (after - before) / (2.0 * step)
    return 1.0 / abs(slope) if slope else None


def checked_noise(
    tension_stddev: float,
    bend_angle_stddev: float,
    level: float,
    design_covariance: DesignUncertainty | None = None,
) -> Noise:
    """Return the noise of a state, if it and the level that is asked for are allowed.

    Raises
    ------
    ValueError
        If a deviation or the level is not.
    """
    _check_deviation('tension_stddev', tension_stddev, 'N')
    _check_deviation('bend_angle_stddev', bend_angle_stddev, 'rad')
    if not 0.5 <= level < 1.0:
        raise ValueError(f'level is {level!r}, allowed is 0.5 to below 1')
    return Noise(tension_stddev, bend_angle_stddev, design_covariance)


def _check_deviation(name: str, value: float, unit: str) -> None:
    if not 0.0 <= value < math.inf:
        raise ValueError(f'{name} is {value!r} {unit}, allowed is 0 or more')
