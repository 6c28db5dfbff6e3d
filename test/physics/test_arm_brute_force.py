"""An arm through random loads, beside a brute force that shares no code with it."""

import math
import random

import arm_brute
import pytest
from thoroughness import some_of

from tendon_statics import (
    Arm,
    ArmTracker,
    ArmUnit,
    Cable,
    JointDesign,
    Load,
    Regime,
    TendonStaticsError,
    arm_margins,
)

ARMS = some_of(20)


def random_arm(draw, number):
    """Draw an arm of 2 to 6 units."""
    return arm_brute.random_arm(draw, 2 + number % 5)


@pytest.mark.parametrize('number', range(ARMS))
def test_an_arm_comes_to_rest_where_a_flow_in_small_steps_does(number):
    draw = random.Random(1700 + number)
    arm = random_arm(draw, number)
    tracker = ArmTracker(arm)
    brute = arm_brute.BruteArm(arm, [0.0] * len(arm.units))
    for _ in range(3):
        load = arm_brute.random_load(draw)
        tensions = arm_brute.random_pull(draw, arm, load)
        state = tracker.update(tensions, load)
        brute.update(tensions, load)
        assert state.bend_angles == pytest.approx(brute.angles, abs=5e-3)


def test_a_joint_that_slips_but_for_a_moment_is_left_where_it_turns():
    """Early on a leg that is long for the joint that goes on alone."""
    draw = random.Random('918273645 4 9')
    arm = arm_brute.random_arm(draw, 4)
    tracker, brute = ArmTracker(arm), arm_brute.BruteArm(arm, [0.0] * 4)
    for _ in range(2):
        load = arm_brute.random_load(draw)
        tensions = arm_brute.random_pull(draw, arm, load)
        state = tracker.update(tensions, load)
        brute.update(tensions, load)
    assert state.bend_angles[1] > 0.005
    assert state.bend_angles == pytest.approx(brute.angles, abs=3e-4)


def test_most_arms_of_that_sample_slip():
    slipped = 0
    for number in range(ARMS):
        draw = random.Random(1700 + number)
        arm = random_arm(draw, number)
        tracker, regimes = ArmTracker(arm), set()
        for _ in range(3):
            load = arm_brute.random_load(draw)
            regimes |= {*tracker.update(arm_brute.random_pull(draw, arm, load), load).regimes}
        slipped += regimes != {Regime.HELD}
    assert slipped > 0.7 * ARMS


@pytest.mark.parametrize('number', range(20))
def test_the_margins_are_those_of_sums_of_forces_and_levers(number):
    draw = random.Random(2300 + number)
    arm = arm_brute.random_arm(draw, friction=False)
    load = arm_brute.random_load(draw)
    tensions = arm_brute.random_pull(draw, arm, load)
    angles = [draw.uniform(-stop, stop) for stop in arm.stops]
    brute = arm_brute.BruteArm(arm, angles)
    pulls = brute.pulls(tensions, angles)
    for joint, margin in enumerate(arm_margins(arm, angles, tensions, load)):
        moment, capacity = brute.moment_and_capacity(joint, load, angles, pulls)
        assert margin == pytest.approx(moment / capacity, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize('number', range(25))
def test_at_rest_every_joint_is_within_its_limit_or_leans_on_its_stop(number):
    draw = random.Random(3100 + number)
    arm = arm_brute.random_arm(draw)
    tracker = ArmTracker(arm)
    for _ in range(6):
        load = arm_brute.random_load(draw)
        state = tracker.update(arm_brute.random_pull(draw, arm, load), load)
        for joint, (angle, margin) in enumerate(
            zip(state.bend_angles, state.slip_margins, strict=True)
        ):
            leans = angle == math.copysign(arm.stops[joint], margin)
            assert abs(margin) <= 1.0 + 1e-9 or leans
            assert (state.regimes[joint] is Regime.DRIVEN_TO_STOP) == (abs(margin) > 1.0 + 1e-9)


@pytest.mark.parametrize('number', range(10))
def test_the_same_tensions_again_move_nothing(number):
    draw = random.Random(4100 + number)
    arm = arm_brute.random_arm(draw)
    tracker = ArmTracker(arm)
    for _ in range(3):
        load = arm_brute.random_load(draw)
        tensions = arm_brute.random_pull(draw, arm, load)
        state = tracker.update(tensions, load)
        again = tracker.update(tensions, load)
        assert again.bend_angles == state.bend_angles
        assert again.cable_tensions == state.cable_tensions
        assert Regime.SLIPPING not in again.regimes


def test_a_joint_that_comes_to_be_straight_on_its_way_lets_go_of_what_its_guides_held():
    """A joint of this one goes from 37 to 11 degrees past 0, which may be stepped over."""
    draw = random.Random(9018)
    arm = arm_brute.random_arm(draw)
    assert arm.cable_friction_coefficient > 0.2
    tracker, brute = ArmTracker(arm), arm_brute.BruteArm(arm, [0.0] * len(arm.units))
    for _ in range(2):
        load = arm_brute.random_load(draw)
        tensions = arm_brute.random_pull(draw, arm, load)
        state = tracker.update(tensions, load)
        brute.update(tensions, load)
    assert state.bend_angles == pytest.approx(brute.angles, abs=1e-3)


@pytest.mark.parametrize('number', range(60))
def test_an_arm_out_of_all_proportion_stays_within_its_stops_or_as_it_was(number):
    draw = random.Random(1000 + number)

    def between(low, high):
        return math.exp(draw.uniform(math.log(low), math.log(high)))

    start = draw.uniform(0.0, 1.4)
    units = [
        ArmUnit(
            JointDesign(
                ball_radius=between(1e-4, 1.0),
                cable_offset=draw.choice((0.0, between(1e-6, 1.0))),
                com_distance=draw.uniform(-1.0, 1.0),
                mass=draw.choice((0.0, between(1e-9, 100.0))),
                friction_coefficient=between(1e-3, 10.0),
                contact_start_angle=start,
                contact_end_angle=start + 0.1,
                max_bend_angle=between(1e-3, 1.5),
                gravity=9.81,
                contact_law=draw.choice(arm_brute.LAWS),
                stiffness=draw.choice((0.0, between(1e-12, 100.0))),
            ),
            draw.choice((0.0, between(1e-6, 10.0))),
        )
        for _ in range(draw.choice((2, 3, 6)))
    ]
    cables = [Cable(side, side, len(units)) for side in 'ls']
    tracker = ArmTracker(Arm(units, cables, draw.choice((0.0, between(1e-6, 2.0)))))
    for _ in range(4):
        before = tracker.bend_angles
        load = Load.tilted(draw.uniform(-3.0, 3.0), (draw.gauss(0.0, 1.0), draw.gauss(0.0, 1.0)))
        try:
            state = tracker.update({'l': between(1.0, 1e4), 's': between(1.0, 1e4)}, load)
        except TendonStaticsError:
            assert tracker.bend_angles == before
            continue
        for stop, angle, margin in zip(
            tracker.arm.stops, state.bend_angles, state.slip_margins, strict=True
        ):
            assert abs(angle) <= stop
            assert abs(margin) <= 1.0 + 1e-8 or angle == math.copysign(stop, margin)
