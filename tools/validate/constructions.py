"""What is simulated: joints as geometry, and the hanging unit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

BALL_RADIUS = 0.0078
"""r in m, the paper's"""


class Pads(NamedTuple):
    """Points on the unit that touch the ball, as seen from the centre of the seat."""

    directions: Floats
    """Unit vectors, shape (n, 3); X towards cable s, Z along the unit"""
    shares: Floats
    """Part of the seat's area that each stands for, shape (n,), 1 in all"""


@dataclass(frozen=True)
class TightSeat:
    """A seat of the ball's own radius, from one polar angle to another, all around."""

    start_deg: float
    end_deg: float
    depth: float = 1e-6
    """How far the cables press the unit in, as a share of r: next to nothing, so a hard seat"""
    clearance: float = 0.0

    @property
    def name(self) -> str:
        """What the tables call it."""
        return f'tight seat {self.start_deg:g}° to {self.end_deg:g}°'

    def pads(self, rings: int, azimuths: int) -> Pads:
        """Rings at Gauss points of the cosine, by which area is even; every other is staggered."""
        low, high = (math.cos(math.radians(angle)) for angle in (self.end_deg, self.start_deg))
        nodes, weights = np.polynomial.legendre.leggauss(rings)
        cosine = 0.5 * (high + low) + 0.5 * (high - low) * nodes
        stagger = 0.5 * (np.arange(rings) % 2)
        azimuth = 2.0 * math.pi / azimuths * (np.arange(azimuths) + stagger[:, np.newaxis])
        cosine, azimuth = np.broadcast_arrays(cosine[:, np.newaxis], azimuth)
        sine = np.sqrt(1.0 - cosine**2)
        directions = np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine], axis=-1)
        return Pads(directions.reshape(-1, 3), np.repeat(0.5 * weights / azimuths, azimuths))


@dataclass(frozen=True)
class LooseBowl:
    """A bowl wider than the ball, which it touches at one patch that is free to migrate."""

    clearance: float
    """Of the radii, as a share of r"""
    patch_deg: float = 8.0
    """Half the angle that the patch spans"""

    @property
    def name(self) -> str:
        """What the tables call it."""
        return f'loose bowl, clearance {100.0 * self.clearance:g} %'

    @property
    def depth(self) -> float:
        """How far the cables have to press the unit in for such a patch, as a share of r."""
        return self.clearance * (1.0 / math.cos(math.radians(self.patch_deg)) - 1.0)

    def pads(self, across: int, reach_deg: float) -> Pads:
        """A lattice along the way of the patch, with so many pads over its width."""
        spacing = 2.0 * self.patch_deg / across
        margin = self.patch_deg + 2.0 * spacing
        along, aside = np.meshgrid(
            np.radians(np.arange(-margin, reach_deg + margin, spacing)),
            np.radians(spacing * np.arange(-(across // 2) - 1, across // 2 + 2)),
            indexing='ij',
        )
        directions = np.stack(
            [np.sin(along) * np.cos(aside), np.sin(aside), np.cos(along) * np.cos(aside)], axis=-1
        )
        shares = np.cos(aside).ravel()
        return Pads(directions.reshape(-1, 3), shares / shares.sum())


Construction = TightSeat | LooseBowl

LOW_SEAT = TightSeat(20.0, 50.0)
EQUATOR_SEAT = TightSeat(60.0, 88.49)
BOWL = LooseBowl(0.005)

CASES: tuple[tuple[Construction, float], ...] = (
    *((LOW_SEAT, friction) for friction in (0.1, 0.3, 0.5, 1.05)),
    *((EQUATOR_SEAT, friction) for friction in (0.1, 0.3, 0.5, 1.05)),
    *((BOWL, friction) for friction in (0.1, 0.3, 0.5, 1.05)),
)
"""Construction and friction coefficient"""

CONVERGENCE_CASE = EQUATOR_SEAT, 0.5
"""The one that asks most of the numerical settings"""


@dataclass(frozen=True)
class HangingUnit:
    """A unit that hangs from its joint, so that it comes to rest after it has slipped."""

    seat: TightSeat = LOW_SEAT
    friction: float = 0.4
    cable_offset: float = 0.0025
    """δ in m"""
    com_distance: float = -0.02
    """l in m"""
    mass: float = 0.08
    """In kg"""
    gravity: float = 9.81
    tension_l: float = 3.0
    """In N"""
    tensions_s: tuple[float, ...] = (6.0, 6.25, 6.5)
    """In N, one after the other"""

    @property
    def weight(self) -> float:
        """W in N."""
        return self.mass * self.gravity

    def cable_moment(self, tension_s: float) -> float:
        """ΔT (r + δ) in N·m."""
        return (tension_s - self.tension_l) * (BALL_RADIUS + self.cable_offset)

    def moment(self, tension_s: float, angle: float) -> float:
        """M in N·m, of cables and weight at an angle in rad."""
        of_weight = self.weight * self.com_distance * math.sin(angle)
        return self.cable_moment(tension_s) + of_weight


HANGING = HangingUnit()
