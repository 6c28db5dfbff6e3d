"""Many possible units at once, each followed exactly through tensions of its own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..array_numbers import ARRAYS
from ..design import JointDesign
from ..load import DeadLoad
from ..roots import refine
from ..slip import ROUNDING, LoadedJoint, Slip

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
    joint = LoadedJoint.of(design, dead)
    excess = np.where(taut, tension_l + tension_s - joint.size, np.nan)
    excess = np.where(excess > 0.0, excess, np.nan)
    return Slip(joint, excess, tension_l, tension_s, numbers=ARRAYS)


class Step:
    """One pair of tensions of every member: where it drives them.

    Attributes
    ----------
    side : ndarray
        To which side each is driven, 1 or −1.
    moves : ndarray
        Whether friction cannot hold it where it was.
    """

    def __init__(self, slips: Slip, angles: Floats, stop: float) -> None:
        probe = slips.probe(angles)
        self.side = np.where(probe[5] < 0.0, -1.0, 1.0)
        if np.any(self.side < 0.0):
            slips = slips.facing(self.side)
            probe = slips.probe(self.side * angles)
        self.slips = slips
        """The slip functions, each towards the side to which it drives"""
        self.probe = probe
        """Them at the angles of the members"""
        self.moves: Flags = probe[5] > probe[8][0] * (1.0 + ROUNDING)
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
    slips, sides = slips.part(slice(first, None)), np.unique(whole.side[driven])
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
        _, greatest = facing.slope_bounds(facing.probe(low), facing.probe(stop))
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
        _, excess, slope, *_ = slips.probe(place)
        low, high = np.where(excess > 0.0, place, low), np.where(excess > 0.0, high, place)
        # Beyond an end Newton's step is cut there, and the function's sign there ends it.
        ahead = np.clip(place - excess / slope, low, high)
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
        row = slips.part(index)
        step = Step(row, angles, stop)
        moved = step.moves & ~step.pressed
        if moved.any():
            angles = angles.copy()
            angles[moved] = _landings(design, row, step.side, angles, moved)
        path.append(angles)
    return np.array(path)


def _landings(
    design: JointDesign, slips: Slip, side: Floats, angles: Floats, which: Flags
) -> Floats:
    """Where those members come to rest that are driven on: the first root ahead, or the stop."""
    stop = design.max_bend_angle
    facing = slips.part(which).facing(side[which])
    start = side[which] * angles[which]
    at_stop = facing.probe(stop)
    least, greatest = facing.slope_bounds(facing.probe(float(start.min())), at_stop)
    landing = np.full(len(start), stop)
    # Falling all the way: one root, or none before the stop. Rising: none.
    falling = greatest < 0.0
    rooted = np.flatnonzero(falling & (at_stop[1] < 0.0))
    if len(rooted):
        landing[rooted] = _root_of_falling(
            facing.part(rooted), start[rooted], float(start.min()), stop
        )
    for index in np.flatnonzero(~falling & ~(least > 0.0)):
        one = facing.one(int(index))
        found = one.brackets(one.probe(float(start[index])), one.probe(stop))
        if found:
            landing[index] = refine(one, found[0])[0][0]
    landings: Floats = side[which] * landing
    return landings
