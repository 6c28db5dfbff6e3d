"""From a joint that is to slip first, back to the tensions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ArmError, TensionError, UnreachableError
from ..load import UPRIGHT, Load
from .arm import SIDES, Arm
from .cables import crossings, transmitted
from .carried import Carried
from .excess import Excess
from .joints import arm_margins, check_bend_angles, check_joint

Floats = NDArray[np.float64]

MOST_ROUNDS = 50
SETTLED = 1e-10
"""Change of the tensions, over their range, at which the search ends"""

SEATED = 1.0 + 1e-6
"""Tension at each joint over the least that seats it"""


def arm_tensions_for(
    arm: Arm,
    joint: int,
    side: str,
    *,
    tension_range: tuple[float, float],
    bend_angles: Sequence[float] | None = None,
    load: Load = UPRIGHT,
) -> dict[str, float]:
    """Return tensions that bring one joint to its limit, and all others as little as can be.

    With these the joint's margin is ±1, and the largest |margin| of all other joints is as small
    as any tensions within the range let it. Which joint of several alike slips first is decided by
    small terms, weights above all; a pair of cables that ends at the joint decides it for sure.

    Parameters
    ----------
    joint : int
        Counted from 1 at the base.
    side : str
        ``l`` or ``s``: where it is to slip to.
    tension_range : tuple of float
        Least and greatest tension in N of every cable; the least is above 0.
    bend_angles : sequence of float, optional
        Where the joints are, in rad; None: the arm is straight.
    load : Load
        As `ArmTracker.update` takes it. Friction of the cables on their guides is taken as not
        used.

    Raises
    ------
    UnreachableError
        If no tensions within the range do it, with the reason: the joint does not come to its
        limit, or another one does before.
    ArmError, BendAngleError, LoadError
        If the arm has no such joint or side, or the range is none.
    """
    index = check_joint(arm, joint)
    if side not in SIDES:
        raise ArmError(f'side is {side!r}, allowed is l or s')
    low, high = _checked_range(tension_range)
    angles = check_bend_angles(arm, [0.0] * len(arm.units) if bend_angles is None else bend_angles)
    search = _Search(arm, index, 1.0 if side == 's' else -1.0, (low, high), angles, load)
    try:
        tensions = search.run()
        margins = arm_margins(arm, angles, tensions, load)
    except TensionError as error:
        raise UnreachableError(str(error)) from None
    others = [abs(margin) for i, margin in enumerate(margins) if i != index]
    if others and max(others) >= 1.0:
        first = max(range(len(margins)), key=lambda i: abs(margins[i]) if i != index else 0.0)
        raise UnreachableError(
            f'joint {first + 1} slips before joint {joint} does: with {low:g} to {high:g} N on '
            f'each cable its margin is {margins[first]:+.4g} at best when that of joint {joint} '
            f'is {margins[index]:+.4g}; cables that end between the two would part them'
        )
    return tensions


def _checked_range(tension_range: object) -> tuple[float, float]:
    try:
        low, high = (float(value) for value in tension_range)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        low = high = 0.0
    if not 0.0 < low < high < float('inf'):
        raise ArmError(
            f'tension_range is {tension_range!r}, two tensions in N are needed, '
            'the first above 0 and the second above the first'
        )
    return low, high


class _Search:
    """A linear program for the tensions and the largest margin t of the others, over and over.

    M is linear in the tensions and K nearly so, so a few rounds do.
    """

    def __init__(
        self,
        arm: Arm,
        index: int,
        side: float,
        tension_range: tuple[float, float],
        angles: list[float],
        load: Load,
    ) -> None:
        self._arm, self._index, self._side = arm, index, side
        self._range, self._angles = tension_range, angles
        self._crossing, self._carried = crossings(arm), Carried(arm, load)
        count = len(arm.cables)
        self._seats = np.array(
            [
                [-1.0 if cable.last_unit > joint else 0.0 for cable in arm.cables]
                for joint in range(len(arm.units))
            ]
        )
        self._least = np.array(
            [SEATED * self._carried.least_tension(joint) for joint in range(len(arm.units))]
        )
        self._start = np.full(count, 0.5 * sum(tension_range))

    def run(self) -> dict[str, float]:
        tensions, level = self._start, 1.0
        for _ in range(MOST_ROUNDS):
            before = tensions
            tensions, level = self._round(tensions, level)
            if abs(tensions - before).max() <= SETTLED * self._range[1]:
                break
        return dict(zip(self._arm.cable_names, tensions.tolist(), strict=True))

    def _round(self, tensions: Floats, level: float) -> tuple[Floats, float]:
        """Solve the program that is linear about some tensions and some t."""
        at_joints = transmitted(self._arm, tensions.tolist(), self._angles, None)
        excess = Excess(self._arm, self._crossing, self._carried, tensions.tolist(), at_joints)
        look = excess.at(self._angles)
        rows, limits = [], []
        for joint in range(len(self._arm.units)):
            for side in (1.0, -1.0):
                if joint == self._index and side != self._side:
                    continue
                moment, capacity = side * look.moments[joint], look.capacity(joint, side)[0]
                by_moment = side * self._arm.cable_levers[joint]
                by_capacity = by_moment - side * excess.by_tensions({joint: side}, look)[0]
                if joint == self._index:
                    to_limit = by_moment - by_capacity
                    missing = capacity - moment + to_limit @ tensions
                    continue
                slope = by_moment - level * by_capacity
                rows.append([*slope, -capacity])
                limits.append(slope @ tensions - moment)
        return self._solve(rows, limits, to_limit, float(missing))

    def _solve(
        self, rows: list[Any], limits: list[Any], to_limit: Floats, missing: float
    ) -> tuple[Floats, float]:
        from scipy.optimize import linprog  # here: who tracks an arm should not wait for it

        count = len(to_limit)
        seats = np.hstack([self._seats, np.zeros((len(self._seats), 1))])
        found = linprog(
            [*[0.0] * count, 1.0],
            A_ub=np.array([*rows, *seats]),
            b_ub=np.array([*limits, *-self._least]),
            A_eq=[[*to_limit, 0.0]],
            b_eq=[missing],
            bounds=[self._range] * count + [(0.0, None)],
        )
        if not found.success:
            raise UnreachableError(self._why_not(to_limit))
        return found.x[:-1], float(found.x[-1])

    def _why_not(self, to_limit: Floats) -> str:
        """Say how far the joint can be brought."""
        low, high = self._range
        best = np.where(to_limit > 0.0, high, low).tolist()
        tensions = dict(zip(self._arm.cable_names, best, strict=True))
        margin = arm_margins(self._arm, self._angles, tensions, self._carried.load)[self._index]
        joint, side = self._index + 1, 's' if self._side > 0.0 else 'l'
        if margin * self._side < 1.0:
            return (
                f'joint {joint} does not come to its limit towards {side}: with {low:g} to '
                f'{high:g} N on each cable its margin is {margin:+.4g} at most'
            )
        return (
            f'joint {joint} is beyond its limit towards {side} with any tensions of {low:g} to '
            f'{high:g} N that seat the joints'
        )
