"""Where a filter says that a unit is: a distribution, as members of equal weight."""

from __future__ import annotations

import copy
import math
from functools import cached_property
from statistics import median
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..design import JointDesign
from ..load import Load
from ..regime import Regime
from ..slip import Slip
from ..stacked_design import StackedDesign
from ..tensions import Tensions
from .members import Step

Floats = NDArray[np.float64]

SURE = 0.99
"""Probability of a stop above which it tells where the unit is"""

LOOKS = 9
"""Angles from stop to stop at which it is seen whether friction holds a unit"""


class Slips(Protocol):
    """The slip functions of the members of a joint, at the tensions of one sample."""

    @property
    def units(self) -> JointDesign | StackedDesign:
        """The design of all members, or one of each."""

    def driving(self) -> Slip:
        """Return them at the tensions that drive the members."""

    def driving_and_pressing(self) -> Slip:
        """Return them in two rows: at those, and at the tensions that press the joints.

        The sum of the latter has its own error. Both at once, since a call of NumPy takes as long
        for two rows as for one.
        """


class FilterState:
    """Where a unit is under noise, and what holds it there. What is not determined is None.

    Attributes
    ----------
    design : JointDesign
    load : Load
    time : float
        Of the pair of tensions, in s.
    tension_l, tension_s : float
        In N: as given, or smoothed for a committed state.
    members : ndarray
        Angles of the possible units in rad, ascending; empty while a cable is slack.
    provisional : bool
        Whether it may be taken back when more samples have come.
    assured : bool
        False once a cable has been slack, until a stop, a measurement or a reset.
    consistency : float
        As `StickSlipFilter.consistency` then.
    slips : Slips
        The slip functions of the members; None while a cable is slack.
    """

    def __init__(
        self,
        design: JointDesign,
        load: Load,
        time: float,
        tensions: Tensions,
        *,
        angles: Floats,
        moved: NDArray[np.bool_],
        slips: Slips | None,
        provisional: bool,
        assured: bool,
        consistency: float = math.nan,
    ) -> None:
        self.design = design
        self.load = load
        self.time = time
        self.tension_l, self.tension_s = tensions
        self.provisional = provisional
        self.assured = assured
        self.consistency = consistency
        self._angles = angles
        self._moved = moved
        self.slips = slips

    @classmethod
    def slack(
        cls, design: JointDesign, load: Load, time: float, tensions: Tensions
    ) -> FilterState:
        """A state of which nothing is known, since a cable is slack."""
        nobody = np.empty(0)
        return cls(
            *(design, load, time, tensions),
            angles=nobody,
            moved=nobody > 0.0,
            slips=None,
            provisional=True,
            assured=False,
        )

    def measured(
        self, angles: Floats, slips: Slips | None = None, *, assured: bool = True
    ) -> FilterState:
        """The same with the angles of the members that a measurement has told, to be kept.

        Parameters
        ----------
        slips : Slips, optional
            Where these have changed with it.
        assured : bool
            Whether it is known where the unit is.
        """
        found = copy.copy(self)
        for name in ('members', '_step', 'regime_probabilities', '_pressures'):
            found.__dict__.pop(name, None)
        found._angles = angles
        found.slips = slips or self.slips
        found.provisional, found.assured = False, assured
        return found

    @property
    def angle_assured(self) -> bool:
        """`assured`, as an `Equilibrium` calls it, for what takes either."""
        return self.assured

    @property
    def is_told_by_stop(self) -> bool:
        """Whether the unit is at a stop wherever it was, as friction holds it nowhere else."""
        slips = self.slips
        if slips is None or self.regime_probabilities[Regime.DRIVEN_TO_STOP] <= SURE:
            return False
        slip, stop = slips.driving(), slips.units.max_bend_angle
        at = [np.full(len(self._angles), share * stop) for share in np.linspace(-1.0, 1.0, LOOKS)]
        sides = [np.array([of.value(angles) for angles in at]) for of in (slip, slip.mirrored())]
        beyond = (sides[0] > 0.0).all(axis=0) | (sides[1] > 0.0).all(axis=0)
        return float(beyond.mean()) > SURE

    @cached_property
    def members(self) -> Floats:
        """Angles of the possible units in rad, ascending."""
        return np.sort(self._angles)

    @property
    def bend_angle(self) -> float | None:
        """Median of the angle in rad."""
        members = self.members
        return float(members[len(members) // 2]) if len(members) else None

    @property
    def bend_angle_stddev(self) -> float | None:
        """Standard deviation of the angle in rad."""
        return _deviation(self.members) if len(self.members) and self.assured else None

    def interval(self, level: float = 0.95) -> tuple[float, float] | None:
        """Return the interval in rad that holds the angle with a probability, None if unknown.

        Parameters
        ----------
        level : float
            Between 0 and 1. The extreme members, 95 %, are as far as it goes.

        Raises
        ------
        ValueError
            If the level is not between 0 and 1.
        """
        return interval_of(self.members, level)

    @cached_property
    def _step(self) -> Step:
        """Where tensions drive the members, in one row, and how they press them, in another."""
        slips = self.slips
        assert slips is not None
        with np.errstate(all='ignore'):  # Errors may leave a member with no tension to press.
            return Step(slips.driving_and_pressing(), self._angles, slips.units.max_bend_angle)

    @cached_property
    def regime_probabilities(self) -> dict[Regime, float]:
        """Probability of each regime; they add up to 1."""
        found = dict.fromkeys(Regime, 0.0)
        if self.slips is None:
            found[Regime.SLACK] = 1.0
            return found
        pressed, moved = self._step.pressed[0], self._moved
        members = len(moved)
        driven, slipping = np.count_nonzero(pressed), np.count_nonzero(moved & ~pressed)
        found[Regime.DRIVEN_TO_STOP] = driven / members
        found[Regime.SLIPPING] = slipping / members
        found[Regime.HELD] = (members - driven - slipping) / members
        return found

    @property
    def regime(self) -> Regime:
        """The most probable regime."""
        return max(self.regime_probabilities.items(), key=lambda item: item[1])[0]

    @cached_property
    def _pressures(self) -> Floats:
        """Pressures in Pa of those members that the model stands behind, if these are most."""
        if self.slips is None:
            return np.empty(0)
        slips, probe = self._step.slips, self._step.probe
        state = probe[8]
        with np.errstate(all='ignore'):
            friction = np.minimum(probe[5], state[0])
            normal = slips.law.normal(state, friction)
            known = slips.law.consistent(state, friction)[1]
            pressures = (slips.total * normal)[1] / self.slips.units.contact_area
        known &= np.isfinite(pressures)
        found: Floats = pressures[known]
        return found if 2 * len(found) > len(pressures) else found[:0]

    @property
    def pressure(self) -> float | None:
        """Median of the pressure in Pa; None where too few members have one."""
        return median(self._pressures.tolist()) if len(self._pressures) else None

    @property
    def pressure_stddev(self) -> float | None:
        """Standard deviation of the pressure in Pa."""
        return _deviation(self._pressures) if len(self._pressures) else None


def _deviation(values: Floats) -> float:
    """Return the standard deviation of some numbers, in a third of the time of `np.std`."""
    off = values - np.add.reduce(values) / len(values)
    return math.sqrt(np.add.reduce(off * off) / len(values))


def interval_of(members: Floats, level: float) -> tuple[float, float] | None:
    """Return the interval that holds a number with a probability; None without members.

    Parameters
    ----------
    members : ndarray
        What the number is to each member, ascending.

    Raises
    ------
    ValueError
        If the level is not between 0 and 1.
    """
    if not 0.0 < level < 1.0:
        raise ValueError(f'level is {level!r}, allowed is between 0 and 1')
    if not len(members):
        return None
    # The truth is as likely as any of n members to be the i-th of these n + 1.
    outside = max(int(0.5 * (1.0 - level) * (len(members) + 1) + 1e-9), 1)
    return float(members[outside - 1]), float(members[-outside])
