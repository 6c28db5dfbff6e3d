"""What is said of a unit after a pair of tensions, whichever way it was worked out."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from enum import Enum
from typing import Any, ClassVar, NamedTuple

from ..physics import Equilibrium, JointDesign, Load, Regime
from ..physics.kept import kept
from .settings import Settings

Interval = tuple[float, float]


class KnownLoad(NamedTuple):
    """What acts on the unit beside its cables, as far as it is known."""

    load: Load
    is_assured: bool = True
    """Whether all of it is of the present"""
    is_measured: bool = True
    """False while a sensor that is to tell it has said nothing at all"""


class Sample(NamedTuple):
    """The tensions of all cables that are believed, and what is known with them."""

    tensions: tuple[float, ...]
    """N, 0 of a slack cable; of a unit those of cables l and s"""
    known: KnownLoad
    time: float
    """When it was taken, on a clock in s that only goes forward"""
    measured: float = math.nan
    """When it was measured, on any clock in s; NaN if that is not known"""
    is_confirmed: bool = True
    """False of the first that a rate is checked of, which may be a spike"""

    @property
    def pair(self) -> tuple[float, float]:
        """Those of cables l and s of a unit in N."""
        tension_l, tension_s = self.tensions
        return tension_l, tension_s


class Remark(Enum):
    """What is not as it should be with an estimate; the values are for the user, worst first."""

    UNEXPLAINED = (
        'the model does not explain the measured angle: friction, a load cell, a sign or a cable '
        'is not as the parameters say'
    )
    LOAD = (
        'the load is not assured: what says where gravity points, or the force on the tip, does '
        'not come'
    )
    UNASSURED = 'the unit may have moved unseen, so that its angle is not assured'
    NOISE = (
        'noise of tension_stddev alone can slip the unit, and by more than a degree, where each '
        'sample is believed: estimation: filtering is for such load cells'
    )
    HELD = 'held, so that tensions do not determine the angle'
    OTHER_ROOT = 'forces ask for the other root of the model'

    @property
    def is_logged(self) -> bool:
        """Whether it is said in the log too, once, since it is of the unit and not of a moment."""
        return self in (Remark.UNEXPLAINED, Remark.NOISE)


class AnyEstimate(ABC):
    """What is said after a set of tensions, of a unit or of an arm.

    Attributes
    ----------
    known : KnownLoad
        What acted beside the cables.
    """

    known: KnownLoad

    has_parts: ClassVar[bool] = False
    """Whether it is of several joints, so that the summary says which asks for attention"""

    is_confirmed = True
    """False where the tensions are a first reading that may be a spike"""

    is_provisional = False
    """Whether it may be taken back when more tensions have come"""

    measured = math.nan
    """When the tensions were, as given, in s; NaN where it goes without saying"""

    @property
    def is_sure(self) -> bool:
        """Whether load and tensions are such that something of it may be assured."""
        return self.known.is_assured and self.is_confirmed

    @property
    @abstractmethod
    def summary(self) -> str:
        """What has become of it, in a word or few, for people."""

    @property
    @abstractmethod
    def remarks(self) -> list[Remark]:
        """What is not as it should be."""

    @abstractmethod
    def as_dict(self) -> dict[str, Any]:
        """Return it by name, ready for JSON; what is not known is None."""

    @property
    def slow_remarks(self) -> list[Remark]:
        """What else is not, which takes too long to look at each time; a report looks at one."""
        return []

    def place_of(self, _remark: Remark) -> str:
        """Return of which part a remark is, for people; empty if there is but one."""
        return ''


class Estimate(AnyEstimate):
    """What is said of a unit; what is not known is None, or NaN. Angles are in rad.

    What follows from the angle is worked out when it is asked for.

    Attributes
    ----------
    known : KnownLoad
        What acted beside the cables.
    settings : Settings
        What it was worked out with.
    regime : Regime
        What the tensions mean for the unit; the most probable, where that is not sure.
    tension_l, tension_s : float
        In N, 0 of a slack cable.
    bend_angle : float, optional
        θ, positive towards cable s.
    """

    consistency = math.nan
    """Probability of the measured angles under the model; NaN where none are held against it"""

    def __init__(
        self,
        known: KnownLoad,
        settings: Settings,
        regime: Regime,
        tensions: tuple[float, float],
        bend_angle: float | None,
    ) -> None:
        self.known = known
        self.settings = settings
        self.regime = regime
        self.tension_l, self.tension_s = tensions
        self.bend_angle = bend_angle

    @property
    def summary(self) -> str:
        """The regime."""
        return self.regime.value

    @property
    def design(self) -> JointDesign:
        """The unit's design."""
        return self.settings.design

    @property
    def load(self) -> Load:
        """What acted beside the cables."""
        return self.known.load

    @property
    @abstractmethod
    def bend_angle_stddev(self) -> float | None:
        """Its standard deviation; None also where the angle is not assured."""

    @property
    def interval(self) -> Interval | None:
        """Ends of the interval that holds the angle with the probability of the settings."""
        return None

    @property
    def regime_probabilities(self) -> Mapping[Regime, float] | None:
        """Probability of each regime that it may be; they add up to 1."""
        return None

    @property
    @abstractmethod
    def angle_assured(self) -> bool:
        """Whether the unit cannot have moved unseen."""

    @property
    @abstractmethod
    def pressure(self) -> float | None:
        """P in Pa."""

    @property
    @abstractmethod
    def pressure_stddev(self) -> float | None:
        """Its standard deviation in Pa."""

    @property
    def normal_force(self) -> float | None:
        """N in N."""
        pressure = self.pressure
        return None if pressure is None else pressure * self.design.contact_area

    @kept
    def slip_margin(self) -> float | None:
        """M / K at the angle, under these tensions."""
        raise NotImplementedError

    @kept
    def admissible_angles(self) -> list[Interval]:
        """Where friction can hold the unit under these tensions; none while a cable is slack."""
        raise NotImplementedError

    @property
    def exact(self) -> Equilibrium | None:
        """The model's answer, with its forces and gradients, where each sample is believed."""
        return None

    @property
    @abstractmethod
    def branch_consistent(self) -> bool | None:
        """Whether the forces ask for the root that was taken; None where there is no angle."""

    @property
    def remarks(self) -> list[Remark]:
        """What is not as it should be."""
        found = []
        if not self.known.is_assured:
            found.append(Remark.LOAD)
        if self.branch_consistent is False:
            found.append(Remark.OTHER_ROOT)
        return found

    def as_dict(self) -> dict[str, Any]:
        """Return it by name, ready for JSON; what is not known is None."""
        exact, interval = self.exact, self.interval or (None, None)
        probabilities = self.regime_probabilities
        found = {
            'regime': self.regime.value,
            'tension_l': self.tension_l,
            'tension_s': self.tension_s,
            'bend_angle': self.bend_angle,
            'slip_margin': self.slip_margin,
            'pressure': self.pressure,
            'normal_force': self.normal_force,
            'branch_consistent': self.branch_consistent,
        }
        return (
            found
            | (exact.as_dict() if exact else {})
            | {
                'angle_assured': self.angle_assured,
                'bend_angle_stddev': self.bend_angle_stddev,
                'bend_angle_low': interval[0],
                'bend_angle_high': interval[1],
                'pressure_stddev': self.pressure_stddev,
                'regime_probabilities': None
                if probabilities is None
                else {regime.value: share for regime, share in probabilities.items()},
                'consistency': None if math.isnan(self.consistency) else self.consistency,
                'provisional': self.is_provisional,
            }
        )
