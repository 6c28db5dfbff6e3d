"""Many possible units at once, each followed exactly through tensions of its own."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..array_numbers import ARRAYS
from ..contact.law import map_arrays
from ..design import JointDesign
from ..loaded_joint import LoadedJoint
from ..roots import refine
from ..slip import ROUNDING, Slip
from ..stacked_design import StackedDesign

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

NEWTON_STEPS = 12
"""Steps to a landing at the most; four or so are taken"""

STILL = 1e-9
"""Step in rad after which the next is not worth taking"""


def slips_of(
    units: JointDesign | StackedDesign, joint: LoadedJoint, tensions: Floats, side: float
) -> Slip:
    """Return the slip functions to one side of arrays of tensions.

    Parameters
    ----------
    units : JointDesign or StackedDesign
        Of all members, or one of each.
    joint : LoadedJoint
        Theirs under a dead load, of shapes that broadcast to that of the tensions.
    tensions : ndarray
        T_l and T_s in N, shape ``(2, pairs, members)``; where they do not seat the joint the
        result is NaN.
    """
    tension_l, tension_s = tensions
    if isinstance(units, StackedDesign) or not isinstance(joint.size, float):
        # All arrays of one shape, so that parts can be taken.
        shape = tension_l.shape
        joint = map_arrays(
            joint._replace(size=np.asarray(joint.size) + np.zeros(shape)),
            lambda values: np.broadcast_to(values, shape),
        )
    excess = tension_l + tension_s - joint.size
    seated = np.minimum(np.minimum(tension_l, tension_s), excess) > 0.0
    if np.count_nonzero(seated) < seated.size:
        excess = np.where(seated, excess, np.nan)
    return Slip(joint, excess, tension_l, tension_s, side, ARRAYS)


def towards(slips: Slip, side: float) -> Slip:
    """Return slip functions towards cable s for a side of 1, towards cable l for −1."""
    if isinstance(slips.side, float):
        return slips if slips.side == side else slips.mirrored()
    return slips.facing(side * slips.side)


class Step:
    """Pairs of tensions of every member: where they drive them.

    Parameters
    ----------
    slips : Slip
        The slip functions, best to the side to which most are driven.
    angles : ndarray
        Where the members are in rad.
    stop : float or ndarray
        θ_max in rad, of all or of each.

    Attributes
    ----------
    slips : Slip
        The slip functions, each towards the side to which it drives.
    probe : Probe
        Them at the angles of the members.
    moves : ndarray
        Whether friction cannot hold it where it was.
    """

    def __init__(self, slips: Slip, angles: Floats, stop: Any) -> None:
        probe = slips.probe(slips.side * angles)
        back = probe[5] < 0.0
        if np.count_nonzero(back):
            slips = slips.facing(np.where(back, -1.0, 1.0))
            probe = slips.probe(slips.side * angles)
        self.slips, self.probe = slips, probe
        self.moves: Flags = probe[5] > probe[8][0] * (1.0 + ROUNDING)
        self._angles, self._stop = angles, stop

    @cached_property
    def pressed(self) -> Flags:
        """Whether each is driven on against a stop."""
        at_stop: Flags = self.slips.side * self._angles >= self._stop
        return self.moves & at_stop

    @property
    def side(self) -> Floats:
        """To which side each is driven, 1 or −1."""
        return np.broadcast_to(self.slips.side, self.moves.shape)


def follow(slips: Slip, angles: Floats, stop: Any) -> Sequence[Floats]:
    """Follow members through the pairs of a path, one after another.

    Parameters
    ----------
    slips : Slip
        The slip functions, arrays of shape ``(pairs, members)``.
    angles : ndarray
        Where the members are at first, in rad.
    stop : float or ndarray
        θ_max in rad, of all or of each.

    Returns
    -------
    sequence of ndarray
        Where they are at first and after each pair.
    """
    whole = Step(slips, angles, stop)
    resting = [angles] * (len(whole.moves) + 1)
    if not np.count_nonzero(whole.moves):
        return resting
    driven = whole.moves & ~whole.pressed
    if not np.count_nonzero(driven):
        return resting
    sides = np.unique(whole.side[driven])
    path = _pushed(slips, angles, stop, sides)
    if path is None and len(sides) == 1:
        path = _pushed(slips, angles, stop, np.array([-1.0, 1.0]))
    return _stepped(slips, angles, stop) if path is None else path


def _pushed(slips: Slip, angles: Floats, stop: Any, sides: Floats) -> Sequence[Floats] | None:
    """Follow members that a path pushes ahead of it, whose slip functions fall with the angle.

    Each pair then holds one interval of angles, and a member outside is pushed to its end: the
    root of the slip function of that side. All roots are found at once.

    Returns
    -------
    sequence of ndarray or None
        As `follow` does; None where the functions do not all fall, or members are pushed to a
        side that is not among `sides`.
    """
    ends = []
    for side in sides.tolist():
        facing = towards(slips, side)
        low = float((side * angles).min())
        _, greatest = facing.slope_bounds(facing.probe(low), facing.probe(stop))
        if not np.all((greatest < 0.0) | np.isnan(greatest)):
            return None
        start = np.broadcast_to(side * angles, greatest.shape)
        ends.append(side * _root_of_falling(facing, start, low, stop))
    path = [angles]
    for row in range(len(ends[0])):
        angles = path[-1]
        for side, end in zip(sides, ends, strict=True):
            angles = np.fmax(angles, end[row]) if side > 0.0 else np.fmin(angles, end[row])
        path.append(angles)
    if len(sides) == 1:
        found = np.array(path[1:])
        if np.any(facing.moment_at(side * found) < 0.0):
            after = Step(slips, found, stop)
            if np.any(after.moves & ~after.pressed & (after.side != side)):
                return None
    return path


def _root_of_falling(slips: Slip, place: Floats, lowest: float, stop: Any) -> Floats:
    """Roots of falling functions, ahead; the ends of the range where there is none within."""
    low, high = np.full(place.shape, lowest), np.full(place.shape, stop)
    for _ in range(NEWTON_STEPS):
        _, excess, slope, *_ = slips.probe(place)
        below = excess > 0.0
        low, high = np.where(below, place, low), np.where(below, high, place)
        # Beyond an end Newton's step is cut there, and the function's sign there ends it.
        ahead = np.minimum(np.maximum(place - excess / slope, low), high)
        still = np.abs(ahead - place) < STILL
        place = ahead
        if (still | np.isnan(ahead)).all():
            break
    return place


def _stepped(slips: Slip, angles: Floats, stop: Any) -> Sequence[Floats]:
    """Follow members pair by pair; as `follow` does."""
    path = [angles]
    for index in range(len(slips.total)):
        step = Step(slips.part(index), angles, stop)
        moved = step.moves & ~step.pressed
        if moved.any():
            angles = angles.copy()
            landings = _landings(step.slips.part(moved), angles[moved], _of(stop, moved))
            angles[moved] = landings
        path.append(angles)
    return path


def _of(stop: Any, which: Flags) -> Any:
    return stop[which] if isinstance(stop, np.ndarray) else stop


def _landings(slips: Slip, angles: Floats, stop: Any) -> Floats:
    """Where members come to rest that are driven on: the first root ahead, or the stop."""
    start = slips.side * angles
    lowest = float(start.min())
    at_stop = slips.probe(stop)
    least, greatest = slips.slope_bounds(slips.probe(lowest), at_stop)
    landing = np.full(len(start), stop)
    # Falling all the way: one root, or none before the stop. Rising: none.
    falling = greatest < 0.0
    rooted = falling & (at_stop[1] < 0.0)
    if rooted.any():
        landing[rooted] = _root_of_falling(
            slips.part(rooted), start[rooted], lowest, _of(stop, rooted)
        )
    for index in np.flatnonzero(~falling & ~(least > 0.0)):
        one = slips.one(int(index))
        found = one.brackets(one.probe(float(start[index])), one.probe(float(landing[index])))
        if found:
            landing[index] = refine(one, found[0])[0][0]
    landings: Floats = slips.side * landing
    return landings
