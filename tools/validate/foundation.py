"""A tight seat as an elastic foundation that slips everywhere, by direct integration.

The seat presses on the ball with a0 cos t + a1 sin t cos f where that is positive, and has lifted
off elsewhere; t is the angle from the unit's axis, f the azimuth from the plane of bending. Each
point rubs against the way it slides as the unit turns. a0 and a1 follow from the balance of forces
along the unit and across it; the moment of the friction is the capacity.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import root

from .constructions import BALL_RADIUS, Pads, TightSeat

FINE = (100, 400)
"""Rings and azimuths of the integration"""


class SeatConstants(NamedTuple):
    """The means that the law of the elastic seat takes from its zone."""

    lever: float
    """k_c"""
    coupling: float
    """c"""
    tilting: float
    """q"""


def seat_constants(seat: TightSeat) -> SeatConstants:
    """Integrate over the zone adaptively."""
    from scipy.integrate import dblquad  # Here, since it takes long to load.

    start, end = math.radians(seat.start_deg), math.radians(seat.end_deg)

    def mean(function):
        """Mean over the area of a function of cos t, sin t cos f and the lever."""

        def integrand(f, t):
            lever = math.sqrt(1.0 - (math.sin(t) * math.sin(f)) ** 2)
            return math.sin(t) * function(math.cos(t), math.sin(t) * math.cos(f), lever)

        value, _ = dblquad(integrand, start, end, 0.0, 0.5 * math.pi, epsabs=1e-12)
        return value / (0.5 * math.pi * (math.cos(start) - math.cos(end)))

    axial = mean(lambda z, _x, _lever: z**2)
    across = mean(lambda _z, x, _lever: x**2)
    axial_rub = mean(lambda _z, x, lever: x**2 / lever)
    across_rub = mean(lambda z, _x, lever: z**2 / lever)
    moment = mean(lambda z, _x, lever: z * lever)
    return SeatConstants(
        moment / axial, across_rub * axial_rub / (axial * across), axial_rub / across
    )


def capacity(
    pads: Pads, friction: float, tension: float, axial: float = 0.0, transverse: float = 0.0
) -> float:
    """Return K in N·m for slipping towards cable s.

    Parameters
    ----------
    pads : Pads
        Where to integrate.
    tension, axial, transverse : float
        T, P_a and P_t in N.

    Raises
    ------
    RuntimeError
        If no pressures are found that balance the forces.
    """
    x, _, z = pads.directions.T
    lever = np.hypot(x, z)

    def pressed(amplitudes):
        return pads.shares * np.maximum(0.0, amplitudes[0] * z + amplitudes[1] * x)

    def unbalanced(amplitudes):
        pressure = pressed(amplitudes)
        rub = friction * pressure / lever
        return (
            np.sum(pressure * z + rub * x) - tension - axial,
            np.sum(pressure * x - rub * z) + transverse,
        )

    flat = (tension + axial) / np.sum(pads.shares * z**2)
    for tilt in (0.3, 1.0, 3.0, 10.0):
        found = root(unbalanced, (flat, tilt * flat))
        if np.max(np.abs(found.fun)) < 1e-9 * tension:
            return BALL_RADIUS * friction * float(np.sum(pressed(found.x) * lever))
    raise RuntimeError(f'no balance of forces was found at the friction coefficient {friction}')
