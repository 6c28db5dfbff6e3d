"""What the joints of an arm carry: weights and the tip's force of all that is beyond each.

A vector in the plane of bending is a complex number here, X + jZ. With an arm α + jβ (along the
unit, across it) its product is the moment Q of `load`, and a frame's turn by θ towards s
multiplies it by e^{jθ}. So with the absolute tilt Θ_k = θ_1 + … + θ_k of unit k, and what that
carries on its own axis,

    P_i = W_i + P_{i+1},   c_i = l_i W_i + a_i P_{i+1},

the moment of the dead load of joint i is M_i = Re q_i with q_i = Σ_{k≥i} c_k e^{jΘ_k}. Its
derivative by θ_j is −Im q_max(i,j).
"""

from __future__ import annotations

import cmath
from fractions import Fraction

from ..errors import LoadError, TensionError
from ..load import DeadLoad, Load, tension_excess
from ..loaded_joint import LoadedJoint
from ..tensions import NEGLIGIBLE_PULL, Tensions
from .arm import Arm


class Carried:
    """The dead load of each joint of an arm, from the base on.

    Parameters
    ----------
    arm : Arm
    load : Load
        On the base: gravity's direction, and the force at the tip, both in the base's frame.

    Attributes
    ----------
    dead : list of DeadLoad
        P_i and c_i, in the base's frame.
    upright : list of LoadedJoint
        Each joint under that, as if all joints before it were straight and nothing bent beyond
        it: only its contact law is of use.

    Raises
    ------
    LoadError
        If the load has a `tip_distance` that is not the last unit's length.
    """

    def __init__(self, arm: Arm, load: Load) -> None:
        self.arm, self.load = arm, load
        length = arm.units[-1].length
        if any(load.tip_force) and load.tip_distance not in (0.0, length):
            raise LoadError(
                f'tip_distance is {load.tip_distance!r}, but the force at the tip of an arm acts '
                f'at the end of its last unit, at {length!r} m; leave it out'
            )
        dead: list[DeadLoad] = []
        force = load.tip_force
        for unit in reversed(arm.units):  # each carries the pull of those beyond at its end
            dead.append(DeadLoad.of(unit.design, load.gravity_direction, force, unit.length))
            force = dead[-1].force_x, dead[-1].force_z
        dead.reverse()
        self.dead = dead
        self.turning = [complex(one.moment_x, one.moment_z) for one in dead]
        self.upright = [LoadedJoint.of(*pair) for pair in zip(arm.designs, dead, strict=True)]

    def frozen(self, angles: list[float]) -> list[LoadedJoint]:
        """Return each joint as a single one, while all others stay at their angles in rad."""
        loads = frozen_loads(self.dead, angles)
        return [LoadedJoint.of(*pair) for pair in zip(self.arm.designs, loads, strict=True)]

    def excess(self, index: int, pair: Tensions) -> float:
        """T − |P| in N of one joint, with all its digits.

        Raises
        ------
        TensionError
            If the cables that cross the joint do not seat it, wherever the arm may be.
        """
        size = self.upright[index].size
        left, right = pair
        excess: float = left + right - size
        if excess <= 0.01 * size:
            if index == len(self.dead) - 1:
                excess = tension_excess(self.arm.designs[index], self.load, size, left, right)
            else:
                excess = float(Fraction(left) + Fraction(right) - Fraction(size))
            least = self.least_tension(index) if excess <= 0.0 else 0.0
            if least == size or not left + right > least:
                raise TensionError(
                    f'the tensions of the cables that cross joint {index + 1} add up to '
                    f'{left + right:.6g} N, which must exceed the pull of {least:.6g} N of all '
                    'that it carries'
                )
        return excess

    def least_tension(self, index: int) -> float:
        """T in N that has to be exceeded so that a joint is seated, wherever the arm may be.

        It is |P|, or for a law that lets the dead load press the joint on its ball, what it pulls.
        """
        dead = self.dead[index]
        if not self.arm.designs[index].law.carries_more_than_cables:
            return float(dead.size)
        reach = sum(self.arm.stops[: index + 1])
        return max(dead.largest_pull(reach), NEGLIGIBLE_PULL * float(dead.size))


def at_tip(arm: Arm, load: Load) -> Load:
    """Return the load of an arm as that of its last unit, with the distance of the tip's force."""
    length = arm.units[-1].length
    if load.tip_distance == length or not any(load.tip_force):
        return load
    return Load(load.gravity_direction, load.tip_force, length)


def frozen_loads(dead: list[DeadLoad], angles: list[float]) -> list[DeadLoad]:
    """Return the dead load of each joint in its own frame, that of the unit before it.

    Parameters
    ----------
    dead : list of DeadLoad
        P_i and c_i, as `Carried` has them.
    angles : list of float
        Bend angles in rad, at which all joints stay.
    """
    turns, turn = [], 1.0 + 0.0j
    tilt = 0.0
    for angle in angles:
        turns.append(turn)
        tilt += angle
        turn = cmath.rect(1.0, tilt)
    found, beyond = [], 0.0j
    after = turn
    last = len(angles) - 1
    for index in range(last, -1, -1):
        own, before = dead[index], turns[index]
        turning = complex(own.moment_x, own.moment_z)
        force = complex(own.force_x, own.force_z) * before
        moment = turning * before
        if index < last:
            moment += beyond * cmath.rect(1.0, -angles[index])
        beyond += turning * after
        after = before
        found.append(DeadLoad(force.real, force.imag, moment.real, moment.imag))
    found.reverse()
    return found
