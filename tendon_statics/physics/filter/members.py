"""Many possible units at once, each followed exactly through tensions of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..array_numbers import ARRAYS
from ..loaded_joint import LoadedJoint
from ..roots import refine
from ..slip import ROUNDING, Probe, Slip

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

NEWTON_STEPS = 12
"""Steps to a landing at the most; three or so are taken"""

STILL = 1e-7
"""Step in rad after which the next is not worth taking, being some square of it"""


def slips_of(joint: LoadedJoint, tensions: Floats) -> Slip:
    """Return the slip functions of pairs to the side of the last one's stronger cable.

    Parameters
    ----------
    joint : LoadedJoint
        Theirs under a dead load, of all members or one of each.
    tensions : ndarray
        T_l and T_s in N, shape ``(2, pairs, members)``; where they do not seat the joint the
        result is NaN.
    """
    tension_l, tension_s = tensions
    middle = tension_l.shape[1] // 2
    side = 1.0 if tension_s[-1, middle] >= tension_l[-1, middle] else -1.0
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

    @property
    def pressed(self) -> Flags:
        """Whether each is driven on against a stop."""
        pressed: Flags = self.moves & (self.slips.side * self._angles >= self._stop)
        return pressed

    @property
    def slides(self) -> Flags:
        """Whether each slips from where it was."""
        slides: Flags = self.moves & (self.slips.side * self._angles < self._stop)
        return slides

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
    slides = whole.slides
    if not np.count_nonzero(slides):
        return [angles] * (len(slides) + 1)
    side = whole.slips.side
    sides = [side] if isinstance(side, float) else np.unique(side[slides]).tolist()
    path = _pushed(slips, whole, angles, stop, sides)
    if path is None and len(sides) == 1:
        path = _pushed(slips, whole, angles, stop, [-1.0, 1.0])
    return _stepped(slips, whole, angles, stop) if path is None else path


def _pushed(
    slips: Slip, whole: Step, angles: Floats, stop: Any, sides: Sequence[float]
) -> Sequence[Floats] | None:
    """Follow members that a path pushes ahead of it, whose slip functions fall with the angle.

    Each pair then holds one interval of angles, and a member outside is pushed to its end: the
    root of the slip function of that side. All roots are found at once.

    Returns
    -------
    sequence of ndarray or None
        As `follow` does; None where the functions do not all fall, or members are pushed to a
        side that is not among `sides`.
    """
    is_one_way = len(sides) == 1
    ends = []
    for side in sides:
        facing = towards(slips, side)
        start = whole.probe if facing is whole.slips else facing.probe(side * angles)
        # What lies behind counts only for a member that is pushed there by the other side.
        behind = start if is_one_way else facing.probe(-stop)
        _, greatest = facing.slope_bounds(behind, facing.probe(stop))
        if np.count_nonzero(greatest >= 0.0):
            return None
        ends.append(side * _root_of_falling(facing, start, behind[0], stop))
    path = [angles]
    for pair in zip(*ends, strict=True):
        for side, end in zip(sides, pair, strict=True):
            angles = np.fmax(angles, end) if side > 0.0 else np.fmin(angles, end)
        path.append(angles)
    if is_one_way:
        found = np.array(path[1:])
        if np.count_nonzero(facing.moment_at(side * found) < 0.0):
            after = Step(slips, found, stop)
            if np.count_nonzero(after.slides & (after.side != side)):
                return None
    return path


def _root_of_falling(slips: Slip, start: Probe, lowest: Any, stop: Any) -> Floats:
    """Roots of falling functions; the ends of the range where there is none within.

    Parameters
    ----------
    slips : Slip
    start : Probe
        Where they are looked for first.
    lowest, stop : float or ndarray
        The range in rad ahead.
    """
    probe, low, high = start, lowest, stop
    ahead: Floats
    for _ in range(NEWTON_STEPS):
        place, excess, slope, *_ = probe
        below = excess > 0.0
        low, high = np.where(below, place, low), np.where(below, high, place)
        # Beyond an end Newton's step is cut there, and the function's sign there ends it.
        ahead = np.minimum(np.maximum(place - excess / slope, low), high)
        if not np.count_nonzero(np.abs(ahead - place) >= STILL):
            break
        probe = slips.probe(ahead)
    return ahead


def _stepped(slips: Slip, whole: Step, angles: Floats, stop: Any) -> Sequence[Floats]:
    """Follow members from one pair at which some slip to the next; as `follow` does."""
    path, step = [angles], whole
    while True:
        slide = np.flatnonzero(step.slides.any(axis=1))
        if not len(slide):
            return path + [angles] * len(step.moves)
        first = int(slide[0])
        path += [angles] * first
        who = step.slides[first]
        angles = angles.copy()
        angles[who] = _landings(step.slips.part((first, who)), angles[who], _of(stop, who))
        path.append(angles)
        if len(path) > len(slips.total):
            return path
        step = Step(slips.part(slice(len(path) - 1, None)), angles, stop)


def _of(stop: Any, which: Flags) -> Any:
    return stop[which] if isinstance(stop, np.ndarray) else stop


def _landings(slips: Slip, angles: Floats, stop: Any) -> Floats:
    """Where members come to rest that are driven on: the first root ahead, or the stop."""
    start, at_stop = slips.probe(slips.side * angles), slips.probe(stop)
    least, greatest = slips.slope_bounds(start, at_stop)
    landing = np.full(len(angles), stop)
    # Falling all the way: one root, or none before the stop. Rising: none.
    falling = greatest < 0.0
    rooted = falling & (at_stop[1] < 0.0)
    if rooted.any():
        those, behind = slips.part(rooted), start[0][rooted]
        landing[rooted] = _root_of_falling(those, those.probe(behind), behind, _of(stop, rooted))
    for index in np.flatnonzero(~falling & ~(least > 0.0)):
        one = slips.one(int(index))
        found = one.brackets(one.probe(float(start[0][index])), one.probe(float(landing[index])))
        if found:
            landing[index] = refine(one, found[0])[0][0]
    landings: Floats = slips.side * landing
    return landings
