"""`ArraySlipEquation` against `SlipEquation`, pair by pair."""

import numpy as np
import pytest
from designs import PRELIMINARY, cases, random_cases
from hypothesis import given
from thoroughness import examples

from tendon_statics.physics.array_roots import ArraySlipEquation
from tendon_statics.physics.roots import BEND_ANGLE_TOLERANCE, SlipEquation


def both(case):
    design, *tensions = case
    weak, strong = sorted(tensions)
    return (
        ArraySlipEquation(design, np.array([weak]), np.array([strong])),
        SlipEquation(design, weak, strong),
    )


@given(cases())
@examples(300)
def test_at_the_quarter_turns_the_two_have_the_same_bits(case):
    """A last bit that differs would make a root at the end of the range a matter of chance."""
    array, scalar = both(case)
    for knot in case[0].slip_geometry.knots(0.0, case[0].max_bend_angle):
        assert tuple(array.points_at(knot)[:, 0]) == scalar.point_at(knot)


@given(cases())
def test_points_and_slopes_are_those_of_one_pair(case):
    array, scalar = both(case)
    angle = 0.37 * case[0].max_bend_angle
    points, point = array.points(np.array([angle])), scalar.point(angle)
    assert points[:, 0] == pytest.approx(point, rel=1e-12, abs=1e-12)
    of_moment, of_force = scalar.slopes_at(point)
    assert [part[0] for part in array.slopes(points)] == pytest.approx(
        [of_moment, of_force], rel=1e-9, abs=1e-12
    )


def test_brackets_are_those_of_one_pair():
    resolved = 0
    for case in random_cases(300, seed=2):
        array, scalar = both(case)
        stop = case[0].max_bend_angle
        found = array.brackets(stop)
        if found.unresolved[0]:
            continue
        resolved += 1
        expected = scalar.brackets(0.0, stop)
        assert found.root_count[0] == len(expected)
        if expected:
            assert (found.low[0], found.high[0]) == expected[0]
    assert resolved >= 290


def test_a_root_is_proven_by_a_bracket_of_the_bisections_width():
    tensions = np.ones(200), np.linspace(1.965, 2.045, 200)
    equation = ArraySlipEquation(PRELIMINARY, *tensions)
    brackets = equation.brackets(PRELIMINARY.max_bend_angle)
    roots = equation.roots(brackets.low, brackets.high)
    assert not roots.unresolved.any()
    sides = []
    for step in (-0.5 * BEND_ANGLE_TOLERANCE, 0.5 * BEND_ANGLE_TOLERANCE):
        _, moment, force, _, _ = equation.points(roots.bend_angle + step)
        sides.append(moment - force)
    assert (sides[0] * sides[1] < 0.0).all()


def test_what_is_no_root_is_not_taken_for_one():
    """A bracket over which g does not change sign ends as unresolved."""
    equation = ArraySlipEquation(PRELIMINARY, np.ones(2), np.array([1.5, 2.5]))
    roots = equation.roots(np.zeros(2), np.full(2, PRELIMINARY.max_bend_angle))
    assert roots.unresolved.all()
