"""Many possible units at once, each followed exactly through tensions of its own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..contact.law import Turn
from ..design import JointDesign
from ..load import DeadLoad
from ..roots import refine
from ..slip import ROUNDING, Slip

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

NEWTON_STEPS = 12
"""Steps to a landing at the most; four or so are taken"""

STILL = 1e-9
"""Step in rad after which the next is not worth taking"""


def slips_of(design: JointDesign, dead: DeadLoad, tensions: Floats) -> Slip:
    """Return the slip functions towards cable s of arrays of tensions.

    Parameters
    ----------
    tensions : ndarray
        T_l and T_s in N, shape ``(2, …)``; where they do not seat the joint the result is NaN.
    """
    tension_l, tension_s = tensions
    taut = (tension_l > 0.0) & (tension_s > 0.0)
    size = np.hypot(dead.force_x, dead.force_z)
    excess = np.where(taut, tension_l + tension_s - size, np.nan)
    excess = np.where(excess > 0.0, excess, np.nan)
    return Slip.towards_s(design, dead, excess, tension_l, tension_s)


class Step:
    """One pair of tensions of every member: where it drives them.

    Attributes
    ----------
    side : ndarray
        To which side each is driven, 1 or −1.
    moves : ndarray
        Whether friction cannot hold it where it was.
    """

    def __init__(self, slip: Slip, angles: Floats, stop: float) -> None:
        cosine, sine = np.cos(angles), np.sin(angles)
        moment = slip.moment.at(angles, cosine, sine)
        self.side = np.where(moment < 0.0, -1.0, 1.0)
        of_tilt, across = slip.tilted(cosine, sine)
        capacity = slip.law.capacity(slip.load, of_tilt, self.side * across)
        self.moves: Flags = self.side * moment > capacity * (1.0 + ROUNDING)
        self.pressed: Flags = self.moves & (self.side * angles >= stop)
        """Whether it is driven on against a stop"""


def follow(design: JointDesign, slips: Slip, angles: Floats) -> tuple[Floats, Flags]:
    """Follow members through the pairs of a path, one after another.

    Parameters
    ----------
    slips : Slip
        The slip functions towards cable s, arrays of shape ``(pairs, members)``.
    angles : ndarray
        Where the members are at first, in rad.

    Returns
    -------
    tuple
        Where they are at the end, and which of them moved at the last pair.
    """
    stop = design.max_bend_angle
    whole = Step(slips, angles, stop)
    driven = whole.moves & ~whole.pressed
    if not driven.any():
        return angles, np.zeros(len(angles), np.bool_)
    first = int(np.argmax(driven.any(axis=1)))
    slips, sides = part_of(slips, slice(first, None)), np.unique(whole.side[driven])
    path = _pushed(slips, angles, stop, sides)
    if path is None and len(sides) == 1:
        path = _pushed(slips, angles, stop, np.array([-1.0, 1.0]))
    if path is None:
        path = _stepped(design, slips, angles)
    return path[-1], path[-1] != path[-2]


def _pushed(slips: Slip, angles: Floats, stop: float, sides: Floats) -> Floats | None:
    """Follow members that a path pushes ahead of it, whose slip functions fall with the angle.

    Each pair then holds one interval of angles, and a member outside is pushed to its end: the
    root of the slip function of that side. All roots are found at once.

    Returns
    -------
    ndarray or None
        Where they are at first and after each pair, shape ``(pairs + 1, members)``; None where
        the functions do not all fall, or members are pushed to a side that is not among `sides`.
    """
    ends = []
    for side in sides:
        facing = slips.facing(side)
        low = max(float((side * angles).min()), -stop)
        least = 0.5 * (low + stop)
        _, greatest = facing.slope_bounds_turn(
            np.cos(least), np.sin(least), Turn.by(0.5 * (stop - low))
        )
        if not np.all((greatest < 0.0) | np.isnan(greatest)):
            return None
        ends.append(
            side
            * _root_of_falling(facing, np.broadcast_to(side * angles, greatest.shape), low, stop)
        )
    path = [angles]
    for row in range(len(ends[0])):
        angles = path[-1]
        for side, end in zip(sides, ends, strict=True):
            angles = np.fmax(angles, end[row]) if side > 0.0 else np.fmin(angles, end[row])
        path.append(angles)
    found = np.array(path)
    if len(sides) == 1:
        after = Step(slips, found[1:], stop)
        if np.any(after.moves & ~after.pressed & (after.side != sides[0])):
            return None
    return found


def _root_of_falling(slips: Slip, place: Floats, lowest: float, stop: float) -> Floats:
    """Roots of falling functions, ahead; the ends of the range where there is none within."""
    low, high = np.full(place.shape, lowest), np.full(place.shape, stop)
    for _ in range(NEWTON_STEPS):
        point = slips.at_turn(place, np.cos(place), np.sin(place))
        excess = point.excess
        low, high = np.where(excess > 0.0, place, low), np.where(excess > 0.0, high, place)
        # Beyond an end Newton's step is cut there, and the function's sign there ends it.
        ahead = np.clip(place - excess / point.slope, low, high)
        still = np.nanmax(np.abs(ahead - place), initial=0.0) < STILL
        place = ahead
        if still:
            break
    return place


def _stepped(design: JointDesign, slips: Slip, angles: Floats) -> Floats:
    """Follow members pair by pair; as `_pushed` returns it."""
    stop = design.max_bend_angle
    path = [angles]
    for index in range(len(slips.total)):
        row = part_of(slips, index)
        step = Step(row, angles, stop)
        moved = step.moves & ~step.pressed
        if moved.any():
            angles = angles.copy()
            angles[moved] = _landings(design, row, step.side, angles, moved)
        path.append(angles)
    return np.array(path)


def part_of(slips: Slip, index: object) -> Slip:
    """Return a part of arrays of slip functions."""

    def part(values: object) -> object:
        return values[index] if np.ndim(values) else values  # type: ignore[index, arg-type]

    return Slip(
        slips.law,
        type(slips.load)(*map(part, slips.load)),
        (part(slips.tilt[0]), part(slips.tilt[1])),
        type(slips.moment)(*map(part, slips.moment)),
        part(slips.total),
        part(slips.side),  # type: ignore[arg-type]
    )


def _landings(
    design: JointDesign, slips: Slip, side: Floats, angles: Floats, which: Flags
) -> Floats:
    """Where those members come to rest that are driven on: the first root ahead, or the stop."""
    stop = design.max_bend_angle
    facing = part_of(slips, which).facing(side[which])
    start = side[which] * angles[which]
    least, greatest = _slope_bounds(facing, start, stop)
    landing = np.full(len(start), stop)
    # Falling all the way: one root, or none before the stop. Rising: none.
    at_stop = facing.value_turn(stop, np.cos(stop), np.sin(stop))
    falling = greatest < 0.0
    rooted = np.flatnonzero(falling & (at_stop < 0.0))
    if len(rooted):
        landing[rooted] = _newton(part_of(facing, rooted), start[rooted], stop)
    for index in np.flatnonzero(~falling & ~(least > 0.0)):
        one = part_of(facing, index)
        found = one.brackets(float(start[index]), stop)
        if found:
            landing[index], _ = refine(one, found[0])
    landings: Floats = side[which] * landing
    return landings


def _slope_bounds(slips: Slip, start: Floats, stop: float) -> tuple[Floats, Floats]:
    """Bounds of ∂g/∂θ from where each member is to the stop."""
    low = float(start.min())
    middle, turn = 0.5 * (low + stop), Turn.by(0.5 * (stop - low))
    return slips.slope_bounds_turn(np.cos(middle), np.sin(middle), turn)


def _newton(slips: Slip, start: Floats, stop: float) -> Floats:
    """The root of functions that fall from `start` to the stop."""
    low, high, place = start, np.full(len(start), stop), start
    for _ in range(NEWTON_STEPS):
        point = slips.at_turn(place, np.cos(place), np.sin(place))
        above = point.excess > 0.0
        low, high = np.where(above, place, low), np.where(above, high, place)
        ahead = place - point.excess / point.slope
        ahead = np.where((ahead >= low) & (ahead <= high), ahead, 0.5 * (low + high))
        still = np.abs(ahead - place).max() < STILL
        place = ahead
        if still:
            break
    return place
