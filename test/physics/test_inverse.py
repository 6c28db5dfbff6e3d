"""`tensions_for`: round trips with `solve`, and reasons for what cannot be reached."""

import math
from collections import Counter

import pytest
from designs import PRELIMINARY, cases, random_cases
from hypothesis import assume, given
from hypothesis import strategies as st
from thoroughness import examples

from tendon_statics import Regime, solve
from tendon_statics.physics import (
    BendAngleError,
    UnreachableError,
    paper,
    residual,
    tensions_for,
)


def test_the_published_case():
    by_pressure = tensions_for(PRELIMINARY, paper.BEND_ANGLE, pressure=paper.PRESSURE)
    assert tuple(by_pressure) == pytest.approx((1.0, 2.0), abs=1e-9)
    by_total = tensions_for(PRELIMINARY, -paper.BEND_ANGLE, total_tension=3.0)
    assert tuple(by_total) == pytest.approx((2.0, 1.0), abs=1e-8)


@given(cases(), st.floats(-1.0, 1.0), st.floats(1.01, 50.0))
@examples(300)
def test_a_round_trip_by_total_tension(case, share, factor):
    design, _, _ = case
    angle, total = share * design.max_bend_angle, factor * design.weight
    try:
        tensions = tensions_for(design, angle, total_tension=total)
    except UnreachableError:
        assume(False)
    equilibrium = solve(design, *tensions)
    assert sum(tensions) == pytest.approx(total, rel=1e-12)
    assert equilibrium.regime is Regime.EQUILIBRIUM
    assert equilibrium.bend_angle == pytest.approx(angle, abs=1e-9, rel=0.0)


@given(cases())
@examples(300)
def test_a_round_trip_by_pressure(case):
    """From a solution back to its tensions, where it is the only one."""
    design, tension_l, tension_s = case
    equilibrium = solve(design, tension_l, tension_s)
    assume(equilibrium.regime is Regime.EQUILIBRIUM and tension_l != tension_s)
    # At a stop the inverse aims just inside of it.
    assume(design.max_bend_angle - abs(equilibrium.bend_angle) > 1e-9)
    # A root at 0 to the last digits may be there for the one pair and not for the other.
    assume(abs(residual(design, *sorted((tension_l, tension_s)), 0.0)) > 1e-9 * tension_l)
    # Where two roots merge, the smallest rounding moves the angle.
    assume(max(map(abs, equilibrium.bend_angle_gradient)) * (tension_l + tension_s) < 1e4)
    tensions = tensions_for(design, equilibrium.bend_angle, pressure=equilibrium.pressure)
    assert tuple(tensions) == pytest.approx((tension_l, tension_s), rel=1e-8)


def test_most_of_what_a_random_design_can_do_is_reached():
    """The refusals are the exception; each has its reason."""
    seen = Counter()
    for design, tension_l, tension_s in random_cases(400, seed=3):
        for share in (0.2, 0.8):
            try:
                tensions_for(
                    design, share * design.max_bend_angle, total_tension=tension_l + tension_s
                )
                seen['reached'] += 1
            except UnreachableError as error:
                reasons = ('have to push', 'its weight', 'it also is at')
                (reason,) = [reason for reason in reasons if reason in str(error)]
                seen[reason] += 1
    assert seen['reached'] > 400
    assert seen['it also is at'] < 120


@pytest.mark.parametrize(
    ('angle', 'given', 'named'),
    [
        (0.1, {'pressure': 0.0}, 'pressure is 0.0 Pa, which must be above 0'),
        (0.1, {'pressure': -5.0}, 'pressure is -5.0'),
        (0.1, {'pressure': math.nan}, 'pressure is nan'),
        (0.1, {'pressure': math.inf}, 'pressure is inf'),
        (0.1, {'total_tension': 0.1}, "must exceed the unit's weight of 0.191842 N"),
        (0.1, {'total_tension': math.nan}, 'total_tension is nan'),
        (0.1, {'total_tension': True}, 'total_tension is True, which is not a number'),
        (0.1, {'pressure': 'high'}, "pressure is 'high', which is not a number"),
        (0.1, {'pressure': 10**400}, 'pressure is inf'),
        (0.1, {'total_tension': 9e8}, 'next to nothing beside'),
    ],
)
def test_what_cannot_be_reached_is_refused_with_the_reason(angle, given, named):
    with pytest.raises(UnreachableError, match=named):
        tensions_for(PRELIMINARY, angle, **given)


def test_a_cable_cannot_push():
    from dataclasses import replace

    hanging = replace(PRELIMINARY, com_distance=-0.1)
    with pytest.raises(UnreachableError, match='cable l would have to push'):
        tensions_for(hanging, 0.4, total_tension=0.3)
    with pytest.raises(UnreachableError, match='cable s would have to push'):
        tensions_for(hanging, -0.4, total_tension=0.3)


@pytest.mark.parametrize('angle', [0.53, -0.53, math.nan])
def test_an_angle_beyond_the_stop_is_refused(angle):
    with pytest.raises(BendAngleError, match='allowed is -0'):
        tensions_for(PRELIMINARY, angle, pressure=400.0)


@pytest.mark.parametrize('given', [{}, {'pressure': 1.0, 'total_tension': 3.0}])
def test_just_one_of_pressure_and_total_is_given(given):
    with pytest.raises(TypeError):
        tensions_for(PRELIMINARY, 0.1, **given)
