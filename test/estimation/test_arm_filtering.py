"""`ArmFiltering`: an arm under noise behind the interface of the estimators."""

import dataclasses

import numpy as np
import pytest
from arms import arm_of
from make_docs import ROOT

from tendon_statics import ArmFilter, ArmTracker, Regime, arm_margins, load_arm
from tendon_statics.estimation.arm_follower import ArmFollower
from tendon_statics.estimation.arm_settings import ArmSettings
from tendon_statics.estimation.estimate import KnownLoad, Remark
from tendon_statics.physics import UPRIGHT

FIVE = load_arm(ROOT / 'config/arm.yaml')
ARM = arm_of(FIVE.units[3:], cable_friction_coefficient=0.05)
SETTINGS = ArmSettings(ARM, ('first', 'second'), tension_stddev=0.02)
KNOWN = KnownLoad(UPRIGHT)


def pulls(count=12):
    return [(1.0, 1.0 + 0.1 * index) for index in range(count)]


def follow(follower, samples, start=0.0):
    return [
        follower.take_sample(pair, KNOWN, start + 0.02 * place, start + 0.02 * place)
        for place, pair in enumerate(samples)
    ]


def test_it_says_what_the_filter_says():
    estimates = follow(ArmFollower(SETTINGS, 'filtering'), pulls())
    plain = ArmFilter(ARM, tension_stddev=0.02, lag=SETTINGS.filter_lag)
    for place, (estimate, pair) in enumerate(zip(estimates, pulls(), strict=True)):
        state = plain.update(dict(zip('ls', pair, strict=True)), 0.001 + 0.02 * place)
        assert estimate.bend_angles == pytest.approx(state.bend_angles, abs=1e-12)
    last = estimates[-1]
    assert last.tip == pytest.approx(state.tip)
    for (low, high), angle in zip(last.intervals, last.bend_angles, strict=True):
        assert low <= angle <= high
    low, high = last.tip_interval
    assert low.x <= last.tip.x <= high.x
    assert last.tip_covariance.shape == (3, 3)
    for shares in last.regime_probabilities:
        assert sum(shares.values()) == pytest.approx(1.0)


def test_its_intervals_hold_the_arm_that_moved_without_noise():
    draw, tracker = np.random.default_rng(5), ArmTracker(ARM)
    noisy = [tuple(np.array(pair) + draw.normal(0.0, 0.02, 2)) for pair in pulls(16)]
    estimates = follow(ArmFollower(SETTINGS, 'filtering'), noisy)
    truth = [tracker.update(dict(zip('ls', pair, strict=True))) for pair in pulls(16)]
    held = [
        low - 0.03 <= angle <= high + 0.03
        for estimate, state in zip(estimates, truth, strict=True)
        for (low, high), angle in zip(estimate.intervals, state.bend_angles, strict=True)
    ]
    assert np.mean(held) > 0.9


def test_doubt_takes_the_intervals_and_a_measurement_gives_them_back():
    follower = ArmFollower(SETTINGS, 'filtering')
    follow(follower, pulls(4))
    follower.doubt()
    (doubtful,) = follow(follower, pulls(1), start=0.1)
    assert doubtful.angles_assured == (False, False)
    assert doubtful.intervals == (None, None)
    assert doubtful.tip_interval is doubtful.tip_covariance is None
    assert Remark.UNASSURED in doubtful.remarks
    assert follower.measure({1: 0.1, 2: 0.05}, 0.12) == []
    # What was measured counts at once, and outlasts a change of settings.
    again = follower.again(follower.newest)
    assert again.bend_angles == pytest.approx((0.1, 0.05), abs=0.04)
    follower.change_settings(dataclasses.replace(SETTINGS, tension_bias_stddev=1e-4))
    (known,) = follow(follower, pulls(1), start=0.14)
    assert known.angles_assured == (True, True)
    assert known.bend_angles == pytest.approx((0.1, 0.05), abs=0.04)


def test_what_is_newest_is_provisional_and_stays_a_lag_later_with_its_own_time():
    follower, stays = ArmFollower(dataclasses.replace(SETTINGS, filter_lag=0.1), 'filtering'), []
    for place, pair in enumerate(pulls(10) + [pulls(10)[-1]] * 20):
        now = 0.02 * place
        newest = follower.take_sample(pair, KNOWN, now, 100.0 + now)
        assert newest.is_provisional
        assert newest.measured == 100.0 + now
        stays += [(now, estimate) for estimate in follower.take_committed()]
        assert follower.take_committed() == []
    assert len(stays) >= 24
    for now, estimate in stays:
        assert not estimate.is_provisional
        assert 0.08 <= 100.0 + now - estimate.measured <= 0.13
    assert stays[-1][1].bend_angles == pytest.approx(newest.bend_angles, abs=0.01)
    tracking = ArmFollower(SETTINGS, 'tracking')
    assert not follow(tracking, pulls(2))[-1].is_provisional
    assert tracking.take_committed() == []


@pytest.mark.parametrize('end', ['doubt', 'put_back', 'change_settings'])
def test_what_waits_to_stay_is_forgotten_in_doubt_and_by_a_new_filter(end):
    follower = ArmFollower(SETTINGS, 'filtering')
    follow(follower, pulls(4))
    if end == 'doubt':
        follower.doubt()
    elif end == 'put_back':
        follower.put_back(0.1)
    else:
        follower.change_settings(dataclasses.replace(SETTINGS, tension_bias_stddev=1e-4))
    stays = []
    for place in range(20):
        now = 0.1 + 0.02 * place
        follower.take_sample((1.0, 1.0), KNOWN, now, now)
        stays += follower.take_committed()
    assert stays
    assert min(estimate.measured for estimate in stays) >= 0.1


def test_bands_end_where_a_joint_would_slip_with_the_others_frozen():
    arm = dataclasses.replace(ARM, cable_friction_coefficient=0.0)
    estimate = follow(ArmFollower(dataclasses.replace(SETTINGS, arm=arm), 'filtering'), pulls(6))[
        -1
    ]
    ends = 0
    for joint, band in enumerate(estimate.bands):
        assert band
        for end in (end for interval in band for end in interval):
            if abs(end) < arm.stops[joint]:
                angles = list(estimate.bend_angles)
                angles[joint] = end
                margins = arm_margins(arm, angles, estimate.state.tensions)
                assert abs(margins[joint]) == pytest.approx(1.0, abs=1e-9)
                ends += 1
    assert ends


def test_a_dict_says_what_the_estimate_says():
    follower = ArmFollower(dataclasses.replace(SETTINGS, confidence=0.5), 'filtering')
    sure = follow(follower, pulls(6))[-1]
    assert sure.as_dict()['intervals'] == sure.intervals
    assert sure.as_dict()['tip_stddev'] is not None
    sure.is_confirmed = False
    assert sure.as_dict()['intervals'] == (None, None)
    assert sure.as_dict()['tip_stddev'] is None


def test_a_slack_cable_leaves_all_open():
    follower = ArmFollower(SETTINGS, 'filtering')
    follow(follower, pulls(2))
    (slack,) = follow(follower, [(0.0, 1.0)], start=0.1)
    assert slack.regimes == (Regime.SLACK, Regime.SLACK)
    assert slack.bend_angles is slack.tip is None
    assert slack.bands == [[], []]
    (after,) = follow(follower, pulls(1), start=0.12)
    assert after.angles_assured == (False, False)


def test_it_is_put_back_to_where_it_began():
    follower = ArmFollower(SETTINGS, 'filtering')
    moved = follow(follower, pulls(14))[-1]
    assert max(moved.bend_angles) > 0.1
    follower.put_back(1.0)
    (back,) = follow(follower, pulls(1), start=1.0)
    assert back.bend_angles == pytest.approx((0.0, 0.0), abs=1e-3)
    assert back.angles_assured == (True, True)
