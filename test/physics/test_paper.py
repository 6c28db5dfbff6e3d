"""Eq. (4) as printed and corrected, and the two identified values."""

import math
from dataclasses import replace

import pytest
from designs import PRELIMINARY, cases
from hypothesis import assume, given

from tendon_statics import Regime, solve
from tendon_statics.physics import CONTACT_LAWS, paper, residual

CASE = (PRELIMINARY, paper.TENSION_L, paper.TENSION_S, paper.BEND_ANGLE)


def test_as_printed_the_pressure_is_negative_and_there_is_no_root():
    assert paper.force_pressure(*CASE, tuple(paper.Misprint)) < 0.0
    for index in range(31):
        angle = PRELIMINARY.max_bend_angle * index / 30
        case = (PRELIMINARY, paper.TENSION_L, paper.TENSION_S, angle)
        assert paper.moment_pressure(*case) > paper.force_pressure(*case, tuple(paper.Misprint))


@pytest.mark.parametrize('misprint', list(paper.Misprint))
def test_every_misprint_alone_spoils_the_published_result(misprint):
    left = paper.moment_pressure(*CASE)
    assert paper.force_pressure(*CASE) == pytest.approx(left, abs=1e-6)
    assert paper.force_pressure(*CASE, (misprint,)) != pytest.approx(left, abs=1.0)


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


def test_without_a_load_the_laws_add_forces_as_numbers_or_as_vectors():
    friction = PRELIMINARY.friction_coefficient
    circle = replace(PRELIMINARY, contact_law='friction_circle')
    assert paper.bare_capacity(PRELIMINARY) == pytest.approx(friction / (1.0 + friction))
    assert paper.bare_capacity(circle) == pytest.approx(math.sin(math.atan(friction)))


@pytest.mark.parametrize('law', CONTACT_LAWS)
def test_the_unit_slips_just_beyond_what_is_said(law):
    design = replace(PRELIMINARY, contact_law=law)
    tension, friction = paper.slipping_tension(design), paper.slipping_friction(design)
    for change, is_held in ((-1e-6, True), (1e-6, False)):
        answer = solve(design, paper.TENSION_L, tension + change)
        assert (answer.regime is Regime.HELD) is is_held
        rougher = replace(design, friction_coefficient=friction - change)
        answer = solve(rougher, paper.TENSION_L, paper.TENSION_S)
        assert (answer.regime is Regime.HELD) is is_held
