"""`SlipEquation.brackets`: every root, each in an interval of its own."""

import itertools
import math

import pytest
from designs import PRELIMINARY, cases, random_cases
from hypothesis import given
from thoroughness import examples

from tendon_statics import JointDesign
from tendon_statics.physics.roots import BEND_ANGLE_TOLERANCE, SlipEquation


@given(cases())
@examples(200)
def test_brackets_hold_every_sign_change_of_a_fine_grid(case):
    """On the whole range, both sides of zero."""
    design, tension_l, tension_s = case
    equation = SlipEquation(design, tension_l, tension_s)
    stop = design.max_bend_angle
    brackets = equation.brackets(-stop, stop)
    assert all(a[1] <= b[0] for a, b in itertools.pairwise(brackets))
    for low, high in brackets:
        assert -stop <= low <= high <= stop
        root, _ = equation.bisect(low, high)
        assert low <= root <= high
    grid = [stop * (2 * i / 2000 - 1) for i in range(2001)]
    signs = [equation.residual(angle) > 0.0 for angle in grid]
    changes = [i for i in range(2000) if signs[i] != signs[i + 1]]
    assert len(brackets) >= len(changes)
    for i in changes:
        assert any(low <= grid[i + 1] and high >= grid[i] for low, high in brackets)


def test_a_bracket_is_halved_to_the_tolerance():
    equation = SlipEquation(PRELIMINARY, 1.0, 2.0)
    ((low, high),) = equation.brackets(0.0, PRELIMINARY.max_bend_angle)
    root, iterations = equation.bisect(low, high)
    assert (high - low) / 2**iterations <= BEND_ANGLE_TOLERANCE
    assert (high - low) / 2 ** (iterations - 1) > BEND_ANGLE_TOLERANCE
    assert equation.slope(root) > 0.0


def test_the_last_bracket_is_proven_with_g_itself(monkeypatch):
    """Also where the rounding of the quartic, which is what is bisected, misleads."""
    misled = []
    by_residual = SlipEquation._bisect_residual

    def counted(equation, low, high):
        misled.append((low, high))
        return by_residual(equation, low, high)

    monkeypatch.setattr(SlipEquation, '_bisect_residual', counted)
    proven = 0
    for design, *tensions in random_cases(400, seed=3):
        equation = SlipEquation(design, *sorted(tensions))
        for low, high in equation.brackets(0.0, design.max_bend_angle):
            root, _ = equation.bisect(low, high)
            before = max(low, root - BEND_ANGLE_TOLERANCE)
            after = min(high, root + BEND_ANGLE_TOLERANCE)
            assert equation.residual(before) * equation.residual(after) <= 0.0
            proven += 1
    assert proven > 150
    assert 0 < len(misled) < 0.1 * proven


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
    assert SlipEquation(design, 1.0, low).residual(0.0) < 0.0
    assert SlipEquation(design, 1.0, high).residual(0.0) > 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if SlipEquation(design, 1.0, middle).residual(0.0) < 0.0:
            low = middle
        else:
            high = middle
    for tension_s in (low, high):
        at = SlipEquation(design, 1.0, tension_s)
        roots = [at.bisect(*bracket)[0] for bracket in at.brackets(-stop, stop)]
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
    equation = SlipEquation(design, 0.5, 1.5)
    brackets = equation.brackets(-0.5, 0.5)
    for bracket in brackets:
        root, _ = equation.bisect(*bracket)
        assert abs(equation.residual(root)) < 1e-9
    assert equation.residual(0.25) == pytest.approx(equation.residual(0.25 + 1e-13), abs=1e-9)
