"""What pushes at the tip of an arm over time: measured angles, motion, and what is no evidence."""

import math

import pytest
from arms import arm_of, pull
from designs import HANGING, PRELIMINARY

from tendon_statics import (
    ArmTracker,
    ArmUnit,
    Regime,
    arm_tip_force,
    tensions_for,
)
from tendon_statics.estimation.arm_estimate import ArmEstimate
from tendon_statics.estimation.arm_settings import ArmSettings
from tendon_statics.estimation.arm_tip_force_watch import ArmTipForceWatch
from tendon_statics.estimation.estimate import KnownLoad

ARM = arm_of([ArmUnit(PRELIMINARY, 0.02)] * 2)
SETTINGS = ArmSettings(ARM, ('one', 'two'))
EVEN = pull(1.0, 1.1)
ASKED = {
    'direction': (1.0, 0.0),
    'tension_stddev': SETTINGS.tension_stddev,
    'bend_angle_stddev': SETTINGS.measured_bend_angle_stddev,
}


def measured(watch, paths, until=1.0):
    """Measure angles of joints 100 times a second, up to a time in s."""
    for index in range(int(100.0 * until) + 1):
        time = 0.01 * index
        watch.note_angles({joint: path(time) for joint, path in paths.items()}, time, SETTINGS)


def estimated(state, *, is_assured=True):
    return ArmEstimate(state, KnownLoad(state.load, is_assured), SETTINGS)


def held(**more):
    return estimated(ArmTracker(ARM).update(EVEN), **more)


def test_measured_angles_at_rest_give_the_set_of_them():
    watch = ArmTipForceWatch(2)
    measured(watch, {1: lambda _: 0.05, 2: lambda _: -0.1})
    found = watch.ask(held(), SETTINGS, 1.0)
    assert found.is_measured
    assert found.found == arm_tip_force(ARM, EVEN, bend_angles=[0.05, -0.1], **ASKED)
    assert math.isnan(found.bend_angle)


@pytest.mark.parametrize(('speed', 'side'), [(0.3, 's'), (-0.3, 'l')])
def test_while_one_joint_moves_steadily_the_force_is_a_number(speed, side):
    watch = ArmTipForceWatch(2)
    measured(watch, {1: lambda _: 0.05, 2: lambda time: speed * time})
    found = watch.ask(held(), SETTINGS, 1.0).found
    assert found.at_limit
    assert found == arm_tip_force(
        ARM, EVEN, bend_angles=[0.05, speed], slipping={2: side}, **ASKED
    )
    assert found.joint_intervals[1][0][0] == found.joint_intervals[1][0][1]


def test_joints_that_do_not_move_are_at_no_limit_though_a_tracker_has_them_slipping():
    arm = arm_of([ArmUnit(HANGING, 0.02)])
    settings = ArmSettings(arm, ('one',))
    state = ArmTracker(arm).update(pull(*tensions_for(HANGING, 0.001, total_tension=9.0)))
    assert state.regimes == (Regime.SLIPPING,)
    watch = ArmTipForceWatch(1)
    for index in range(100):
        watch.note_angles({1: 0.0}, 0.01 * index, settings)
    estimate = ArmEstimate(state, KnownLoad(state.load, is_assured=True), settings)
    assert not watch.ask(estimate, settings, 1.0).found.at_limit


def test_a_joint_that_is_not_measured_is_where_the_tracker_has_it_and_that_is_no_evidence():
    watch = ArmTipForceWatch(2)
    measured(watch, {2: lambda _: 0.1})
    found = watch.ask(held(), SETTINGS, 1.0)
    assert not found.is_measured
    own = held().bend_angle_stddevs[0]
    stddevs = (own, SETTINGS.measured_bend_angle_stddev)
    asked = {**ASKED, 'bend_angle_stddev': stddevs}
    assert found.found == arm_tip_force(ARM, EVEN, bend_angles=[0.0, 0.1], **asked)
    # Of long ago, and beyond a stop or none at all, it is as if it were not measured.
    assert not watch.ask(held(), SETTINGS, 9.0).is_measured
    watch.note_angles({1: math.nan, 2: 3.0}, 1.0, SETTINGS)
    assert watch.ask(held(), SETTINGS, 1.0).found == found.found


def test_nothing_is_said_while_a_cable_is_slack_or_an_angle_is_not_known():
    watch = ArmTipForceWatch(2)
    measured(watch, {1: lambda _: 0.0})
    tracker = ArmTracker(ARM)
    slack = estimated(tracker.update(pull(1.0, 0.0)))
    assert watch.ask(slack, SETTINGS, 1.0) is None
    doubted = estimated(tracker.update(EVEN))  # joint 2 may have moved
    assert watch.ask(doubted, SETTINGS, 1.0) is None
    unsure = held(is_assured=False)  # of a load that may be another
    assert watch.ask(unsure, SETTINGS, 1.0) is None
    watch.note_angles({2: 0.0}, 1.0, SETTINGS)
    assert watch.ask(doubted, SETTINGS, 1.0).is_measured
    assert watch.ask(unsure, SETTINGS, 1.0).is_measured
    watch.forget()
    assert watch.ask(doubted, SETTINGS, 1.0) is None
