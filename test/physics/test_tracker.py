"""`StickSlipTracker`: exact stick, slip only where driven, and the same path however sampled."""

import math

import pytest
from designs import PRELIMINARY, cases, random_cases
from hypothesis import given
from hypothesis import strategies as st
from thoroughness import examples, some_of

from tendon_statics import Equilibrium, JointDesign, Regime, TensionError
from tendon_statics.physics import (
    UPRIGHT,
    BendAngleError,
    StickSlipTracker,
    admissible_angles,
    slip_margin,
)

shares = st.floats(-1.0, 1.0)
"""Of the range of tensions or angles"""


@st.composite
def walks(draw: st.DrawFn) -> tuple:
    """A design, a first angle and a sequence of valid tensions around its slip."""
    design, tension_l, tension_s = draw(cases())
    steps = draw(st.lists(st.tuples(st.floats(0.3, 3.0), st.floats(0.3, 3.0)), max_size=12))
    tensions = [
        (tension_l * factor_l, tension_s * factor_s)
        for factor_l, factor_s in steps
        if tension_l * factor_l + tension_s * factor_s > design.weight
    ]
    angle = draw(shares) * design.max_bend_angle
    return design, angle, [(tension_l, tension_s), *tensions]


@given(walks())
@examples(300)
def test_held_is_admissible_and_the_angle_changes_only_on_slip(walk):
    design, angle, sequence = walk
    tracker = StickSlipTracker(design, angle)
    for tensions in sequence:
        before = tracker.bend_angle
        state = tracker.update(*tensions)
        intervals = admissible_angles(design, *tensions)
        margin = slip_margin(design, *tensions, before)
        near = [
            interval
            for interval in intervals
            if interval[0] - 1e-9 <= state.bend_angle <= interval[1] + 1e-9
        ]
        assert state.bend_angle == tracker.bend_angle
        assert state.slip_margin == slip_margin(design, *tensions, state.bend_angle)
        if abs(margin) <= 1.0:
            assert state.regime is Regime.HELD
            assert state.bend_angle == before
            assert near
        elif state.regime is Regime.SLIPPING:
            assert near
            assert (state.bend_angle - before) * margin > 0.0
            # Nothing admissible was passed by.
            low, high = sorted((before, state.bend_angle))
            passed = (min(b, high) - max(a, low) for a, b in intervals)
            assert all(length <= 1e-9 for length in passed)
        else:
            assert state.regime is Regime.DRIVEN_TO_STOP
            assert state.bend_angle == math.copysign(design.max_bend_angle, margin)
            beyond = [b if margin > 0.0 else -a for a, b in intervals]
            assert all(end <= math.copysign(before, before * margin) + 1e-9 for end in beyond)


@given(walks())
def test_a_second_message_with_the_same_tensions_changes_nothing(walk):
    design, angle, sequence = walk
    tracker = StickSlipTracker(design, angle)
    for tensions in sequence:
        first = tracker.update(*tensions)
        second = tracker.update(*tensions)
        assert second.bend_angle == first.bend_angle
        if first.regime is not Regime.DRIVEN_TO_STOP:
            assert second.regime is Regime.HELD


class RoundaboutTracker(StickSlipTracker):
    """Works the whole way out, also where the unit is pressed against its stop."""

    def _stays_at_stop(self, _margin: float) -> bool:
        return False


@given(walks())
@examples(300)
def test_at_a_stop_nothing_but_the_stop_is_found(walk):
    design, angle, sequence = walk
    stop = math.copysign(design.max_bend_angle, angle)
    for start in (angle, stop):
        short, long = StickSlipTracker(design, start), RoundaboutTracker(design, start)
        for tensions in sequence:
            assert short.update(*tensions) == long.update(*tensions)


def test_a_constant_load_a_million_times_leaves_the_angle_identical():
    """At the desk a part of them."""
    tracker = StickSlipTracker(PRELIMINARY, -0.1)
    assert tracker.update(1.0, 3.0).regime is Regime.DRIVEN_TO_STOP
    tracker.reset(0.123456789)
    held = tracker.update(1.0, 1.9)
    assert held.regime is Regime.HELD
    for _ in range(some_of(1_000_000)):
        tracker.update(1.0, 1.9)
        assert tracker.bend_angle == 0.123456789


@given(walks())
def test_mirrored_tensions_give_the_mirrored_path(walk):
    design, angle, sequence = walk
    one, other = StickSlipTracker(design, angle), StickSlipTracker(design, -angle)
    for tension_l, tension_s in sequence:
        state, mirrored = one.update(tension_l, tension_s), other.update(tension_s, tension_l)
        assert state.regime == mirrored.regime
        assert state.bend_angle == -mirrored.bend_angle
        assert state.slip_margin == -mirrored.slip_margin
        assert state.pressure == mirrored.pressure
        assert state.branch_consistent == mirrored.branch_consistent


@given(cases(), shares, st.floats(1.0, 3.0), st.booleans())
@examples(300)
def test_the_path_does_not_depend_on_how_finely_a_ramp_is_sampled(case, share, factor, pulls_s):
    """One cable is pulled ever harder; a hundred steps end where one does."""
    design, tension_l, tension_s = case
    angle = share * design.max_bend_angle
    coarse, fine = StickSlipTracker(design, angle), StickSlipTracker(design, angle)
    for tracker in (coarse, fine):
        tracker.update(tension_l, tension_s)
    last = None
    for index in range(1, 101):
        pull = 1.0 + (factor - 1.0) * index / 100
        last = (tension_l, tension_s * pull) if pulls_s else (tension_l * pull, tension_s)
        fine.update(*last)
    coarse.update(*last)
    assert coarse.bend_angle == pytest.approx(fine.bend_angle, abs=1e-9, rel=0.0)


@pytest.mark.parametrize('steps', [1, 2, 3, 10, 100])
def test_an_interval_that_opens_behind_a_sliding_unit_does_not_hold_it(steps):
    """Tensions hardly above the weight: no angle is held on the way, some are at its end."""
    design = JointDesign(
        ball_radius=0.016852715617972976,
        cable_offset=0.0005030771476516256,
        com_distance=0.004028556664867858,
        mass=0.0467705859459294,
        friction_coefficient=0.6181154042422575,
        contact_start_angle=0.40080380766411927,
        contact_end_angle=1.415515100826961,
        max_bend_angle=1.038801581642424,
        gravity=9.81,
    )
    tension_l, first, last = 0.20322578615864983, 0.2680226724811889, 0.5533013679159699
    assert admissible_angles(design, tension_l, 0.4) == []
    assert admissible_angles(design, tension_l, last) != []
    tracker = StickSlipTracker(design, -0.6861512940507755)
    for index in range(steps + 1):
        tracker.update(tension_l, first + (last - first) * index / steps)
    assert tracker.bend_angle == design.max_bend_angle


@given(cases())
@examples(300)
def test_every_end_of_an_admissible_interval_is_held(case):
    design, tension_l, tension_s = case
    for interval in admissible_angles(design, tension_l, tension_s):
        for end in interval:
            state = StickSlipTracker(design, end).update(tension_l, tension_s)
            assert (state.regime, state.bend_angle) == (Regime.HELD, end)
            assert abs(state.slip_margin) <= 1.0


@given(cases())
@examples(200)
def test_holding_and_slipping_make_up_the_whole_range(case):
    """From any angle the unit is held, or ends at an admissible angle or a stop."""
    design, tension_l, tension_s = case
    for index in range(41):
        angle = design.max_bend_angle * (index / 20 - 1.0)
        state = StickSlipTracker(design, angle).update(tension_l, tension_s)
        margin = slip_margin(design, tension_l, tension_s, state.bend_angle)
        if state.regime is Regime.DRIVEN_TO_STOP:
            assert abs(state.bend_angle) == design.max_bend_angle
            assert margin * state.bend_angle > 0.0
        else:
            assert abs(margin) <= 1.0


@given(walks())
def test_what_is_held_is_in_equilibrium(walk):
    """Eq. (3) gives the friction, and Eqs. (1) and (2), squared and added, the contact force."""
    design, angle, sequence = walk
    tracker = StickSlipTracker(design, angle)
    for tension_l, tension_s in sequence:
        state = tracker.update(tension_l, tension_s)
        total, weight = tension_l + tension_s, design.weight
        if state.regime is Regime.DRIVEN_TO_STOP:
            continue
        r = design.ball_radius
        moment = (tension_s - tension_l) * (r + design.cable_offset)
        moment += weight * design.com_distance * math.sin(state.bend_angle)
        friction = moment / r
        side = math.copysign(1.0, friction)
        phi = design.contact_centre_angle + side * state.bend_angle
        assert state.branch_consistent == (abs(friction) * math.sin(phi) > weight)
        if not state.branch_consistent:
            assert state.pressure is state.normal_force is state.forces is None
            continue
        normal = state.normal_force
        assert state.pressure == normal / design.contact_area
        assert abs(friction) <= design.friction_coefficient * normal * (1.0 + 1e-9)
        square = friction**2 + weight**2 - 2.0 * weight * abs(friction) * math.sin(phi)
        assert (total - normal) ** 2 == pytest.approx(square, abs=1e-9 * total**2)
        assert math.hypot(state.forces.friction_x, state.forces.friction_z) == pytest.approx(
            abs(friction)
        )


def test_the_pressure_of_a_held_unit_has_its_derivatives():
    """Against finite differences, at angles near the ends of the admissible intervals."""
    compared = 0
    for design, tension_l, tension_s in random_cases(300, seed=5):
        for low, high in admissible_angles(design, tension_l, tension_s):
            for angle in (low + 0.05 * (high - low), high - 0.05 * (high - low)):
                here = StickSlipTracker(design, angle).update(tension_l, tension_s)
                if here.pressure_gradient is None:
                    continue
                step = 1e-6 * (tension_l + tension_s)
                for by_l, by_s in ((1.0, 0.0), (0.0, 1.0)):
                    near = [
                        StickSlipTracker(design, angle).update(
                            tension_l + sign * step * by_l, tension_s + sign * step * by_s
                        )
                        for sign in (-1.0, 1.0)
                    ]
                    if any(s.regime is not Regime.HELD or s.pressure is None for s in near):
                        continue
                    slope = here.pressure_gradient.tension_l * by_l
                    slope += here.pressure_gradient.tension_s * by_s
                    difference = (near[1].pressure - near[0].pressure) / (2.0 * step)
                    scale = 1.0 / design.contact_area
                    assert difference == pytest.approx(slope, rel=1e-3, abs=1e-3 * scale)
                    compared += 1
    assert compared > 200


def test_a_full_cycle_goes_from_stop_to_stop():
    tracker = StickSlipTracker(PRELIMINARY)
    stop = PRELIMINARY.max_bend_angle
    cycle = [
        (1.0, 1.5, Regime.HELD, 0.0),
        (1.0, 2.04, Regime.HELD, 0.0),
        (1.0, 2.1, Regime.DRIVEN_TO_STOP, stop),
        (1.0, 1.5, Regime.HELD, stop),
        (1.0, 0.6, Regime.HELD, stop),
        (1.0, 0.4, Regime.DRIVEN_TO_STOP, -stop),
        (1.0, 1.5, Regime.HELD, -stop),
        (1.0, 2.5, Regime.DRIVEN_TO_STOP, stop),
    ]
    for tension_l, tension_s, regime, angle in cycle:
        state = tracker.update(tension_l, tension_s)
        assert (state.regime, state.bend_angle) == (regime, angle)


def test_a_slip_to_an_angle_keeps_that_angles_uncertainty_while_held():
    """The recorded design with two roots slips to its stable one."""
    from test_solver import reference_cases

    design, row = next((d, r) for d, r in reference_cases() if r['root_count'] == '2')
    weak, strong = sorted((float(row['tension_l']), float(row['tension_s'])))
    ((low, _),) = admissible_angles(design, weak, strong)
    tracker = StickSlipTracker(design, low - 0.1)
    state = tracker.update(weak, strong)
    assert state.regime is Regime.SLIPPING
    assert state.bend_angle == pytest.approx(low, abs=1e-12)
    assert state.bend_angle_stddev(0.01) > 0.0
    held = tracker.update(weak, strong * 0.999)
    assert held.regime is Regime.HELD
    assert held.bend_angle_stddev(0.01) == state.bend_angle_stddev(0.01)
    tracker.reset(0.0)
    assert tracker.update(weak, weak).bend_angle_stddev(0.01) == 0.0


def test_a_slack_cable_leaves_the_angle_unsure_until_a_stop_or_a_reset():
    tracker = StickSlipTracker(PRELIMINARY, 0.1)
    assert tracker.update(1.0, 1.5).angle_assured
    assert tracker.update(0.0, 1.5) == Equilibrium(
        PRELIMINARY, UPRIGHT, Regime.SLACK, 0.0, 1.5, angle_assured=False
    )
    after = tracker.update(1.0, 1.5)
    assert (after.regime, after.bend_angle, after.angle_assured) == (Regime.HELD, 0.1, False)
    assert after.bend_angle_stddev(0.01) is None
    assert tracker.update(1.0, 3.0).angle_assured
    tracker.update(0.0, 1.5)
    tracker.reset(0.2)
    assert tracker.update(1.0, 1.5).angle_assured


def test_bad_input_changes_nothing():
    tracker = StickSlipTracker(PRELIMINARY, 0.1)
    for tensions in ((math.nan, 1.0), (-1.0, 1.0), (0.05, 0.1)):
        with pytest.raises(TensionError):
            tracker.update(*tensions)
    for angle in (math.nan, 0.6, -0.6):
        with pytest.raises(BendAngleError):
            tracker.reset(angle)
        with pytest.raises(BendAngleError):
            StickSlipTracker(PRELIMINARY, angle)
    assert tracker.bend_angle == 0.1
    assert tracker.update(1.0, 1.5).angle_assured


def test_another_design_takes_over_where_the_unit_is():
    from dataclasses import replace

    tracker = StickSlipTracker(PRELIMINARY, 0.5)
    tracker.change_design(replace(PRELIMINARY, max_bend_angle=0.4))
    assert tracker.bend_angle == 0.4
    assert tracker.design.max_bend_angle == 0.4
    assert not tracker.update(1.0, 1.5).angle_assured


def test_a_stop_tells_where_a_doubted_unit_is_only_if_nothing_else_can_hold_it():
    """Under 0.2 N and 0.5 N friction holds a unit that is bent towards cable l."""
    tracker = StickSlipTracker(PRELIMINARY)
    tracker.doubt()
    found = tracker.update(0.2, 0.5)
    assert found.regime is Regime.DRIVEN_TO_STOP
    assert found.admissible_angles
    assert not found.angle_assured
    assert tracker.update(1.0, 3.0).angle_assured
    assert tracker.update(0.2, 0.5).angle_assured
