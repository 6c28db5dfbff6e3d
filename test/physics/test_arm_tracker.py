"""`ArmTracker`: an arm of one is the single unit; what several units do together."""

import dataclasses
import math
import random

import arm_brute
import brute
import pytest
from arms import SHEATHED, arm_of, pull
from designs import PRELIMINARY

from tendon_statics import (
    Arm,
    ArmTracker,
    ArmUnit,
    Cable,
    Load,
    Regime,
    StickSlipTracker,
    TensionError,
    arm_margins,
    slip_margin,
)

UNIT = ArmUnit(PRELIMINARY, 0.02)
WEIGHTLESS = ArmUnit(dataclasses.replace(PRELIMINARY, mass=0.0), 0.02)


@pytest.mark.parametrize('number', range(40))
def test_an_arm_of_one_is_the_single_unit_to_the_last_bit(number):
    draw = random.Random(500 + number)
    case = brute.random_case(draw)
    length = draw.uniform(0.0, 0.05)
    arm = arm_of([ArmUnit(case.design, length)])
    tracker, single = ArmTracker(arm), StickSlipTracker(case.design)
    for _ in range(30):
        load = dataclasses.replace(case.load, tip_distance=length)
        if draw.random() < 0.3:
            load = Load.tilted(draw.uniform(-1.0, 1.0), load.tip_force, length)
        left, right = (
            draw.choice((1.0, draw.uniform(0.5, 2.0))) * tension
            for tension in (case.tension_l, case.tension_s)
        )
        if draw.random() < 0.05:
            left = 0.0
        try:
            expected = single.update(left, right, load)
        except TensionError:
            with pytest.raises(TensionError):
                tracker.update(pull(left, right), load)
            continue
        state = tracker.update(pull(left, right), load)
        (joint,) = state.joints
        assert joint.as_dict() == expected.as_dict()
        assert tracker.bend_angles == (single.bend_angle,)
        if expected.regime is not Regime.SLACK:
            assert state.slip_margins == (expected.slip_margin,)
            margin = slip_margin(case.design, left, right, single.bend_angle, load)
            assert arm_margins(arm, [single.bend_angle], pull(left, right), load) == (margin,)
            (deviation,) = state.bend_angle_stddevs(0.01)
            assert deviation == pytest.approx(expected.bend_angle_stddev(0.01) or deviation)


@pytest.mark.parametrize('number', range(12))
def test_the_flow_of_one_joint_ends_where_the_single_unit_lands(number):
    """Of two units whose other joint is far from slipping."""
    draw = random.Random(900 + number)
    case = brute.random_case(draw)
    while case.design.weight > 2.0 or case.design.contact_law == 'merged':
        case = brute.random_case(draw)
    rough = dataclasses.replace(
        case.design,
        friction_coefficient=9.0,
        cable_offset=0.0,
        mass=0.0,
        contact_law='friction_circle',
    )
    rough = dataclasses.replace(rough, ball_radius=1.0)
    arm = Arm(
        [ArmUnit(rough, 0.0), ArmUnit(case.design, 0.03)], [Cable('l', 'l', 2), Cable('s', 's', 2)]
    )
    tracker, single = ArmTracker(arm), StickSlipTracker(case.design)
    load = dataclasses.replace(case.load, tip_distance=0.03)
    state = tracker.update(pull(case.tension_l, case.tension_s), load)
    expected = single.update(case.tension_l, case.tension_s, load)
    assert state.bend_angles[0] == 0.0
    assert state.bend_angles[1] == pytest.approx(expected.bend_angle, abs=1e-8)
    assert state.regimes[1] is expected.regime


def test_identical_weightless_joints_slip_together_all_the_way():
    tracker = ArmTracker(arm_of([WEIGHTLESS] * 4))
    at_limit = max(
        arm_margins(tracker.arm, [0.0] * 4, pull(1.0, 1.0 + step / 1000.0))[0]
        for step in range(1200)
    )
    assert at_limit > 1.0
    margins = arm_margins(tracker.arm, [0.3, 0.1, -0.2, 0.0], pull(1.0, 1.7))
    assert margins == pytest.approx([margins[0]] * 4, rel=1e-12)
    state = tracker.update(pull(1.0, 3.0))
    assert set(state.bend_angles) == {PRELIMINARY.max_bend_angle}
    assert set(state.regimes) == {Regime.DRIVEN_TO_STOP}


def test_with_weight_the_joints_of_a_standing_arm_differ():
    margins = arm_margins(arm_of([UNIT] * 3), [0.0] * 3, pull(1.0, 1.5))
    # The weight unloads the ball under the paper's law, and joint 1 carries most of it...
    assert len(set(margins)) == 3
    # ... and the lever of what is beyond makes the base slip where the arm leans.
    leaning = arm_margins(arm_of([UNIT] * 3), [0.4] * 3, pull(1.0, 1.5))
    assert leaning[0] > leaning[1] > leaning[2]


def test_the_order_of_the_cables_is_of_no_account():
    draw = random.Random(3)
    arm = arm_brute.random_arm(draw, 4)
    turned = dataclasses.replace(arm, cables=arm.cables[::-1])
    one, other = ArmTracker(arm), ArmTracker(turned)
    for _ in range(5):
        load = arm_brute.random_load(draw)
        tensions = arm_brute.random_pull(draw, arm, load)
        first = one.update(tensions, load).bend_angles
        second = other.update(dict(reversed(tensions.items())), load).bend_angles
        assert first == pytest.approx(second, abs=1e-6)


def test_the_mirror_image_moves_as_the_mirror_image():
    draw = random.Random(11)
    for _ in range(6):
        arm = arm_brute.random_arm(draw)
        cables = [
            dataclasses.replace(cable, side='s' if cable.side == 'l' else 'l')
            for cable in arm.cables
        ]
        one, other = ArmTracker(arm), ArmTracker(dataclasses.replace(arm, cables=cables))
        for _ in range(3):
            load = arm_brute.random_load(draw)
            tensions = arm_brute.random_pull(draw, arm, load)
            angles = one.update(tensions, load).bend_angles
            mirrored = other.update(tensions, load.mirrored()).bend_angles
            assert mirrored == pytest.approx([-angle for angle in angles], abs=1e-9)


def test_what_is_beyond_a_joint_that_is_pressed_on_its_stop_is_one_body_with_it():
    """Two units of which the outer is held are one unit of their weight, and slip as that does."""
    outer = dataclasses.replace(
        PRELIMINARY, friction_coefficient=9.0, contact_law='friction_circle'
    )
    inner = dataclasses.replace(
        PRELIMINARY, contact_law='friction_circle', friction_coefficient=0.4
    )
    arm = arm_of([ArmUnit(inner, 0.02), ArmUnit(outer, 0.02)])
    both = dataclasses.replace(
        inner, mass=2.0 * inner.mass, com_distance=0.5 * (0.008 + 0.02 + 0.008)
    )
    for tilt in (0.0, 0.4, -1.2, 2.0):
        load = Load.tilted(tilt)
        for tension in (1.2, 2.0, 3.0):
            margin = arm_margins(arm, [0.1, 0.0], pull(1.5, tension), load)[0]
            alone = slip_margin(both, 1.5, tension, 0.1, load)
            assert margin == pytest.approx(alone, rel=1e-12)


def test_a_slip_of_one_joint_frees_another():
    arm = arm_of([UNIT] * 4)
    tracker = ArmTracker(arm)
    tensions = pull(1.0, 2.051)
    margins = arm_margins(arm, [0.0] * 4, tensions)
    assert [abs(margin) > 1.0 for margin in margins] == [False, False, False, True]
    state = tracker.update(tensions)
    assert set(state.regimes) == {Regime.DRIVEN_TO_STOP}


def test_the_friction_of_the_cables_makes_a_pull_and_a_release_differ():
    without = ArmTracker(arm_of([SHEATHED] * 3))
    exactly = ArmTracker(arm_of([SHEATHED] * 3, cable_friction_coefficient=0.0))
    with_friction = ArmTracker(arm_of([SHEATHED] * 3, cable_friction_coefficient=0.2))
    pulls = [1.0, 1.4, 1.8, 2.2, 2.6, 2.2, 1.8, 1.4, 1.0]
    paths = [
        [tracker.update(pull(1.0, tension)) for tension in pulls]
        for tracker in (without, exactly, with_friction)
    ]
    for one, other in zip(*paths[:2], strict=True):
        assert one.bend_angles == other.bend_angles
    rubbed = paths[2]
    up, down = rubbed[2], rubbed[-3]
    assert up.tensions == down.tensions
    # A pull arrives weakened at the tip; after it, the cable holds there what the base let go.
    assert up.cable_tensions['s'][2] < 1.8 < down.cable_tensions['s'][2]
    assert sum(down.bend_angles) > sum(up.bend_angles) + 0.01


def test_friction_keeps_each_tension_within_its_band_and_remembers():
    arm = arm_of([SHEATHED] * 3, cable_friction_coefficient=0.3)
    tracker = ArmTracker(arm, [0.3, 0.2, 0.1])
    first = tracker.update(pull(1.0, 1.0))
    assert first.cable_tensions['s'] == (1.0, 1.0, 1.0)
    angles = first.bend_angles
    within = tracker.update(pull(1.0, 1.0 + 1e-4))
    assert within.bend_angles == angles
    assert within.cable_tensions['s'] == (1.0, 1.0, 1.0)
    more = tracker.update(pull(1.0, 1.5)).cable_tensions['s']
    at = tracker.bend_angles
    for before, after, angle in zip((1.5, *more), more, at, strict=False):
        assert before * math.exp(-0.3 * abs(angle)) <= after * (1.0 + 1e-12)
        assert after <= before * math.exp(0.3 * abs(angle)) * (1.0 + 1e-12)


def test_measured_and_reset_angles_are_where_the_arm_goes_on():
    tracker = ArmTracker(arm_of([UNIT] * 3))
    tracker.measure(2, 0.2)
    assert tracker.bend_angles == (0.0, 0.2, 0.0)
    state = tracker.update(pull(2.0, 2.0))
    assert state.bend_angles == (0.0, 0.2, 0.0)
    tracker.reset([0.1, 0.0, -0.1])
    assert tracker.update(pull(2.0, 2.0)).bend_angles == (0.1, 0.0, -0.1)


def test_a_slack_joint_leaves_nothing_to_say_until_stops_and_measurements_tell():
    arm = Arm([UNIT] * 2, [*arm_of([UNIT] * 2).cables, Cable('l1', 'l', 1), Cable('s1', 's', 1)])
    tracker = ArmTracker(arm)
    tensions = {'l': 1.0, 's': 1.0, 'l1': 1.0, 's1': 0.0}
    assert not tracker.update(tensions).is_slack  # cable s still pulls both units
    state = tracker.update({**tensions, 's': 0.0})
    assert state.is_slack
    assert state.bend_angles is None
    assert state.tip is None
    assert state.slip_margins == (None, None)
    assert state.tip_stddev(0.01) is None
    state = tracker.update({**tensions, 's': 1.0})
    assert state.angles_assured == (False, False)
    assert state.tip_stddev(0.01) is None
    tracker.measure(1, 0.1)
    assert tracker.update({**tensions, 's': 1.0}).angles_assured == (True, False)
    state = tracker.update({**tensions, 's': 9.0})
    assert state.angles_assured == (True, True)
    assert state.tip_stddev(0.01) == (0.0, 0.0, 0.0)


def test_the_tip_is_where_the_units_lead():
    tracker = ArmTracker(arm_of([UNIT] * 3), [0.1, 0.2, -0.4])
    tip = tracker.update(pull(2.0, 2.0)).tip
    assert tip.tilt == pytest.approx(-0.1)
    assert tip.x == pytest.approx(0.02 * (math.sin(0.1) + math.sin(0.3) + math.sin(-0.1)))
    assert tip.z == pytest.approx(0.02 * (math.cos(0.1) + math.cos(0.3) + math.cos(-0.1)))


@pytest.mark.parametrize('friction', [0.0, 0.1])
def test_deviations_are_those_of_many_noisy_pulls(friction):
    arm = arm_of([SHEATHED] * 3, cable_friction_coefficient=friction)
    noise, draw = 1e-4, random.Random(5)

    def state_after(noise):
        tracker = ArmTracker(arm)
        for tension in (1.0, 2.2):
            state = tracker.update(
                pull(1.0 + draw.gauss(0.0, noise), tension + draw.gauss(0, noise))
            )
        return state

    exact = state_after(0.0)
    assert Regime.SLIPPING in exact.regimes
    tips = [state_after(noise).tip for _ in range(100)]
    for index, claimed in enumerate(exact.tip_stddev(noise)):
        mean = sum(tip[index] for tip in tips) / len(tips)
        found = math.sqrt(sum((tip[index] - mean) ** 2 for tip in tips) / len(tips))
        assert claimed == pytest.approx(found, rel=0.3)
        assert claimed > 0.0


@pytest.mark.parametrize('number', [134, 236, 463, 1974, 2916, 3294])
def test_a_joint_that_another_took_barely_from_its_limit_has_the_deviation_of_one_at_it(number):
    """Beside differences by each tension; arms that do it are one in 400."""
    draw = random.Random(number)
    arm = arm_brute.random_arm(draw, 2)
    load = arm_brute.random_load(draw)
    tensions = arm_brute.random_pull(draw, arm, load)

    def state_at(**changed):
        return ArmTracker(arm).update({**tensions, **changed}, load)

    state, step = state_at(), 1e-5
    within = [
        1.0 - abs(margin)
        for regime, margin in zip(state.regimes, state.slip_margins, strict=True)
        if regime is Regime.SLIPPING
    ]
    assert any(1e-6 < one < 1e-3 for one in within)
    variances = [0.0, 0.0]
    for name, tension in tensions.items():
        ends = [state_at(**{name: tension + by}).bend_angles for by in (-step, step)]
        for joint, (before, after) in enumerate(zip(*ends, strict=True)):
            variances[joint] += ((after - before) / (2.0 * step)) ** 2
    found = [math.sqrt(variance) for variance in variances]
    assert state.bend_angle_stddevs(1.0) == pytest.approx(found, rel=0.03)


def test_a_copy_goes_on_alone():
    tracker = ArmTracker(arm_of([UNIT] * 2))
    tracker.update(pull(1.0, 1.5))
    other = tracker.copy()
    other.update(pull(1.0, 3.0))
    other.measure(1, 0.0)
    assert tracker.bend_angles == (0.0, 0.0)
    assert tracker.update(pull(1.0, 1.6)).angles_assured == (True, True)


def test_states_are_json():
    import json

    state = ArmTracker(arm_of([UNIT] * 2)).update(pull(1.0, 2.5))
    assert json.loads(json.dumps(state.as_dict(), allow_nan=False))['regimes'] == [
        'driven_to_stop',
        'driven_to_stop',
    ]
