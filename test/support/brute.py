"""An independent brute force of the general joint: any load, any contact law, an elastic backbone.

It shares no code with the package: forces and moments as vectors in the joint frame, the
capacity of each law from its definition, the constants of the elastic seat by a plain sum over
the seat, and everything else by scanning fine grids of angles and bisecting between their points.
"""

from __future__ import annotations

import functools
import itertools
import math
import random
from typing import NamedTuple

import numpy as np

from tendon_statics import JointDesign, Load

GRID = 6001


class Case(NamedTuple):
    """One unit, its load, and a pair of tensions."""

    design: JointDesign
    load: Load
    tension_l: float
    tension_s: float


legendre = functools.cache(np.polynomial.legendre.leggauss)


@functools.cache
def seat_constants(start: float, end: float) -> tuple[float, float, float, float]:
    """k_c, c, q and ⟨cos t⟩ / a by sums over a grid of the seat."""
    nodes, weights = legendre(200)
    # Down a column the polar angle; along a row a quarter of the azimuth, which stands for all.
    t = (start + 0.5 * (nodes + 1.0) * (end - start))[:, np.newaxis]
    f = 0.25 * np.pi * (nodes + 1.0)
    sine, cosine, of_azimuth = np.sin(t), np.cos(t), np.cos(f)
    share = weights[:, np.newaxis] * sine * weights
    share /= share.sum()
    rho = np.sqrt(1.0 - sine**2 * np.sin(f) ** 2)
    along, across = share * cosine**2, share * sine**2 * of_azimuth**2
    a, b = along.sum(), across.sum()
    s, q = (along / rho).sum(), (across / rho).sum()
    lever = (share * cosine * rho).sum() / a
    return float(lever), float(s * q / (a * b)), float(q / b), float((share * cosine).sum() / a)


def forces(case: Case, angle):
    """M, P_a and P_t at angles in rad, from vectors."""
    design, load = case.design, case.load
    x, _, z = load.gravity_direction
    weight = design.mass * design.gravity
    sine, cosine = np.sin(angle), np.cos(angle)
    # Parts of both forces along the unit's axis (sin, cos) and across it (cos, −sin).
    weight_along, weight_across = (
        weight * (x * sine + z * cosine),
        weight * (x * cosine - z * sine),
    )
    tip_x, tip_z = load.tip_force
    tip_along, tip_across = tip_x * sine + tip_z * cosine, tip_x * cosine - tip_z * sine
    moment = (case.tension_s - case.tension_l) * (design.ball_radius + design.cable_offset)
    moment = moment + design.com_distance * weight_across
    moment = moment + load.tip_distance * tip_across - design.stiffness * angle
    return moment, -(weight_along + tip_along), weight_across + tip_across


def capacity(case: Case, angle, side: float):
    """K at angles in rad, for slipping to a side."""
    _, axial, across = forces(case, angle)
    return capacity_under(case.design, case.tension_l + case.tension_s, axial, side * across)


def capacity_under(design: JointDesign, total: float, axial, ahead):
    """K from T, P_a and P_t to the side of slip, in N."""
    mu, r = design.friction_coefficient, design.ball_radius
    if design.contact_law == 'merged':
        beta = 0.5 * (design.contact_start_angle + design.contact_end_angle)
        b = total - mu * (math.sin(beta) * axial + math.cos(beta) * ahead)
        product = total**2 - axial**2 - ahead**2
        root = np.sqrt(b**2 - (1.0 - mu**2) * product)
        return (
            mu * r * np.where(b > 0.0, product / (b + root), (root - b) / (mu**2 - 1.0 + 1e-300))
        )
    circle = r * math.sin(math.atan(mu)) * np.hypot(total + axial, ahead)
    if design.contact_law == 'friction_circle':
        return circle
    lever, c, q, _ = seat_constants(design.contact_start_angle, design.contact_end_angle)
    seat = mu * r * lever * (total + axial + mu * q * ahead) / (1.0 + c * mu**2)
    return np.maximum(seat, circle)


def excess(case: Case, angle, side: float):
    """±M − K in N m, above 0 where the unit slips to the side."""
    moment, axial, across = forces(case, angle)
    total = case.tension_l + case.tension_s
    return side * moment - capacity_under(case.design, total, axial, side * across)


def seats(design: JointDesign, total: float, axial, ahead):
    """Whether T, P_a and P_t leave the unit on its ball."""
    if design.contact_law == 'merged':
        return np.hypot(axial, ahead) < total
    return total + axial > 0.0


def excesses_under_push(case: Case, angle: float, direction, distance: float, force):
    """±M − K in N m for slipping to s and to l under more forces along a line, and the seat."""
    axis = np.array([np.sin(angle), np.cos(angle)])
    across = np.array([np.cos(angle), -np.sin(angle)])
    moment, axial, ahead = forces(case, angle)
    moment = moment + distance * force * (direction @ across)
    axial, ahead = axial - force * (direction @ axis), ahead + force * (direction @ across)
    total = case.tension_l + case.tension_s
    seated = seats(case.design, total, axial, ahead)
    with np.errstate(all='ignore'):
        towards_s = moment - capacity_under(case.design, total, axial, ahead)
        towards_l = -moment - capacity_under(case.design, total, axial, -ahead)
    return towards_s, towards_l, seated


def margin(case: Case, angle: float) -> float:
    """M / K with the capacity on the side of M."""
    moment, axial, across = forces(case, angle)
    ahead = across if moment >= 0.0 else -across
    total = case.tension_l + case.tension_s
    return float(moment / capacity_under(case.design, total, axial, ahead))


def roots(case: Case, side: float, low: float, high: float) -> list[float]:
    """Angles between two at which the unit is about to slip to a side, ascending."""
    grid = np.linspace(low, high, GRID)
    values = excess(case, grid, side)
    found = []
    for index in np.flatnonzero(values[:-1] * values[1:] < 0.0):
        a, b = grid[index], grid[index + 1]
        rising = values[index] < 0.0
        while b - a > 1e-14:
            middle = 0.5 * (a + b)
            if not a < middle < b:
                break
            if (excess(case, middle, side) < 0.0) == rising:
                a = middle
            else:
                b = middle
        found.append(float(0.5 * (a + b)))
    return found


def is_doubtful(case: Case) -> bool:
    """Whether two roots nearly merge, or one lies next to 0 or a stop: a grid cannot tell."""
    stop = case.design.max_bend_angle
    scale = case.design.ball_radius * (case.tension_l + case.tension_s)
    for side in (1.0, -1.0):
        grid = np.linspace(-stop, stop, GRID)
        values = excess(case, grid, side)
        if min(abs(values[[0, GRID // 2, -1]])) < 1e-7 * scale:
            return True
        turns = np.flatnonzero(np.diff(np.sign(np.diff(values))))
        if any(abs(values[index + 1]) < 1e-6 * scale for index in turns):
            return True
    return False


def admissible(case: Case) -> list[tuple[float, float]]:
    """Intervals at which friction can hold the unit."""
    stop = case.design.max_bend_angle
    ends = sorted({-stop, stop, *roots(case, 1.0, -stop, stop), *roots(case, -1.0, -stop, stop)})
    found: list[tuple[float, float]] = []
    for low, high in itertools.pairwise(ends):
        middle = 0.5 * (low + high)
        if abs(margin(case, middle)) <= 1.0:
            if found and found[-1][1] == low:
                found[-1] = (found[-1][0], high)
            else:
                found.append((low, high))
    return found


def landing(case: Case, start: float) -> float:
    """Where a unit that was at `start` is under these tensions."""
    at_start = margin(case, start)
    if abs(at_start) <= 1.0:
        return start
    side, stop = math.copysign(1.0, at_start), case.design.max_bend_angle
    found = (
        roots(case, side, start, side * stop) if side > 0.0 else roots(case, side, -stop, start)
    )
    ahead = [angle for angle in found if side * (angle - start) > 0.0]
    return (min(ahead) if side > 0.0 else max(ahead)) if ahead else side * stop


LAWS = ('merged', 'friction_circle', 'elastic_seat')


def random_case(draw: random.Random) -> Case:
    """Draw a unit of any law, tilt, tip force and stiffness, often on the verge of slipping."""
    law = draw.choice(LAWS)
    start = draw.uniform(0.0, math.radians(65.0))
    design = JointDesign(
        ball_radius=draw.uniform(0.003, 0.02),
        cable_offset=draw.uniform(0.0, 0.006),
        com_distance=draw.uniform(-0.04, 0.05),
        mass=math.exp(draw.uniform(math.log(0.002), math.log(0.4))),
        friction_coefficient=draw.choice((draw.uniform(0.05, 0.6), draw.uniform(0.05, 1.6))),
        contact_start_angle=start,
        contact_end_angle=draw.uniform(start + math.radians(5.0), math.radians(89.0)),
        max_bend_angle=draw.uniform(math.radians(10.0), math.radians(70.0)),
        gravity=9.81,
        contact_law=law,
        stiffness=draw.choice((0.0, math.exp(draw.uniform(math.log(1e-4), math.log(0.1))))),
    )
    tip_force = draw.choice(((0.0, 0.0), (draw.gauss(0.0, 0.5), draw.gauss(0.0, 0.5))))
    load = Load.tilted(
        draw.choice((0.0, draw.uniform(-math.pi, math.pi))), tip_force, draw.uniform(0.0, 0.06)
    )
    size = math.hypot(*tip_force) + design.weight
    total = size * draw.uniform(1.05, 4.0) + draw.choice((0.0, draw.uniform(0.0, 20.0)))
    share = draw.uniform(0.03, 0.97)
    case = Case(design, load, total * (1.0 - share), total * share)
    if draw.random() < 0.3:
        return case
    # About to slip at some angle: the tensions' difference makes up for what is missing.
    side = draw.choice((1.0, -1.0))
    angle = side * draw.uniform(0.0, design.max_bend_angle)
    even = Case(design, load, 0.5 * total, 0.5 * total)
    difference = -side * float(excess(even, angle, side))
    difference /= design.ball_radius + design.cable_offset
    if abs(difference) >= 0.98 * total:
        return case
    return Case(design, load, 0.5 * (total - difference), 0.5 * (total + difference))
