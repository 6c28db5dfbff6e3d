"""The package's contact laws, as the simulations ask them."""

from __future__ import annotations

import math

from tendon_statics.physics.contact import CONTACT_LAWS
from tendon_statics.physics.contact.numbers import FLOATS

from .constructions import BALL_RADIUS, EQUATOR_SEAT, Construction, LooseBowl

LAWS = tuple(CONTACT_LAWS)


def capacity(
    law: str,
    construction: Construction,
    friction: float,
    tension: float,
    axial: float = 0.0,
    transverse: float = 0.0,
) -> float | None:
    """Return K in N·m for slipping towards cable s, or None where the law is not made for that.

    Parameters
    ----------
    tension, axial, transverse : float
        T, P_a and P_t in N.
    """
    if isinstance(construction, LooseBowl):
        if law == 'elastic_seat':
            return None
        construction = EQUATOR_SEAT  # The zone does not count without a load.
    zone = math.radians(construction.start_deg), math.radians(construction.end_deg)
    size = math.hypot(axial, transverse)
    tilt = math.atan2(transverse, axial)
    share = size / tension
    load = (share, 1.0 - share, 1.0 - share * share)
    direction = (math.cos(tilt), math.sin(tilt))
    capacity_share, *_ = (
        CONTACT_LAWS[law](friction, *zone).under(load, direction, FLOATS).at(1.0, 0.0)
    )
    return BALL_RADIUS * tension * float(capacity_share)
