"""`array_roots` against `roots`, row by row."""

import itertools

import numpy as np
import pytest
from brute import random_case
from designs import PRELIMINARY, cases, random_cases
from hypothesis import given
from thoroughness import examples

from tendon_statics.physics.array_roots import array_brackets, array_refine
from tendon_statics.physics.batch.pairs import facing_slips
from tendon_statics.physics.batch.solver import SlipRows
from tendon_statics.physics.load import UPRIGHT
from tendon_statics.physics.roots import ANGLE_TOLERANCE
from tendon_statics.physics.tensions import Tensions, taut_slip


def both(design, tension_l, tension_s, load=UPRIGHT):
    slip = taut_slip(design, Tensions(tension_l, tension_s), load)
    slips = facing_slips(design, load, np.array([tension_l]), np.array([tension_s]), ())
    return SlipRows(slips), slip.mirrored() if tension_l > tension_s else slip


@given(cases())
@examples(300)
def test_at_the_ends_of_the_range_the_two_have_the_same_bits(case):
    """A last bit that differs would make a root there a matter of chance."""
    rows, slip = both(*case)
    for end in (0.0, case[0].max_bend_angle):
        assert rows.probe(slice(None), end)[1] == slip.value(end)


def test_values_and_slopes_are_those_of_one_pair_of_every_law():
    import random

    draw = random.Random(3)
    for case in itertools.islice(iter(lambda: random_case(draw), None), 100):
        rows, slip = both(case.design, case.tension_l, case.tension_s, case.load)
        angle = 0.37 * case.design.max_bend_angle
        _, (value,), (slope,), *_ = rows.probe(slice(None), np.array([angle]))
        assert (value, slope) == pytest.approx(slip.probe(angle)[1:3], rel=1e-9, abs=1e-12)


def test_brackets_are_those_of_one_pair():
    resolved = 0
    for case in random_cases(300, seed=2):
        rows, slip = both(*case)
        found = array_brackets(rows, rows.slip.is_determined, 0.0, case[0].max_bend_angle)
        if found.unresolved[0]:
            continue
        resolved += 1
        expected = slip.brackets(slip.probe(0.0), slip.probe(case[0].max_bend_angle))
        assert found.root_count[0] == len(expected)
        if expected:
            assert [found.low[0, 0], found.high[0, 0]] == [end[0] for end in expected[0]]
    assert resolved >= 290


def test_a_root_is_proven_by_a_bracket_of_the_bisections_width():
    tensions = np.ones(200), np.linspace(1.965, 2.045, 200)
    rows = SlipRows(facing_slips(PRELIMINARY, UPRIGHT, *tensions, ()))
    found = array_brackets(rows, np.ones(200, bool), 0.0, PRELIMINARY.max_bend_angle)
    roots = array_refine(rows, list(found.low), list(found.high))
    assert not roots.unresolved.any()
    sides = [
        rows.probe(slice(None), roots.places + step)[1]
        for step in (-0.5 * ANGLE_TOLERANCE, 0.5 * ANGLE_TOLERANCE)
    ]
    assert (sides[0] * sides[1] < 0.0).all()


def test_what_is_no_root_is_not_taken_for_one():
    """A bracket over which g does not change sign ends as unresolved."""
    rows = SlipRows(facing_slips(PRELIMINARY, UPRIGHT, np.ones(2), np.array([1.5, 2.5]), ()))
    ends = (rows.probe(slice(None), end)[:3] for end in (0.0, PRELIMINARY.max_bend_angle))
    roots = array_refine(rows, *ends)
    assert roots.unresolved.all()
