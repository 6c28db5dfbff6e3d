"""What an arm that is followed tells of the force at its tip: from measured angles, and slips."""

import dataclasses
import math
import random
from collections import Counter

import arm_brute
import numpy as np
import pytest
from arms import SHEATHED, arm_of, pull
from thoroughness import some_of

from tendon_statics import (
    UPRIGHT,
    ArmError,
    ArmFilter,
    ArmTracker,
    BendAngleError,
    Load,
    LoadError,
    Regime,
    TensionError,
    arm_tip_force,
    arm_tip_force_of_state,
)

ARM = arm_of([SHEATHED] * 3)
ACROSS = (1.0, 0.0)
NOISE = {'tension_stddev': 0.01, 'bend_angle_stddev': 0.005}


def pushed(force, *tensions, arm=ARM):
    """The state of an arm after pulls on cable s, while a force pushes across."""
    tracker = ArmTracker(arm)
    for tension in tensions:
        state = tracker.update(pull(1.0, tension), Load(tip_force=(force, 0.0)))
    return state


def unaware(state):
    """The same as one has it who does not know that something pushes."""
    return dataclasses.replace(state, load=UPRIGHT)


def all_angles(state):
    return dict(enumerate(state.bend_angles, start=1))


def test_joints_that_slip_tell_the_force_that_pushes_as_a_number():
    draw = random.Random(181)
    slipped = set()
    for _ in range(some_of(60)):
        force = draw.uniform(-0.03, 0.03)
        designs = [
            dataclasses.replace(SHEATHED.design, friction_coefficient=draw.uniform(0.2, 0.8))
            for _ in range(3)
        ]
        arm = arm_of(
            [dataclasses.replace(SHEATHED, design=design) for design in designs],
            cable_friction_coefficient=draw.choice((0.0, 0.1)),
        )
        state = pushed(force, draw.uniform(1.1, 1.5), draw.uniform(1.3, 2.4), arm=arm)
        count = state.regimes.count(Regime.SLIPPING)
        if not count or Regime.DRIVEN_TO_STOP in state.regimes:
            continue
        slipped.add(count)
        found = arm_tip_force_of_state(
            unaware(state), direction=ACROSS, bend_angles=all_angles(state)
        )
        assert found.at_limit
        assert found.force == pytest.approx(force, abs=1e-9)
        assert found.force_stddev == 0.0
        noisy = arm_tip_force_of_state(
            unaware(state), direction=ACROSS, bend_angles=all_angles(state), **NOISE
        )
        assert noisy.at_limit
        assert noisy.force == pytest.approx(force, abs=1e-8)
        assert 0.0 < noisy.force_stddev < 0.1
        ((low, high),) = noisy.intervals
        assert low < force < high
    assert len(slipped) > 1, slipped


def test_the_number_of_noisy_readings_is_off_by_its_deviation():
    draw, off = random.Random(183), []
    while len(off) < some_of(400):
        state = pushed(0.01, draw.uniform(1.3, 2.0))
        if Regime.SLIPPING not in state.regimes or Regime.DRIVEN_TO_STOP in state.regimes:
            continue
        tensions = {
            name: of[0] + draw.gauss(0.0, 0.01) for name, of in state.cable_tensions.items()
        }
        found = arm_tip_force(
            *(ARM, tensions),
            bend_angles=[angle + draw.gauss(0.0, 0.005) for angle in state.bend_angles],
            direction=ACROSS,
            slipping={
                joint: 's'
                for joint, regime in enumerate(state.regimes, start=1)
                if regime is Regime.SLIPPING
            },
            **NOISE,
        )
        if found.force is not None:
            off.append((found.force - 0.01) / found.force_stddev)
    assert np.mean(np.abs(off) < 1.96) > 0.9
    assert abs(np.mean(off)) < 0.4


def test_random_arms_that_were_followed_are_explained_by_the_force_that_pushes():
    """Also where a joint has slipped, and others that slipped then have taken it back again."""
    draw = random.Random(182)
    seen = Counter()
    for _ in range(some_of(120)):
        arm = arm_brute.random_arm(draw)
        base = Load.tilted(draw.choice((0.0, draw.uniform(-0.5, 0.5))))
        of, force = draw.uniform(-math.pi, math.pi), draw.uniform(-0.1, 0.1)
        direction = math.sin(of), math.cos(of)
        load = dataclasses.replace(base, tip_force=tuple(force * part for part in direction))
        tracker = ArmTracker(arm)
        for _ in range(3):
            tensions = arm_brute.random_pull(draw, arm, load)
            try:
                state = tracker.update(tensions, load)
            except TensionError:
                break
            found = arm_tip_force_of_state(
                dataclasses.replace(state, load=base),
                direction=direction,
                bend_angles=all_angles(state),
            )
            slack = 1e-8 * sum(tensions.values())
            assert any(low - slack <= force <= high + slack for low, high in found.intervals)
            if found.force is not None:
                assert found.force == pytest.approx(force, abs=slack)
            seen['number'] += found.force is not None
            seen['set'] += not found.at_limit
            margins = zip(state.regimes, state.slip_margins, strict=True)
            seen['taken back'] += any(
                regime is Regime.SLIPPING and abs(margin) < 0.99 for regime, margin in margins
            )
    assert all(seen[kind] for kind in ('number', 'set', 'taken back')), seen


def test_an_arm_at_rest_tells_the_set_of_its_tensions_and_angles():
    state = pushed(0.004, 1.9, 1.85)
    assert set(state.regimes) == {Regime.HELD}
    found = arm_tip_force_of_state(unaware(state), direction=ACROSS, bend_angles=all_angles(state))
    assert found == arm_tip_force(
        ARM, pull(1.0, 1.85), bend_angles=state.bend_angles, direction=ACROSS
    )
    assert not found.at_limit
    assert found.force is None
    ((low, high),) = found.intervals
    assert low < 0.004 < high


def test_without_a_measured_angle_a_slipping_arm_tells_zero_and_is_no_evidence():
    found = arm_tip_force_of_state(unaware(pushed(0.0, 2.1)), direction=ACROSS)
    assert found.at_limit
    assert found.force == pytest.approx(0.0, abs=1e-9)


def test_joints_that_are_not_measured_have_the_deviation_of_the_state_and_no_limit():
    state = pushed(0.0, 2.1)
    assert state.regimes.count(Regime.SLIPPING) > 1
    angles = state.bend_angles
    found = arm_tip_force_of_state(state, direction=ACROSS, bend_angles={1: angles[0]}, **NOISE)
    own = state.bend_angle_stddevs(0.01)
    slips = {1: 's'} if state.regimes[0] is Regime.SLIPPING else {}
    assert found == arm_tip_force(
        *(ARM, pull(1.0, 2.1)),
        bend_angles=angles,
        direction=ACROSS,
        slipping=slips,
        tension_stddev=0.01,
        bend_angle_stddev=(0.005, *own[1:]),
    )


def test_a_joint_measured_elsewhere_than_the_tracker_has_it_is_not_taken_to_slip():
    state = pushed(0.0, 2.1)
    elsewhere = {joint: angle - 0.1 for joint, angle in all_angles(state).items()}
    found = arm_tip_force_of_state(state, direction=ACROSS, bend_angles=elsewhere, **NOISE)
    assert not found.at_limit
    told = arm_tip_force_of_state(
        state, direction=ACROSS, bend_angles=elsewhere, slipping={2: 's'}, **NOISE
    )
    assert told.at_limit


def test_a_joint_next_to_its_stop_may_lean_on_it():
    state = pushed(0.0, 9.0)
    assert Regime.DRIVEN_TO_STOP in state.regimes
    leaning = [
        joint
        for joint, regime in enumerate(state.regimes, start=1)
        if regime is Regime.DRIVEN_TO_STOP
    ]
    tensions = pull(1.0, 9.0)
    for short, noise in ((0.0, {}), (0.01, NOISE)):
        angles = {j: a - short * (j in leaning) for j, a in all_angles(state).items()}
        found = arm_tip_force_of_state(state, direction=ACROSS, bend_angles=angles, **noise)
        asked = {'bend_angles': [*angles.values()], 'direction': ACROSS, **noise}
        assert found == arm_tip_force(ARM, tensions, at_stop=leaning, **asked)
        by_friction = arm_tip_force(ARM, tensions, **asked)
        for joint in leaning:
            ((low, high),) = found.joint_intervals[joint - 1]
            for one_low, one_high in by_friction.joint_intervals[joint - 1]:
                assert low < one_low or high > one_high


def test_a_filter_says_of_a_joint_that_it_slips_and_the_true_force_is_inside():
    found = ArmFilter(ARM, tension_stddev=0.01)
    draw = random.Random(3)
    for index in range(120):
        tension_s = 1.0 + 1.1 * index / 120
        tensions = pull(1.0 + draw.gauss(0.0, 0.01), tension_s + draw.gauss(0.0, 0.01))
        state = found.update(tensions, index / 200.0)
    assert Regime.SLIPPING in state.regimes
    told = arm_tip_force_of_state(state, direction=ACROSS, bend_angles=all_angles(state), **NOISE)
    assert told.at_limit
    assert told.force == pytest.approx(0.0, abs=5.0 * told.force_stddev)
    held = arm_tip_force_of_state(state, direction=ACROSS, tension_stddev=0.01)
    assert held.at_limit


def test_an_angle_that_nobody_vouches_for_is_refused_unless_it_was_measured():
    tracker = ArmTracker(ARM)
    tracker.doubt()
    state = tracker.update(pull(1.0, 1.05))
    with pytest.raises(BendAngleError, match='joint 1 is not assured'):
        arm_tip_force_of_state(state, direction=ACROSS)
    angles = dict.fromkeys((1, 2, 3), 0.0)
    assert arm_tip_force_of_state(state, direction=ACROSS, bend_angles=angles).intervals


@pytest.mark.parametrize(
    ('changed', 'error', 'reason'),
    [
        ({'direction': (0.0, 0.0)}, LoadError, 'length zero'),
        ({'direction': (0.0, 1.0, 0.0)}, LoadError, 'out of the plane'),
        ({'bend_angles': {2: 0.6}}, BendAngleError, 'joint 2: bend_angle is 0.6'),
        ({'bend_angles': {2: math.nan}}, BendAngleError, 'joint 2: bend_angle is nan'),
        ({'bend_angles': {4: 0.1}}, ArmError, 'joints 1 to 3'),
        ({'slipping': {0: 's'}}, ArmError, 'joints 1 to 3'),
        ({'slipping': {1: 'both'}}, ValueError, "slipping of joint 1 is 'both'"),
        ({'design_covariance': [None]}, ArmError, 'has 1 values, but the arm has 3 units'),
        ({'level': 0.2}, ValueError, 'level is 0.2'),
        ({'tensions': pull(1.0, 0.0)}, TensionError, 'joint 1 is slack'),
    ],
)
def test_bad_input_is_refused_with_the_reason_in_one_line(changed, error, reason):
    tensions = changed.get('tensions', pull(1.0, 1.1))
    state = ArmTracker(ARM).update(tensions)
    asked = {'direction': ACROSS, **changed}
    asked.pop('tensions', None)
    with pytest.raises(error, match=reason) as raised:
        arm_tip_force_of_state(state, **asked)
    assert '\n' not in str(raised.value)
