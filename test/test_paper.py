"""Eq. (4) as printed and corrected, and the two identified values."""

import math
from dataclasses import replace

import pytest
from designs import PRELIMINARY, cases
from hypothesis import assume, given

from tendon_statics import solve
from tendon_statics.physics import paper, residual

CASE = (PRELIMINARY, paper.TENSION_L, paper.TENSION_S, paper.BEND_ANGLE)


def test_as_printed_the_pressure_is_negative_and_there_is_no_root():
    assert paper.force_pressure(*CASE, tuple(paper.Slip)) < 0.0
    for index in range(31):
        angle = PRELIMINARY.max_bend_angle * index / 30
        case = (PRELIMINARY, paper.TENSION_L, paper.TENSION_S, angle)
        assert paper.moment_pressure(*case) > paper.force_pressure(*case, tuple(paper.Slip))


@pytest.mark.parametrize('slip', list(paper.Slip))
def test_every_slip_alone_spoils_the_published_result(slip):
    left = paper.moment_pressure(*CASE)
    assert paper.force_pressure(*CASE) == pytest.approx(left, abs=1e-6)
    assert paper.force_pressure(*CASE, (slip,)) != pytest.approx(left, abs=1.0)


@given(cases())
def test_corrected_it_is_the_equation_that_is_solved(case):
    design, tension_l, tension_s = case
    assume(abs(design.friction_coefficient - 1.0) > 0.01)
    case = (design, *sorted((tension_l, tension_s)), 0.5 * design.max_bend_angle)
    difference = paper.moment_pressure(*case) - paper.force_pressure(*case)
    scale = (tension_l + tension_s) / design.contact_area
    assert difference == pytest.approx(residual(*case) / design.contact_area, abs=1e-8 * scale)


def test_the_identified_values_follow_from_the_published_result_alone():
    """From a design that has neither; another mass and offset give another result."""
    start = replace(PRELIMINARY, mass=1.0, cable_offset=0.02)
    identified = paper.identify_mass_and_offset(start)
    equilibrium = solve(identified, paper.TENSION_L, paper.TENSION_S)
    assert equilibrium.bend_angle == pytest.approx(paper.BEND_ANGLE, abs=1e-9)
    assert equilibrium.pressure == pytest.approx(paper.PRESSURE, rel=1e-12)


def test_the_plain_bisection_takes_its_halvings_and_ends_where_solve_does():
    angle, halvings = paper.bisect(PRELIMINARY, paper.TENSION_L, paper.TENSION_S)
    assert halvings == math.ceil(math.log2(PRELIMINARY.max_bend_angle / 1e-10)) == 33
    answer = solve(PRELIMINARY, paper.TENSION_L, paper.TENSION_S)
    assert angle == pytest.approx(answer.bend_angle, abs=1e-10, rel=0.0)
    assert math.degrees(angle) == pytest.approx(17.14, abs=1e-6)


@pytest.mark.parametrize('tension_s', [1.5, 3.0])
def test_without_a_change_of_sign_there_is_nothing_to_bisect(tension_s):
    assert paper.bisect(PRELIMINARY, 1.0, tension_s) is None
