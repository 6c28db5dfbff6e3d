"""What a pair of tensions means for the unit: the names that are used on every interface."""

from __future__ import annotations

from enum import Enum


class Regime(str, Enum):
    """What a pair of tensions means for the unit; the values are used on every interface."""

    EQUILIBRIUM = 'equilibrium'
    """The unit is on the verge of slipping at one angle, which is given."""
    HELD = 'held'
    """Friction keeps the unit from slipping towards the stronger cable at every angle from 0 to
    the stop: tensions alone do not determine the angle. For a tracker: where it was."""
    SLIPPING = 'slipping'
    """The unit has slipped and friction holds it again, at its limit; only a tracker says so."""
    DRIVEN_TO_STOP = 'driven_to_stop'
    """At no angle from 0 to the stop can friction keep the unit from slipping towards the stronger
    cable: it slides to the stop. Bent the other way it may be held; `admissible_angles` tells."""
    SLACK = 'slack'
    """A cable carries no tension, which is outside the model."""

    # A member equals its value, so the two must hash alike: what is kept by one is found by the
    # other. `Enum` hashes the name instead, and takes ten times as long.
    __hash__ = str.__hash__

    def __str__(self) -> str:
        return self.value


AT_ROOT, AT_STOP = Regime.EQUILIBRIUM, Regime.DRIVEN_TO_STOP
"""Those in which friction is at its limit, for where microseconds count: to look a member up in an
`Enum` takes twenty times as long as to compare it"""
