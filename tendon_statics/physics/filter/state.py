"""Where a filter says that a unit is: a distribution, as members of equal weight."""

from __future__ import annotations

import copy
import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..design import JointDesign
from ..load import Load
from ..regime import Regime
from ..tensions import Tensions
from .ensemble import Ensemble
from .members import Step

Floats = NDArray[np.float64]


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
        ensemble: Ensemble | None,
        member_tensions: Floats,
        tension_errors: Floats,
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
        self._ensemble = ensemble
        self._member_tensions = member_tensions
        self._tension_errors = tension_errors

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
            ensemble=None,
            member_tensions=np.empty((2, 0)),
            tension_errors=np.zeros(2),
            provisional=True,
            assured=False,
        )

    def measured(self, angles: Floats) -> FilterState:
        """The same with the angles of the members that a measurement has told, to be kept."""
        found = copy.copy(self)
        for name in ('members', '_step', 'regime_probabilities', '_pressures'):
            found.__dict__.pop(name, None)
        found._angles = angles
        found.provisional, found.assured = False, True
        return found

    @property
    def angle_assured(self) -> bool:
        """`assured`, as an `Equilibrium` calls it, for what takes either."""
        return self.assured

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
        return float(self.members.std()) if len(self.members) and self.assured else None

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
        if not 0.0 < level < 1.0:
            raise ValueError(f'level is {level!r}, allowed is between 0 and 1')
        if not len(self.members):
            return None
        # The truth is as likely as any of n members to be the i-th of these n + 1.
        outside = max(int(0.5 * (1.0 - level) * (len(self.members) + 1) + 1e-9), 1)
        return float(self.members[outside - 1]), float(self.members[-outside])

    @cached_property
    def _step(self) -> Step:
        return self._step_of(self._member_tensions)

    def _step_of(self, tensions: Floats) -> Step:
        """What tensions of the members mean where they are."""
        assert self._ensemble is not None
        slips = self._ensemble.slips(tensions[:, None], [self.load])
        return Step(slips.part(0), self._angles, self._ensemble.stop)

    @cached_property
    def regime_probabilities(self) -> dict[Regime, float]:
        """Probability of each regime; they add up to 1."""
        found = dict.fromkeys(Regime, 0.0)
        if self._ensemble is None:
            found[Regime.SLACK] = 1.0
            return found
        pressed = self._step.pressed
        found[Regime.DRIVEN_TO_STOP] = float(np.mean(pressed))
        found[Regime.SLIPPING] = float(np.mean(self._moved & ~pressed))
        found[Regime.HELD] = float(np.mean(~self._moved & ~pressed))
        return found

    @property
    def regime(self) -> Regime:
        """The most probable regime."""
        return max(self.regime_probabilities.items(), key=lambda item: item[1])[0]

    @cached_property
    def _pressures(self) -> Floats:
        """Pressure of each member in Pa, NaN where the model does not stand behind it."""
        if self._ensemble is None:
            return np.empty(0)
        pressing = self._ensemble.pressing(self._member_tensions, self._tension_errors)
        with np.errstate(all='ignore'):
            step = self._step_of(pressing)
            slips, probe = step.slips, step.probe
            state = probe[8]
            friction = np.minimum(probe[5], state[0])
            normal = slips.law.normal(state, friction)
            *_, consistent = slips.law.contact(state, friction, normal)
            force = np.where(consistent, slips.total * normal, np.nan)
        pressures: Floats = force / self._ensemble.units.contact_area
        return pressures

    @property
    def pressure(self) -> float | None:
        """Median of the pressure in Pa; None where too few members have one."""
        known = self._pressures[np.isfinite(self._pressures)]
        return float(np.median(known)) if 2 * len(known) > len(self._pressures) else None

    @property
    def pressure_stddev(self) -> float | None:
        """Standard deviation of the pressure in Pa."""
        known = self._pressures[np.isfinite(self._pressures)]
        return float(np.std(known)) if 2 * len(known) > len(self._pressures) else None
