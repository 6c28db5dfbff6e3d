"""`ArmFilter`: where an arm is under noise; an arm of one is the single filter."""

import math
import random

import arm_brute
import numpy as np
import pytest
from arms import SHEATHED, arm_of, pull
from designs import PRELIMINARY
from measure_filter.sessions import UNITS
from thoroughness import few_of

from tendon_statics import (
    Arm,
    ArmError,
    ArmFilter,
    ArmTracker,
    ArmUnit,
    BendAngleError,
    Cable,
    Load,
    LoadError,
    Regime,
    StickSlipFilter,
    TensionError,
)

HANGING, _ = UNITS['hanging']
NOISE = 0.01

THREE = arm_of([SHEATHED] * 3)
BIASED = {'tension_stddev': NOISE, 'tension_bias_stddev': 0.01}


def fed(found, pairs, *, noise=NOISE, rate=200.0, start=0.0, seed=1, load=None):
    """Feed a filter with noise on tensions; return its states."""
    draw = np.random.default_rng(seed)
    more = () if load is None else (load,)
    return [
        found.update(pull(*(np.array(pair) + draw.normal(0.0, noise, 2))), start + i / rate, *more)
        for i, pair in enumerate(pairs)
    ]


def ramp(count, last=2.6, rest=0):
    return [(1.0, 1.0 + (last - 1.0) * min(i / count, 1.0)) for i in range(count + rest)]


@pytest.mark.parametrize('design', [PRELIMINARY, HANGING])
def test_an_arm_of_one_is_the_single_filter_to_the_last_bit(design):
    arm = Arm([ArmUnit(design, 0.03)], [Cable('s', 's', 1), Cable('l', 'l', 1)])
    found = ArmFilter(arm, tension_stddev=NOISE, tension_bias_stddev=0.02, seed=3)
    single = StickSlipFilter(design, tension_stddev=NOISE, tension_bias_stddev=0.02, seed=3)
    draw = np.random.default_rng(2)
    force, distance = (0.05, 0.02), 0.03
    for index in range(300):
        left, right = np.array([3.0, 3.0 + 0.01 * index]) + draw.normal(0.0, NOISE, 2)
        state = found.update(pull(left, right), index / 200.0, Load(tip_force=force))
        expected = single.update(
            left, right, index / 200.0, Load(tip_force=force, tip_distance=distance)
        )
        (joint,) = state.joints
        np.testing.assert_array_equal(joint.members, expected.members)
        assert joint.regime_probabilities == expected.regime_probabilities
        assert joint.pressure == expected.pressure
        if index == 200:
            found.measure(1, 0.1, 0.01)
            single.measure(0.1, 0.01)
    assert state.bend_angles == (expected.bend_angle,)
    assert state.joint_tensions == ((left, right),)
    np.testing.assert_array_equal(found.committed.joints[0].members, single.committed.members)
    assert found.history(0.5).joints[0].bend_angle == single.history(0.5).bend_angle


def test_without_noise_to_speak_of_it_is_the_tracker():
    found, tracker = ArmFilter(THREE, tension_stddev=1e-7), ArmTracker(THREE)
    for index, pair in enumerate(ramp(150, 1.8)):
        state = found.update(pull(*pair), index / 200.0)
        expected = tracker.update(pull(*pair))
    assert min(expected.bend_angles) > math.radians(3.0)
    assert state.bend_angles == pytest.approx(expected.bend_angles, abs=1e-3)
    assert state.tip == pytest.approx(expected.tip, abs=1e-4)


def test_a_random_arm_without_noise_to_speak_of_is_the_tracker_at_each_place():
    """With friction of the cables, several laws and forces at the tip."""
    for number in range(6):
        draw = random.Random(f'filtered {number}')
        arm = arm_brute.random_arm(draw, 3)
        load = arm_brute.random_load(draw)
        found, tracker = ArmFilter(arm, tension_stddev=1e-9, lag=0.0), ArmTracker(arm)
        for step in range(4):
            tensions = arm_brute.random_pull(draw, arm, load)
            for again in range(3):  # a rest, so that smoothing does not matter
                state = found.update(tensions, 3.0 * step + again, load)
            expected = tracker.update(tensions, load)
            assert state.bend_angles == pytest.approx(expected.bend_angles, abs=1e-3)


def test_the_same_seed_gives_the_same_and_another_one_not():
    states = [
        fed(
            ArmFilter(THREE, tension_stddev=NOISE, tension_bias_stddev=0.01, seed=seed),
            ramp(40, 1.6),
        )
        for seed in (3, 3, 4)
    ]
    np.testing.assert_array_equal(states[0][-1].members, states[1][-1].members)
    assert (states[0][-1].members != states[2][-1].members).any()


def test_at_constant_tensions_nothing_drifts():
    """3 % below the slip of the first joint to slip, where the tracker is carried along."""
    found, tracker = ArmFilter(THREE, tension_stddev=NOISE), ArmTracker(THREE)
    draw = np.random.default_rng(5)
    for index in range(few_of(4000)):
        pair = np.array([1.0, 1.333]) + draw.normal(0.0, NOISE, 2)
        state = found.update(pull(*pair), index / 200.0)
        moved = tracker.update(pull(*pair))
    assert max(moved.bend_angles) > 0.0
    assert state.intervals() == ((0.0, 0.0),) * 3
    assert all(found[Regime.HELD] == 1.0 for found in state.regime_probabilities)


def test_a_slip_of_one_joint_that_loads_the_next_is_seen_in_all_members():
    """Joint 3 slips first and takes the others along: so it does in each possible arm alone."""
    found = ArmFilter(THREE, tension_stddev=0.02, tension_bias_stddev=0.01)
    state = fed(found, ramp(60, 1.40, rest=60), noise=0.02)[-1]
    slipped = state.members > 0.0
    assert slipped.shape == (39, 3)
    assert 0 < slipped[:, 0].sum() < slipped[:, 2].sum() < 39
    tracker = ArmTracker(THREE)
    curve = np.array([tracker.update(pull(1.0, s)).bend_angles for s in np.arange(1.0, 1.6, 2e-3)])
    for member in state.members:
        assert np.abs(curve - member).max(axis=1).min() < 0.02
    tilts = state.members.sum(axis=1)
    assert state.tip.tilt == pytest.approx(float(np.median(tilts)))
    low, high = state.tip_interval()
    assert (low.tilt, high.tilt) == pytest.approx((tilts.min(), tilts.max()))


def test_what_is_new_is_provisional_and_what_is_a_lag_old_is_not():
    found = ArmFilter(THREE, tension_stddev=NOISE, lag=0.1)
    states = fed(found, ramp(60, 1.5))
    assert all(state.provisional for state in states)
    committed = found.committed
    assert not committed.provisional
    assert states[-1].time - committed.time == pytest.approx(0.1, abs=0.006)
    assert found.history(committed.time) is committed
    assert found.history(-1.0) is None
    assert set(committed.tensions) == {'l', 's'}


def test_a_measured_joint_is_put_there_and_the_others_stay():
    found = ArmFilter(THREE, tension_stddev=NOISE, bend_angle_stddev=[0.0, 0.03, 0.02])
    before = fed(found, [(1.0, 1.0)] * 40)[-1]
    assert before.bend_angle_stddevs[0] == 0.0
    assert before.bend_angle_stddevs[1] > 0.01
    found.measure(2, 0.04, 0.002)
    found.measure(3, -0.04, 0.002)
    assert found.committed.bend_angles[1:] == pytest.approx((0.04, -0.04), abs=0.002)
    state = fed(found, [(1.0, 1.0)] * 40, start=1.0)[-1]
    assert state.bend_angles == pytest.approx((0.0, 0.04, -0.04), abs=0.003)
    assert state.bend_angle_stddevs[1] == pytest.approx(0.002, rel=0.4)


def test_doubt_lasts_until_a_stop_or_a_measurement_and_is_of_each_joint():
    found = ArmFilter(THREE, tension_stddev=NOISE)
    fed(found, [(1.0, 1.2)] * 10)
    slack = found.update(pull(0.0, 1.2), 1.0)
    assert slack.is_slack
    assert slack.regimes == (Regime.SLACK,) * 3
    assert slack.bend_angles is slack.tip is slack.tip_interval() is slack.tip_stddev is None
    assert slack.intervals() == slack.pressures == slack.slip_margins == (None,) * 3
    doubted = fed(found, [(1.0, 1.2)] * 10, start=2.0)[-1]
    assert doubted.angles_assured == (False,) * 3
    assert doubted.tip_covariance is None
    found.measure(2, 0.0, 0.01)
    assert fed(found, [(1.0, 1.2)] * 10, start=3.0)[-1].angles_assured == (False, True, False)
    assert fed(found, [(1.0, 8.0)] * 60, start=4.0)[-1].angles_assured == (True,) * 3


def test_its_answers_agree_with_each_other():
    found = ArmFilter(THREE, tension_stddev=NOISE)
    state = fed(found, ramp(60, 1.6, rest=30))[-1]
    for joint, angle, interval, probabilities in zip(
        state.joints,
        state.bend_angles,
        state.intervals(),
        state.regime_probabilities,
        strict=True,
    ):
        assert interval[0] <= angle <= interval[1]
        assert sum(probabilities.values()) == pytest.approx(1.0)
        assert joint.pressure > 0.0
        assert joint.pressure_stddev > 0.0
    tracker = ArmTracker(THREE, state.bend_angles)
    expected = tracker.update(pull(1.0, 1.6))
    assert state.slip_margins == pytest.approx(expected.slip_margins, abs=0.1)
    assert state.pressures == pytest.approx(expected.pressures, rel=0.05)
    assert math.sqrt(state.tip_covariance[0, 0]) == pytest.approx(state.tip_stddev.x)
    assert set(state.as_dict()) >= {'bend_angles', 'tip', 'regimes'}


def test_bad_input_changes_nothing():
    found = ArmFilter(THREE, tension_stddev=NOISE)
    fed(found, [(1.0, 1.2)] * 10)
    for pair in ((math.nan, 1.0), (-1.0, 1.0), (0.05, 0.1)):
        with pytest.raises(TensionError):
            found.update(pull(*pair), 1.0)
    with pytest.raises(TensionError, match='missing'):
        found.update({'l': 1.0}, 1.0)
    with pytest.raises(LoadError, match='tip_distance'):
        found.update(pull(1.0, 1.2), 1.0, Load(tip_force=(0.1, 0.0), tip_distance=0.5))
    with pytest.raises(ValueError, match='is not after'):
        found.update(pull(1.0, 1.2), 0.0)
    with pytest.raises(BendAngleError, match='joint 2'):
        found.measure(2, 2.0, 0.01)
    with pytest.raises(ArmError, match='joint'):
        found.measure(4, 0.1, 0.01)
    with pytest.raises(ValueError, match='must be above 0'):
        found.measure(1, 0.1, 0.0)
    with pytest.raises(BendAngleError):
        found.reset([0.0, 0.0])
    assert fed(found, [(1.0, 1.2)], start=2.0)[-1].intervals() == ((0.0, 0.0),) * 3


@pytest.mark.parametrize(
    'wrong',
    [
        {'tension_stddev': 0.0},
        {'tension_stddev': math.nan},
        {'bend_angle_stddev': -1.0},
        {'bend_angle_stddev': [0.1, 0.1]},
        {'tension_bias_stddev': math.inf},
        {'lag': -0.1},
    ],
)
def test_deviations_that_are_none_are_refused(wrong):
    with pytest.raises(ValueError, match=r'stddev|deviations|lag'):
        ArmFilter(THREE, **{'tension_stddev': 0.01, **wrong})
