"""An independent brute force of an arm: forces and levers as vectors, and a flow in small steps.

It shares no code with the package. The moment about a joint is the sum over all that is beyond of
lever × force; a joint's capacity is each law's definition; slipping joints move by explicit steps
of 1e-4 rad for the fastest, each in proportion to its excess, until none has any.
"""

from __future__ import annotations

import functools
import math
import random

import numpy as np

from tendon_statics import Arm, ArmUnit, Cable, JointDesign, Load

STEP = 1e-4
"""In rad, of the fastest joint"""

LAWS = ('merged', 'friction_circle', 'elastic_seat')


legendre = functools.cache(np.polynomial.legendre.leggauss)


@functools.cache
def seat_means(start: float, end: float) -> tuple[float, float, float]:
    """k_c, c and q of an elastic seat, by sums over its surface."""
    nodes, weights = legendre(120)
    t = (0.5 * (start + end) + 0.5 * (end - start) * nodes)[:, None]
    f = (0.25 * math.pi * (nodes + 1.0))[None, :]
    share = weights[:, None] * np.sin(t) * weights[None, :]
    share = share / share.sum()
    arm = np.sqrt(1.0 - (np.sin(t) * np.sin(f)) ** 2)
    along, across = np.cos(t) ** 2, (np.sin(t) * np.cos(f)) ** 2
    a, b = (share * along).sum(), (share * across).sum()
    friction_along = (share * across / arm).sum() / b
    friction_across = (share * along / arm).sum() / a
    lever = (share * np.cos(t) * arm).sum() / a
    return float(lever), float(friction_along * friction_across), float(friction_along)


@functools.lru_cache(maxsize=4)
def _chain(lengths: tuple[float, ...], angles: tuple[float, ...]):
    """Centres of all joints and the tip, and the direction of each unit's axis, as (x, z)."""
    x = z = tilt = 0.0
    centres, axes = [(x, z)], []
    for length, angle in zip(lengths, angles, strict=True):
        tilt += angle
        axis_x, axis_z = math.sin(tilt), math.cos(tilt)
        x, z = x + length * axis_x, z + length * axis_z
        centres.append((x, z))
        axes.append((axis_x, axis_z))
    return centres, axes


class BruteArm:
    """An arm under a load, with what its cables remember."""

    def __init__(self, arm: Arm, angles: list[float]) -> None:
        self.arm = arm
        self._lengths = tuple(unit.length for unit in arm.units)
        self.angles = list(angles)
        self.memory: list[list[float]] | None = None

    def pulls(self, tensions: dict[str, float], angles: list[float]) -> list[list[float]]:
        """Tension of each cable at each joint."""
        rows, mu = [], self.arm.cable_friction_coefficient
        shares = [(math.exp(-mu * abs(angle)), math.exp(mu * abs(angle))) for angle in angles]
        for number, cable in enumerate(self.arm.cables):
            before, row = tensions[cable.name], []
            for joint in range(cable.last_unit):
                was = before if self.memory is None else self.memory[number][joint]
                least, most = shares[joint]
                low, high = before * least, before * most
                before = low if was < low else high if was > high else was
                row.append(before)
            rows.append(row)
        return rows

    def moment_and_capacity(self, joint: int, load: Load, angles: list[float], pulls):
        """M of one joint, and its K to the side of M, in N m."""
        moment, total, axial, across = self.at_joint(joint, load, angles, pulls)
        design = self.arm.designs[joint]
        return moment, self.capacity(design, total, axial, across if moment > 0.0 else -across)

    def at_joint(self, joint: int, load: Load, angles: list[float], pulls, push=(0.0, 0.0)):
        """M of one joint in N m, and its T, P_a and P_t in N.

        `push` is one more force at the tip, of floats or arrays.
        """
        units = self.arm.units
        gravity_x, _, gravity_z = load.gravity_direction
        centres, axes = _chain(self._lengths, tuple(angles))
        centre_x, centre_z = centres[joint]
        own_x, own_z = axes[joint]
        # Forces on all that is beyond the joint, and where they act.
        loads = []
        beyond = zip(units[joint:], centres[joint:-1], axes[joint:], strict=True)
        for unit, (x, z), (axis_x, axis_z) in beyond:
            weight, lever = unit.design.mass * unit.design.gravity, unit.design.com_distance
            place = x + lever * axis_x, z + lever * axis_z
            loads.append((weight * gravity_x, weight * gravity_z, *place))
        loads += [(*load.tip_force, *centres[-1]), (*push, *centres[-1])]
        design = units[joint].design
        r = design.ball_radius
        moment, total = -design.stiffness * angles[joint], 0.0
        for cable, along in zip(self.arm.cables, pulls, strict=True):
            if cable.last_unit > joint:
                offset = design.cable_offset if cable.offset is None else cable.offset
                lever = r + offset if cable.side == 's' else -r - offset
                moment += along[joint] * lever
                total += along[joint]
        force_x = force_z = 0.0
        for load_x, load_z, at_x, at_z in loads:  # turning Z towards X is positive
            moment += (at_z - centre_z) * load_x - (at_x - centre_x) * load_z
            force_x, force_z = force_x + load_x, force_z + load_z
        axial, across = -force_x * own_x - force_z * own_z, force_x * own_z - force_z * own_x
        return moment, total, axial, across

    @staticmethod
    def capacity(design: JointDesign, total: float, axial: float, ahead: float) -> float:
        mu, r = design.friction_coefficient, design.ball_radius
        if design.contact_law == 'merged':
            # The smaller root N of (T − N)² = |μ N f − P|², f being the direction of friction.
            beta = 0.5 * (design.contact_start_angle + design.contact_end_angle)
            a = 1.0 - mu * mu
            half = total - mu * (math.sin(beta) * axial + math.cos(beta) * ahead)
            rest = total * total - axial * axial - ahead * ahead
            if abs(a) < 1e-9:
                return mu * r * 0.5 * rest / half
            root = math.sqrt(half * half - a * rest)
            return mu * r * min(n for n in ((half - root) / a, (half + root) / a) if n > 0.0)
        circle = r * mu / math.hypot(1.0, mu) * math.hypot(total + axial, ahead)
        if design.contact_law == 'friction_circle':
            return circle
        lever, c, q = seat_means(design.contact_start_angle, design.contact_end_angle)
        seat = mu * r * lever * (total + axial + mu * q * ahead) / (1.0 + c * mu**2)
        return max(seat, circle)

    def excesses(self, pulls: list[list[float]], load: Load, angles: list[float]) -> list[float]:
        """±(|M| − K) of every joint, 0 where friction or a stop holds it."""
        found = []
        for joint, unit in enumerate(self.arm.units):
            moment, capacity = self.moment_and_capacity(joint, load, angles, pulls)
            side = 1.0 if moment > 0.0 else -1.0
            excess = abs(moment) - capacity
            blocked = side * angles[joint] >= unit.design.max_bend_angle
            found.append(side * excess if excess > 0.0 and not blocked else 0.0)
        return found

    def update(self, tensions: dict[str, float], load: Load, most_steps: int = 300_000) -> None:
        """Let it flow until nothing is beyond its limit by more than a millionth of r T."""
        stops = [unit.design.max_bend_angle for unit in self.arm.units]
        radius = min(unit.design.ball_radius for unit in self.arm.units)
        enough = 1e-6 * radius * sum(tensions.values())
        step = STEP
        pulls = self.pulls(tensions, self.angles)
        excess = self.excesses(pulls, load, self.angles)
        for _ in range(most_steps):
            self.memory = pulls
            fastest = max(map(abs, excess))
            if fastest <= enough:
                return
            after = [
                min(max(angle + step * e / fastest, -stop), stop)
                for angle, e, stop in zip(self.angles, excess, stops, strict=True)
            ]
            pulls = self.pulls(tensions, after)
            later = self.excesses(pulls, load, after)
            # A joint that turns round has gone past its place of rest: smaller steps.
            turned = any(a * b < 0.0 for a, b in zip(excess, later, strict=True))
            step = 0.5 * step if turned or max(map(abs, later)) < 0.7 * fastest else 1.1 * step
            step = min(max(step, 1e-9), STEP)
            self.angles, excess = after, later
        raise ArithmeticError('the flow does not come to rest')


def random_arm(draw: random.Random, count: int | None = None, *, friction: bool = True) -> Arm:
    """Draw an arm of units of all laws, with one to three pairs of cables."""
    count = count or draw.randint(2, 6)
    kinds = [_random_design(draw) for _ in range(draw.choice((1, 2, count)))]
    units = [ArmUnit(draw.choice(kinds), draw.uniform(0.008, 0.04)) for _ in range(count)]
    ends = [count, *(draw.randint(1, count) for _ in range(draw.randint(0, 2)))]
    cables = []
    for number, end in enumerate(ends):
        offset = draw.choice((None, None, draw.uniform(0.0, 0.006)))
        cables += [Cable(f'{side}{number}', side, end, offset) for side in 'ls']
    mu = draw.choice((0.0, draw.uniform(0.01, 0.3))) if friction else 0.0
    return Arm(tuple(units), tuple(cables), mu)


def _random_design(draw: random.Random) -> JointDesign:
    start = draw.uniform(0.0, math.radians(65.0))
    return JointDesign(
        ball_radius=draw.uniform(0.004, 0.012),
        cable_offset=draw.uniform(0.0, 0.006),
        com_distance=draw.uniform(-0.02, 0.03),
        mass=math.exp(draw.uniform(math.log(0.002), math.log(0.06))),
        friction_coefficient=draw.choice((draw.uniform(0.05, 0.5), draw.uniform(0.05, 1.3))),
        contact_start_angle=start,
        contact_end_angle=draw.uniform(start + math.radians(5.0), math.radians(89.0)),
        max_bend_angle=draw.uniform(math.radians(10.0), math.radians(50.0)),
        gravity=9.81,
        contact_law=draw.choice(LAWS),
        stiffness=draw.choice((0.0, math.exp(draw.uniform(math.log(1e-3), math.log(0.1))))),
    )


def random_load(draw: random.Random) -> Load:
    """Draw a tilt of the base, and often a force at the tip."""
    tilt = draw.choice((0.0, draw.uniform(-math.pi, math.pi)))
    force = draw.choice(((0.0, 0.0), (draw.gauss(0.0, 0.15), draw.gauss(0.0, 0.15))))
    return Load.tilted(tilt, force)


def random_pull(draw: random.Random, arm: Arm, load: Load) -> dict[str, float]:
    """Draw tensions that seat every joint, often such that some joints slip."""
    weight = sum(unit.design.weight for unit in arm.units) + math.hypot(*load.tip_force)
    pairs = len(arm.cables) // 2
    tensions = {}
    for pair in range(pairs):
        total = draw.uniform(0.5, 8.0) + (1.2 * weight if pair == 0 else 0.0)
        # Enough for what is lost to friction along the arm.
        total *= math.exp(arm.cable_friction_coefficient * sum(arm.stops)) if pair == 0 else 1.0
        share = draw.uniform(0.2, 0.8)
        tensions[f'l{pair}'], tensions[f's{pair}'] = total * share, total * (1.0 - share)
    return tensions
