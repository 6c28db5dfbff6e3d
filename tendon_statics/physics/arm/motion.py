"""An arm on its way to rest: which of its joints move, and where they are."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .excess import Excess
from .look import Look

Floats = NDArray[np.float64]

ROUNDING = 1e-11
"""Share of K by which M may exceed it at rest"""

NOTHING = 1e-9
"""Share of K by which M may exceed it where rounding would decide"""

TOLERANCE = 1e-5
"""How exactly in rad a step ends where it has to"""


class Motion:
    """The joints of an arm that move, by the rule of `flow`.

    Attributes
    ----------
    look : Look
        Where the arm is.
    moving : dict
        Joints that move → the side to which they are driven.
    at_limit : dict
        Likewise those that have come to rest with M = K, if none moves any more.
    """

    def __init__(self, excess: Excess, angles: list[float]) -> None:
        self.stops = excess.arm.stops
        self.rubs = excess.arm.cable_friction_coefficient > 0.0
        self.rounding = excess.rounding
        self.look = excess.at(angles)
        excess.remember(self.look)
        self.moving: dict[int, float] = {}
        self.at_limit: dict[int, float] = {}
        self._excess = excess
        self._from: dict[int, float] = {}
        """Where each of those that move was when it began to"""
        self._slopes: tuple[Look, dict[int, float], Floats] | None = None
        """Where the arm was last asked for its jacobian, with what sides, and what it is"""
        self._undecided: set[int] = set()
        """Joints that rounding alone would move"""
        self.free()

    def velocity(self, look: Look) -> Floats:
        """Return f of the joints that move, in N m, elsewhere."""
        return np.array(look.velocities(self.moving))

    def jacobian(self, look: Look) -> Floats:
        """Return ∂f/∂θ of the joints that move, in N·m/rad, elsewhere."""
        return self._excess.jacobian(look, self.moving).take(list(self.moving), 1)

    def after(self, way: Floats) -> Look:
        """Look at the arm with the moving joints moved on, by angles in rad."""
        angles = list(self.look.angles)
        for joint, by in zip(self.moving, way.tolist(), strict=True):
            angles[joint] += by
        return self.look_at(angles)

    def look_at(self, angles: list[float]) -> Look:
        """Look at the arm at bend angles in rad."""
        return self._excess.at(angles)

    def flow(self, angles: list[float], leaning: list[float]) -> list[float]:
        """Return θ' of all joints, elsewhere, as `Excess.flow` has it."""
        return self._excess.flow(angles, leaning)

    def take(self, look: Look) -> None:
        """Go there."""
        self._excess.remember(look)
        self.look = look

    def lean_on_stop(self, joint: int, side: float) -> bool:
        """Whether a joint that is driven to a side is at its stop."""
        return side * self.look.angles[joint] >= self.stops[joint]

    def leaning(self, angles: list[float]) -> list[float]:
        """Return the side on which each joint is at its stop, elsewhere; 0 where it is not."""
        return [
            math.copysign(1.0, angle) if abs(angle) >= stop else 0.0
            for angle, stop in zip(angles, self.stops, strict=True)
        ]

    def sides(self) -> dict[int, float]:
        """Return the side of every joint: to which it moves, or M drives it."""
        return {
            joint: self.moving.get(joint) or self.look.drive(joint)[0]
            for joint in range(len(self.stops))
        }

    def slopes(self, sides: dict[int, float]) -> Floats:
        """Return ∂f/∂θ in N·m/rad of all joints, with these sides, where the arm is."""
        if self._slopes is None or self._slopes[0] is not self.look or self._slopes[1] != sides:
            self._slopes = self.look, sides, self._excess.jacobian(self.look, sides)
        return self._slopes[2]

    def changes_at(self, look: Look, too_much: float) -> bool:
        """Whether a joint at rest is beyond its limit there, or one that moves beyond its stop.

        Parameters
        ----------
        too_much : float
            What is beyond the limit, in N m.
        """
        for joint, stop in enumerate(self.stops):
            if joint in self.moving:
                if abs(look.angles[joint]) > stop:
                    return True
            else:
                side, excess, _ = look.drive(joint)
                if excess > too_much and not self.lean_on_stop(joint, side):
                    return True
        return False

    def free(self) -> None:
        """Set moving what is beyond its limit and not before its stop."""
        for joint in range(len(self.stops)):
            if joint in self.moving:
                continue
            side, excess, capacity = self.look.drive(joint)
            share = NOTHING if joint in self._undecided else ROUNDING
            too_much = max(share * capacity, self.rounding[joint])
            if excess > too_much and not self.lean_on_stop(joint, side):
                self.moving[joint] = side
                self._from[joint] = self.look.angles[joint]

    def set_out_from(self, look: Look) -> None:
        """Go there, and set moving what is beyond its limit there."""
        self.take(look)
        self.moving, self.at_limit = {}, {}
        self.free()

    def change(self) -> None:
        """Stop what has met its stop or falls below its limit, and free what has come to it."""
        angles, stopped = list(self.look.angles), False
        for joint, side in list(self.moving.items()):
            if side * (angles[joint] - self._from[joint]) < 0.0:  # has gone back a little
                angles[joint] = self._from[joint]
            elif side * angles[joint] >= self.stops[joint] - TOLERANCE:
                angles[joint] = side * self.stops[joint]
            else:
                continue
            stopped = True
            del self.moving[joint]
        if stopped:
            self.take(self._excess.at(angles))
        for joint in self._falling():
            del self.moving[joint]
        self.at_limit = {}
        self.free()

    def _falling(self) -> list[int]:
        """Return the moving joints below their limit, but for what has only overshot its rest.

        That is told by how the motion goes on, so without what has met its stop.
        """
        sides = self.moving.values()
        velocities = self.look.velocities(self.moving)
        if all(side * velocity >= 0.0 for side, velocity in zip(sides, velocities, strict=True)):
            return []
        velocity = np.array(velocities)
        joints = list(self.moving)
        jacobian = self.slopes(self.sides()).take(joints, 0).take(joints, 1)
        acceleration = jacobian @ velocity
        ahead = np.array(list(sides))
        falls = (ahead * velocity < 0.0) & (ahead * acceleration < 0.0)
        return [joint for joint, is_falling in zip(self.moving, falls, strict=True) if is_falling]

    def come_to_rest(self, look: Look) -> None:
        """Go to where M = K of all that move; what comes to its limit there sets out from there.

        What would end behind where it began to move is let rest instead: that is a joint which is
        beyond its limit by rounding alone, while another moves.
        """
        behind = [
            joint
            for joint, side in self.moving.items()
            if side * (look.angles[joint] - self._from[joint]) < 0.0
        ]
        if behind:
            angles = list(self.look.angles)
            for joint in behind:
                angles[joint] = self._from[joint]
                del self.moving[joint]
            self._undecided |= set(behind)
            self.take(self._excess.at(angles))
            return
        self.take(look)
        self.at_limit, self.moving = self.moving, {}
        self.free()
        if self.moving:
            self.moving |= self.at_limit
