"""Where friction can hold the unit: friction as a set, not a number.

Friction takes any value up to its limit in either direction, so it can hold every angle θ with
|M| ≤ K, with the capacity K on the side of M: where neither slip function, towards cable s or
towards cable l, is above zero.
"""

from __future__ import annotations

import numbers
from collections.abc import Sequence
from itertools import pairwise

from .design import JointDesign
from .errors import BendAngleError
from .load import UPRIGHT, Load
from .roots import refine
from .slip import Probe, Slip
from .tensions import check_tensions, taut_slip

Interval = tuple[float, float]


def admissible_angles(
    design: JointDesign, tension_l: float, tension_s: float, load: Load = UPRIGHT
) -> list[Interval]:
    """Return the angles at which friction can hold the unit, as closed intervals in rad.

    They are ascending and disjoint, within [−θ_max, θ_max]; there may be none, one or several.
    Every angle of `solve`'s regime ``equilibrium`` is an end of one.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, both above 0.
    load : Load
        What acts beside them.

    Raises
    ------
    TensionError
        As `solve` does, and for a slack cable.
    """
    slip = taut_slip(design, check_tensions(tension_l, tension_s), load)
    return angles_held(slip, design.max_bend_angle)


def slip_margin(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    bend_angle: float,
    load: Load = UPRIGHT,
) -> float:
    """Return the signed share of the friction limit that holding an angle asks for.

    It is M / K with the moment M of all but friction, and the capacity K on the side of M. Within
    [−1, 1] friction can hold the angle; above 1 the unit slips towards cable s, below −1 towards
    cable l; at 0 it asks nothing of friction.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, both above 0.
    bend_angle : float
        Angle θ in rad, within ±θ_max.
    load : Load
        What acts beside the cables.

    Raises
    ------
    TensionError
        As `solve` does, and for a slack cable; the joint has to be seated at this angle alone.
    BendAngleError
        If the angle is not a number or lies beyond the stop.
    """
    tensions = check_tensions(tension_l, tension_s)
    angle = check_bend_angle(design, bend_angle)
    return taut_slip(design, tensions, load, bend_angle=angle).margin(angle)


def check_bend_angle(design: JointDesign, bend_angle: float) -> float:
    """Return a bend angle as a float within the stops.

    Raises
    ------
    BendAngleError
        If it is not a number or lies beyond a stop.
    """
    stop = design.max_bend_angle
    is_number = isinstance(bend_angle, numbers.Real) and not isinstance(bend_angle, bool)
    if not (is_number and -stop <= bend_angle <= stop):
        raise BendAngleError(
            f'bend_angle is {bend_angle!r} rad, allowed is {-stop:.6g} to {stop:.6g} rad'
        )
    return float(bend_angle)


def angles_held(
    slip: Slip, stop: float, roots_ahead: Sequence[float] | None = None
) -> list[Interval]:
    """`admissible_angles` of a slip function towards either side, within ±`stop` in rad.

    Parameters
    ----------
    roots_ahead : sequence of float, optional
        All roots of the slip function from 0 to the stop, where they have been found already.
    """
    # A unit does not slip against the moment, so that the other side may go without a search.
    moment_side, everywhere = slip.moment_side(stop), [(-stop, stop)]
    towards_s = everywhere if moment_side < 0.0 else _angles_below_limit(slip, stop, roots_ahead)
    towards_l = everywhere if moment_side > 0.0 else _angles_below_limit(slip.mirrored(), stop)
    if slip.side < 0.0:
        towards_s, towards_l = towards_l, towards_s
    mirrored = [(-high, -low) for low, high in reversed(towards_l)]
    common = [(max(a[0], b[0]), min(a[1], b[1])) for a in towards_s for b in mirrored]
    return [(low, high) for low, high in common if low <= high]


def _angles_below_limit(
    slip: Slip, stop: float, roots_ahead: Sequence[float] | None = None
) -> list[Interval]:
    """Angles ahead with g ≤ 0, where the unit does not slip to the side of the function."""
    # Cut at 0, as `solve` searches, so that its root is the same to the last bit.
    first, (middle, last) = slip.probe(-stop), slip.ends(stop)
    if roots_ahead is None:
        roots_ahead = _roots_between(slip, middle, last)
    roots = list(dict.fromkeys((*_roots_between(slip, first, middle), *roots_ahead)))
    found: list[Interval] = []
    for low, high in pairwise([-stop, *roots, stop]):
        if low < high and _value_between(slip, low, high, first, last) <= 0.0:
            if found and found[-1][1] == low:
                # g changes sign at a root, so one side is below zero by rounding: the narrow one.
                if high - low <= low - found[-1][0]:
                    continue
                found.pop()
            found.append((low, high))
    # A root at the very end of the range, with g above zero beside it, is a point of its own.
    for root in roots:
        if not any(low <= root <= high for low, high in found):
            found.append((root, root))
    # So is a stop that is at the limit but for rounding.
    for probe in (first, last):
        end = probe[0]
        if slip.is_at_limit(probe) and not any(low <= end <= high for low, high in found):
            found.append((end, end))
    return sorted(found)


def _roots_between(slip: Slip, low: Probe, high: Probe) -> list[float]:
    """Return all roots of g between two angles ahead that were probed, ascending."""
    return [refine(slip, bracket)[0][0] for bracket in slip.brackets(low, high)]


def _value_between(slip: Slip, low: float, high: float, first: Probe, last: Probe) -> float:
    """Return g at an angle between two neighbours of its roots and the stops, probed there."""
    for probe in (first, last):
        # g keeps its sign up to the root nearest to a stop.
        if probe[0] in (low, high) and probe[1]:
            return probe[1]  # type: ignore[no-any-return]
    return slip.value(0.5 * (low + high))  # type: ignore[no-any-return]
