"""`admissible_angles` and `slip_margin` against a brute-force oracle and each other."""

import dataclasses
import math
from itertools import pairwise

import numpy as np
import pytest
from designs import PRELIMINARY, cases
from hypothesis import assume, given
from hypothesis import strategies as st
from thoroughness import examples

from tendon_statics import JointDesign, Load, Regime, TensionError, solve
from tendon_statics.physics import (
    BendAngleError,
    StickSlipTracker,
    admissible_angles,
    slip_margin,
)

GRID = 801


def oracle(design: JointDesign, tension_l: float, tension_s: float, bend_angle: float) -> float:
    """How far friction is from its limit at an angle, in N m; below 0 it cannot hold.

    From Eqs. (1) to (3) as they stand: the moment, and the smallest contact force at which the
    squared force equations have friction at its limit, from the roots of the quadratic.
    """
    mu, r, weight = design.friction_coefficient, design.ball_radius, design.mass * design.gravity
    total = tension_l + tension_s
    moment = (tension_s - tension_l) * (r + design.cable_offset)
    moment += weight * design.com_distance * math.sin(bend_angle)
    beta = (design.contact_start_angle + design.contact_end_angle) / 2.0
    phi = beta + bend_angle if moment >= 0.0 else beta - bend_angle
    # Of 1 / N, since N itself has but one root for μ = 1.
    roots = np.roots(
        [total**2 - weight**2, -2.0 * (total - mu * weight * math.sin(phi)), 1.0 - mu * mu]
    )
    return mu * r / max(roots.real) - abs(moment)


@given(cases())
@examples(150)
def test_the_intervals_are_those_of_the_oracle(case):
    design, tension_l, tension_s = case
    intervals = admissible_angles(design, tension_l, tension_s)
    stop = design.max_bend_angle
    assert all(-stop <= low <= high <= stop for low, high in intervals)
    assert all(a[1] < b[0] for a, b in pairwise(intervals))
    scale = design.ball_radius * (tension_l + tension_s)
    for index in range(GRID):
        angle = stop * (2.0 * index / (GRID - 1) - 1.0)
        room = oracle(design, tension_l, tension_s, angle)
        if abs(room) > 1e-9 * scale:
            assert any(low <= angle <= high for low, high in intervals) == (room > 0.0), angle
    # Within the range an end is where friction is at its limit.
    for end in (end for interval in intervals for end in interval if abs(end) < stop):
        assert abs(oracle(design, tension_l, tension_s, end)) < 1e-9 * scale


@pytest.mark.parametrize('mirrored', [False, True])
def test_a_root_next_to_the_stop_ends_an_interval(mirrored):
    """A few roundings from it, where g beyond it is not above zero, by rounding."""
    design = JointDesign(
        *(0.015625, 0.0, 0.0, 0.1353352832366127, 1.5),
        *(0.84375, 1.34375, 0.8190939495074784, 9.81),
    )
    tensions = (0.18328442792605726, 2.471993829176284)
    stop, root = design.max_bend_angle, 0.8190939495074776
    assert stop - 1e-15 < root < stop
    intervals = admissible_angles(design, *(reversed(tensions) if mirrored else tensions))
    if mirrored:
        intervals = [(-high, -low) for low, high in reversed(intervals)]
    assert intervals[0] == (
        pytest.approx(0.1349987040823147, abs=1e-12),
        pytest.approx(root, abs=1e-15, rel=0.0),
    )
    assert intervals[1:] in ([], [(stop, stop)])


@given(cases(), st.floats(-1.0, 1.0))
@examples(300)
def test_the_margin_is_within_one_just_where_the_angle_is_admissible(case, share):
    design, tension_l, tension_s = case
    angle = share * design.max_bend_angle
    margin = slip_margin(design, tension_l, tension_s, angle)
    assume(abs(abs(margin) - 1.0) > 1e-11)
    intervals = admissible_angles(design, tension_l, tension_s)
    assert any(low <= angle <= high for low, high in intervals) == (abs(margin) < 1.0)


@given(cases())
@examples(300)
def test_every_root_is_an_end_and_has_margin_one(case):
    design, tension_l, tension_s = case
    equilibrium = solve(design, tension_l, tension_s)
    intervals = admissible_angles(design, tension_l, tension_s)
    if equilibrium.regime is Regime.EQUILIBRIUM:
        ends = [end for interval in intervals for end in interval]
        assert equilibrium.bend_angle in ends
        margin = slip_margin(design, tension_l, tension_s, equilibrium.bend_angle)
        assert abs(margin) == pytest.approx(1.0, abs=1e-9)
    elif equilibrium.regime is Regime.DRIVEN_TO_STOP:
        margin = slip_margin(design, tension_l, tension_s, equilibrium.bend_angle)
        assert abs(margin) >= 1.0  # 1 where a root is at the stop but for rounding
        assert math.copysign(1.0, margin) == math.copysign(1.0, equilibrium.bend_angle)


@given(cases(), st.floats(-1.0, 1.0))
def test_mirrored_tensions_give_mirrored_intervals_and_margins(case, share):
    design, tension_l, tension_s = case
    one = admissible_angles(design, tension_l, tension_s)
    other = admissible_angles(design, tension_s, tension_l)
    assert other == [(-high, -low) for low, high in reversed(one)]
    angle = share * design.max_bend_angle
    assert slip_margin(design, tension_l, tension_s, angle) == -slip_margin(
        design, tension_s, tension_l, -angle
    )


def test_the_published_case():
    (interval,) = admissible_angles(PRELIMINARY, 1.0, 2.0)
    assert [math.degrees(end) for end in interval] == pytest.approx([-30.0, 17.14], abs=1e-5)


def test_equal_tensions_ask_nothing_of_friction_at_zero():
    assert slip_margin(PRELIMINARY, 1.0, 1.0, 0.0) == 0.0


@pytest.mark.parametrize(
    ('contact', 'stop', 'tensions'),
    [
        ((0.5, 1.5), 0.1875, (0.3992747623401107, 2.2560034947622305)),
        ((0.75, 1.25), 0.17453292519943295, (0.3344069956277834, 1.9889614793367651)),
    ],
)
def test_a_root_at_the_stop_but_for_rounding_is_held_there(contact, stop, tensions):
    """What the margin calls held is in an interval."""
    design = JointDesign(
        ball_radius=0.015625,
        cable_offset=0.0,
        com_distance=0.0,
        mass=0.1353352832366127,
        friction_coefficient=1.0,
        contact_start_angle=contact[0],
        contact_end_angle=contact[1],
        max_bend_angle=stop,
        gravity=9.81,
    )
    for pair, side in ((tensions, 1.0), (tensions[::-1], -1.0)):
        assert slip_margin(design, *pair, side * stop) == side
        assert admissible_angles(design, *pair) == [(side * stop, side * stop)]


def test_there_may_be_no_angle_at_all():
    assert admissible_angles(PRELIMINARY, 1.0, 3.0) == []


@pytest.mark.parametrize('tensions', [(0.0, 2.0), (1.0, 0.0), (math.nan, 1.0), (0.05, 0.1)])
def test_tensions_outside_the_model_are_refused(tensions):
    with pytest.raises(TensionError):
        admissible_angles(PRELIMINARY, *tensions)
    with pytest.raises(TensionError):
        slip_margin(PRELIMINARY, *tensions, 0.0)


@pytest.mark.parametrize('angle', [math.nan, 0.6, -0.6, math.inf, 'left', None])
def test_an_angle_beyond_the_stop_is_refused(angle):
    with pytest.raises(BendAngleError, match=r'allowed is -0\.523599 to 0\.523599'):
        slip_margin(PRELIMINARY, 1.0, 2.0, angle)


@given(cases())
@examples(100)
def test_a_result_knows_the_admissible_angles_of_its_tensions(case):
    design, tension_l, tension_s = case
    expected = admissible_angles(*case)
    assert solve(*case).admissible_angles == expected
    tracked = StickSlipTracker(design, 0.5 * design.max_bend_angle).update(tension_l, tension_s)
    assert tracked.admissible_angles == expected
    assert solve(design, 0.0, tension_s).admissible_angles == []


def test_a_joint_has_to_be_seated_at_the_angle_that_is_asked_for_alone():
    free = dataclasses.replace(PRELIMINARY, contact_law='friction_circle')
    across = Load(tip_force=(3.0, 0.0))  # which pulls it off its ball as it bends towards s
    for angle in (-0.5, 0.0):
        assert math.isfinite(slip_margin(free, 0.4, 0.6, angle, across))
    for ask in (
        lambda: slip_margin(free, 0.4, 0.6, 0.5, across),
        lambda: solve(free, 0.4, 0.6, across),
    ):
        with pytest.raises(TensionError, match='must exceed'):
            ask()
