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
from itertools import pairwise
from typing import NamedTuple

from .admissible import Interval, check_bend_angle
from .design import JointDesign
from .design_uncertainty import DesignUncertainty
from .force_scores import NORMAL, Doubt, ForceScores, Noise
from .load import UPRIGHT, Load, push_along
from .pushed_unit import BOTH_SIDES, PushedUnit
from .tensions import check_taut, check_tensions

SIDES = {'s': 1.0, 'l': -1.0}
"""Cable to which a unit may slip → side"""

FAR = 1e6
"""Times the scale of the forces that counts as infinite"""

PLACES = (0.3, 1.0, 4.0, 20.0, 200.0)
"""Of the scale of the forces, to either side, at which the ends under noise are looked for"""

TOLERANCE = 1e-7
"""Share of a force to which an end under noise is found"""


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
    _check_deviation('tension_stddev', tension_stddev, 'N')
    _check_deviation('bend_angle_stddev', bend_angle_stddev, 'rad')
    if not 0.5 <= level < 1.0:
        raise ValueError(f'level is {level!r}, allowed is 0.5 to below 1')
    if slipping and slipping not in SIDES:
        raise ValueError(f"slipping is {slipping!r}, allowed is 's', 'l' or empty")
    unit = PushedUnit(design, tensions, angle, load.on(design), push)
    noise = Noise(tension_stddev, bend_angle_stddev, design_covariance)
    if slipping:
        return _at_limit(unit, load, noise, level, SIDES[slipping])
    sides = (-math.copysign(1.0, angle),) if at_stop else BOTH_SIDES
    exact = unit.forces_held(sides)
    if noise.is_none:
        is_free = any(low <= 0.0 <= high for low, high in exact)
        return TipForce(exact, level, float(is_free), at_limit=False)
    doubt = Doubt(ForceScores(unit, load, noise), sides)
    cuts = [end for interval in exact for end in interval if math.isfinite(end)]
    for side in sides:
        cuts += unit.forces_at_limit(side)
    return TipForce(
        _widened(doubt, cuts, unit.total, level), level, doubt.probability(0.0), at_limit=False
    )


def _at_limit(unit: PushedUnit, load: Load, noise: Noise, level: float, side: float) -> TipForce:
    """What is known while friction is at its limit against slipping to a side."""
    forces = sorted(unit.forces_at_limit(side))
    force = forces[0] if len(forces) == 1 else None
    if noise.is_none:
        points = [(one, one) for one in forces]
        stddev = None if force is None else 0.0
        return TipForce(points, level, float(0.0 in forces), True, force, stddev)
    scores = ForceScores(unit, load, noise)
    doubt = Doubt(scores, (), side)
    intervals = _widened(doubt, forces, unit.total, level)
    stddev = None
    if force is not None:
        slope = _slope(lambda at: scores.towards(at, side), force, unit.total)
        stddev = 1.0 / abs(slope) if slope else None
    return TipForce(intervals, level, doubt.probability(0.0), True, force, stddev)


def _check_deviation(name: str, value: float, unit: str) -> None:
    if not 0.0 <= value < math.inf:
        raise ValueError(f'{name} is {value!r} {unit}, allowed is 0 or more')


def _slope(function: Callable[[float], float], place: float, scale: float) -> float:
    step = 1e-6 * (scale + abs(place))
    return (function(place + step) - function(place - step)) / (2.0 * step)


def _widened(doubt: Doubt, cuts: Sequence[float], scale: float, level: float) -> list[Interval]:
    """Return the forces with a doubt up to a level.

    Parameters
    ----------
    cuts : sequence of float
        Ends of the exact set in N, near which the others are.
    scale : float
        Of the forces, in N.
    """

    def beyond(force: float) -> float:
        return doubt.beyond(force, level)

    deviations = NORMAL.inv_cdf(0.5 * (1.0 + level))
    places = {0.0}
    for cut in cuts:
        places.add(cut)
        step = 1e-6 * (scale + abs(cut))
        rate = abs(doubt.bounds(cut + step)[0] - doubt.bounds(cut)[0]) / step
        if 0.0 < rate < math.inf:
            reach = deviations / rate
            places |= {cut + share * reach for share in (-1.5, 1.5)}
    middle = 0.5 * (min(cuts) + max(cuts)) if cuts else 0.0
    spread = scale + (0.5 * (max(cuts) - min(cuts)) if cuts else 0.0)
    places |= {middle + side * share * spread for side in BOTH_SIDES for share in PLACES}
    places |= {middle - FAR * spread, middle + FAR * spread}
    points = [(place, beyond(place)) for place in sorted(places)]
    found: list[Interval] = []
    start = -math.inf if points[0][1] <= 0.0 else math.nan
    for (low, at_low), (high, at_high) in pairwise(points):
        if at_low <= 0.0 < at_high:
            found.append((start, _crossing(beyond, (low, at_low), (high, at_high))))
        elif at_high <= 0.0 < at_low:
            start = _crossing(beyond, (low, at_low), (high, at_high))
    if points[-1][1] <= 0.0:
        found.append((start, math.inf))
    return found


def _crossing(
    function: Callable[[float], float], low: tuple[float, float], high: tuple[float, float]
) -> float:
    """Find where a function changes sign between two places, by the Illinois rule, or halving."""
    for step in range(200):
        (left, at_left), (right, at_right) = low, high
        if right - left <= TOLERANCE * max(abs(left), abs(right), 1e-3):
            break
        place = right - at_right * (right - left) / (at_right - at_left)
        if step % 4 == 3 or not left < place < right:
            place = 0.5 * (left + right)
        value = function(place)
        if value == 0.0:
            return place
        if (value > 0.0) == (at_right > 0.0):
            low, high = (left, 0.5 * at_left), (place, value)
        else:
            low, high = (place, value), (right, 0.5 * at_right)
    return 0.5 * (low[0] + high[0])
