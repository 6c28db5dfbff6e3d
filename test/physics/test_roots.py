"""`roots` on slip functions: every root, each in an interval of its own."""

import itertools
import math

import pytest
from designs import cases, random_cases
from hypothesis import given
from thoroughness import examples

from tendon_statics import JointDesign
from tendon_statics.physics.load import UPRIGHT
from tendon_statics.physics.roots import ANGLE_TOLERANCE, brackets, refine
from tendon_statics.physics.tensions import Tensions, taut_slip


def slip_of(design, tension_l, tension_s):
    return taut_slip(design, Tensions(tension_l, tension_s), UPRIGHT)


def all_brackets(function, low, high):
    return brackets(function, function.probe(low), function.probe(high))


def root_in(function, bracket):
    (root, *_), _ = refine(function, bracket)
    return root


@given(cases())
@examples(200)
def test_brackets_hold_every_sign_change_of_a_fine_grid(case):
    """On the whole range, both sides of zero."""
    design, tension_l, tension_s = case
    equation = slip_of(design, tension_l, tension_s)
    stop = design.max_bend_angle
    found = all_brackets(equation, -stop, stop)
    assert all(a[1][0] <= b[0][0] for a, b in itertools.pairwise(found))
    for bracket in found:
        low, high = (end[0] for end in bracket)
        assert -stop <= low <= high <= stop
        assert low <= root_in(equation, bracket) <= high
    grid = [stop * (2 * i / 2000 - 1) for i in range(2001)]
    signs = [equation.value(angle) > 0.0 for angle in grid]
    changes = [i for i in range(2000) if signs[i] != signs[i + 1]]
    assert len(found) >= len(changes)
    for i in changes:
        assert any(b[0][0] <= grid[i + 1] and b[1][0] >= grid[i] for b in found)


def test_a_root_is_proven_by_a_change_of_sign_over_the_tolerance():
    proven = 0
    for design, *tensions in random_cases(400, seed=3):
        equation = slip_of(design, *sorted(tensions))
        for bracket in all_brackets(equation, 0.0, design.max_bend_angle):
            (root, *_), steps = refine(equation, bracket)
            before = max(bracket[0][0], root - ANGLE_TOLERANCE)
            after = min(bracket[1][0], root + ANGLE_TOLERANCE)
            assert equation.value(before) * equation.value(after) <= 0.0
            assert steps <= 50
            proven += 1
    assert proven > 150


class Cubic:
    """A function with a triple root, at which Newton's method is slow, and a kink."""

    def probe(self, place):
        if place < 0.7:
            return place, (place - 0.3) ** 3, 3.0 * (place - 0.3) ** 2
        return place, 0.064 + abs(place - 0.9) - 0.2, math.copysign(1.0, place - 0.9)

    def slope_bounds(self, one, other):
        low, high = one[0], other[0]
        if high < 0.7:
            return (0.0 if low < 0.3 < high else 1e-300), 10.0
        return (-1.0 if low < 0.9 else 1.0), (10.0 if low < 0.7 or high > 0.9 else -1.0)


def test_where_newton_does_not_help_a_bracket_is_halved():
    cubic = Cubic()
    found = [root_in(cubic, bracket) for bracket in all_brackets(cubic, 0.0, 1.5)]
    assert len(found) == 3
    assert found[0] == pytest.approx(0.3, abs=1e-7)
    assert found[1:] == [pytest.approx(0.764, abs=1e-9), pytest.approx(1.036, abs=1e-9)]


def test_a_root_at_the_lower_end_is_found():
    """As T_s grows a root walks through zero, and is not lost on the way, to the last bit."""
    design = JointDesign(
        ball_radius=0.01,
        cable_offset=0.0,
        com_distance=0.0,
        mass=0.0625,
        friction_coefficient=1.0,
        contact_start_angle=0.0,
        contact_end_angle=1.0,
        max_bend_angle=0.5,
        gravity=8.0,
    )
    stop = design.max_bend_angle
    low, high = 1.0, 10.0
    assert slip_of(design, 1.0, low).value(0.0) < 0.0
    assert slip_of(design, 1.0, high).value(0.0) > 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if slip_of(design, 1.0, middle).value(0.0) < 0.0:
            low = middle
        else:
            high = middle
    for tension_s in (low, high):
        at = slip_of(design, 1.0, tension_s)
        roots = [root_in(at, bracket) for bracket in all_brackets(at, -stop, stop)]
        assert min(map(abs, roots)) < 1e-12
        assert len(roots) == len(set(roots))


def test_the_kink_of_a_unit_whose_weight_is_friction_times_tension():
    """R = 0 at φ = 90°: N_f has a corner there, and its slope is no number."""
    design = JointDesign(
        ball_radius=0.01,
        cable_offset=0.001,
        com_distance=0.01,
        mass=0.1,
        friction_coefficient=0.5,
        contact_start_angle=math.pi / 2 - 0.6,
        contact_end_angle=math.pi / 2 + 0.1,
        max_bend_angle=0.5,
        gravity=10.0,
    )
    equation = slip_of(design, 0.5, 1.5)
    for bracket in all_brackets(equation, -0.5, 0.5):
        root = root_in(equation, bracket)
        assert abs(equation.value(root)) < 1e-9
    assert equation.value(0.25) == pytest.approx(equation.value(0.25 + 1e-13), abs=1e-9)
