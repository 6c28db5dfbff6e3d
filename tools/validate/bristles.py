"""The unit on bristles, turned step by step: exact Coulomb friction, no time, no mass.

Every point of the seat has a spring along the ball's normal, which only pushes, and a bristle
along its surface, which slides where it would pull harder than μ times the pressure. The angle
grows in steps; after each the unit shifts in the plane to where the forces balance.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import root

from .constructions import Construction, LooseBowl, Pads

BRISTLE_STIFFNESS = 0.8
"""Of a bristle, as a share of the normal spring's; steel against steel has 0.8"""
FINE_SEAT, FINE_BOWL = (12, 72), 16
STEPS = 60
"""Between an angle and the double of it"""
STEADY = 1e-3
"""As in `slip_onset`"""
LONGEST_TURN = 4096.0
"""In depths"""


class Bristles:
    """State of the unit, with lengths in r, and forces in T.

    Parameters
    ----------
    pads : Pads
    depth, clearance : float
        As shares of r.
    """

    def __init__(
        self,
        pads: Pads,
        friction: float,
        depth: float,
        clearance: float,
        stiffness: float = BRISTLE_STIFFNESS,
    ) -> None:
        # A column each, as all that is of pads; sums over rows are several times as fast.
        self.normals = np.ascontiguousarray(pads.directions.T)
        z = self.normals[2]
        self.friction, self.clearance, self.depth = friction, clearance, depth
        gaps = np.maximum(0.0, (depth + clearance) * z - clearance)
        self.springs = pads.shares / np.sum(pads.shares * gaps * z)
        self.brushes = stiffness * self.springs
        self.bent = np.zeros_like(self.normals)
        self.shift = np.array([0.0, 0.0, -clearance])
        self.angle = 0.0

    def step(self, turn: float, tension: float = 1.0) -> float:
        """Turn by an angle in rad, let the unit shift, and return the moment that is held.

        Raises
        ------
        RuntimeError
            If the forces do not balance anywhere near.
        """

        def unbalanced(shift):
            force, *_ = self._pushed(shift, turn)
            return force[0], force[2] - tension

        start = self.shift[[0, 2]] / self.depth
        for away in ((0.0, 0.0), (0.0, -0.1), (-0.3, 0.3), (-1.0, 1.0)):
            guess = start + np.array(away)
            for method in ('hybr', 'lm'):
                found = root(unbalanced, guess, method=method)
                if np.max(np.abs(found.fun)) < 1e-7:
                    _, moment, self.bent, self.shift = self._pushed(found.x, turn)
                    self.angle += turn
                    return moment
        raise RuntimeError(f'the bristles find no balance at {self.angle:.3g} rad')

    def _pushed(self, shift_in_depths, turn):
        """Return force, held moment, bent bristles and shift after a shift and a turn."""
        shift = self.depth * np.array([shift_in_depths[0], 0.0, shift_in_depths[1]])
        pressure = self.springs * np.maximum(0.0, -shift @ self.normals - self.clearance)
        x, _, z = self.normals - shift[:, np.newaxis]
        turning = np.stack([z, np.zeros_like(x), -x])
        moved = (shift - self.shift)[:, np.newaxis] + turn * turning
        moved -= np.sum(moved * self.normals, axis=0) * self.normals
        bent = self.bent + moved
        pull = self.brushes * np.sqrt(np.sum(bent * bent, axis=0))
        limit = self.friction * pressure
        bent *= np.where(pull > limit, limit / np.maximum(pull, 1e-300), 1.0)
        forces = pressure * self.normals - self.brushes * bent
        return np.sum(forces, axis=1), -float(np.sum(forces * turning)), bent, shift


def held_moment(
    construction: Construction, friction: float, stiffness: float = BRISTLE_STIFFNESS
) -> float:
    """Return the steady moment K / (r T) of a turning unit."""
    return _moments(construction, friction, friction, stiffness)[-1]


def first_moments(construction: Construction, friction: float) -> tuple[float, float]:
    """Return the largest moment on the way after seating with friction, and without."""
    with_friction, without = (
        max(_moments(construction, friction, while_seating, BRISTLE_STIFFNESS))
        for while_seating in (friction, 0.0)
    )
    return with_friction, without


def _moments(
    construction: Construction, friction: float, while_seating: float, stiffness: float
) -> list[float]:
    """Seat a unit and turn it until the moment is steady; return it after each step."""
    if isinstance(construction, LooseBowl):
        pads = construction.pads(FINE_BOWL, np.degrees(np.arctan(friction)))
    else:
        pads = construction.pads(*FINE_SEAT)
    unit = Bristles(pads, while_seating, construction.depth, construction.clearance, stiffness)
    for step in range(1, 21):
        unit.step(0.0, tension=step / 20.0)
    unit.friction = friction
    goal, before = 4.0 * construction.depth, 0.0
    moments = []
    while True:
        turn = (goal - unit.angle) / STEPS
        moments += [unit.step(turn) for _ in range(STEPS)]
        steady = abs(moments[-1] - before) <= STEADY * moments[-1]
        if steady or goal > LONGEST_TURN * construction.depth:
            return moments
        goal, before = 2.0 * goal, moments[-1]
