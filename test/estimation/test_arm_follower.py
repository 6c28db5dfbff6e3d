"""An arm from its readings, without ROS: where it is, what casts doubt, what is counted."""

import dataclasses
import math
import random

import pytest
from arms import arm_of
from designs import PRELIMINARY

from tendon_statics import Arm, ArmTracker, ArmUnit, Cable, Load, Regime
from tendon_statics.estimation.arm_follower import ArmFollower
from tendon_statics.estimation.arm_settings import ArmSettings
from tendon_statics.estimation.estimate import KnownLoad, Remark
from tendon_statics.estimation.settings import Settings
from tendon_statics.estimation.unit_estimator import UnitEstimator
from tendon_statics.physics import UPRIGHT
from tendon_statics.tensions.cable_scale import CableScale
from tendon_statics.tensions.reason import ReadingError, Reason

CABLES = [Cable(f'{side}{unit}', side, unit) for unit in (1, 3) for side in 'ls']
STIFF = dataclasses.replace(PRELIMINARY, stiffness=0.05)
ARM = Arm([ArmUnit(STIFF, 0.03)] * 3, CABLES)
NAMES = ('base', 'elbow', 'wrist')
KNOWN = KnownLoad(UPRIGHT)
EVEN, PULLED = (1.0,) * 4, (1.0, 1.0, 1.0, 2.6)


def follower(**changes):
    return ArmFollower(ArmSettings(ARM, NAMES, **changes))


def taken(arm, *rows, step=0.01, known=KNOWN):
    return [arm.take_readings(row, known, step * i, step * i) for i, row in enumerate(rows)]


def test_readings_become_tensions_and_are_followed():
    scales = (CableScale(2.0, -1.0), *(CableScale(),) * 3)
    arm = follower(cables=scales, initial_bend_angles=(0.0, 0.01, 0.0))
    (found,) = taken(arm, (1.0, 1.0, 1.0, 2.6))
    state = ArmTracker(ARM, (0.0, 0.01, 0.0)).update(
        dict(zip(ARM.cable_names, PULLED, strict=True))
    )
    assert found.bend_angles == state.bend_angles
    assert found.pressures == state.pressures
    assert arm.newest.tensions == PULLED
    assert arm.health.solved == 1


@pytest.mark.parametrize(
    ('row', 'reason', 'text'),
    [
        ((math.nan, 1.0, 1.0, 1.0), Reason.NOT_FINITE, 'the tension of l1 is nan N'),
        ((1.0, -9.0, 1.0, 1.0), Reason.NEGATIVE, 'the tension of s1 is -9.0 N'),
        ((1.0, -9.0, 1.0, 2000.0), Reason.IMPLAUSIBLE, 'the tension of s3 is 2000.0 N'),
    ],
)
def test_a_reading_that_is_none_leaves_the_arm_and_casts_doubt_on_all_joints(row, reason, text):
    arm = follower()
    (before,) = taken(arm, EVEN)
    with pytest.raises(ReadingError, match=text) as error:
        arm.take_readings(row, KNOWN, 0.1)
    assert error.value.reason is reason
    after = arm.take_readings(EVEN, KNOWN, 0.2)
    assert before.angles_assured == (True,) * 3
    assert after.angles_assured == (False,) * 3
    assert after.bend_angles == before.bend_angles
    assert after.remarks == [Remark.UNASSURED]
    assert after.place_of(Remark.UNASSURED) == 'base, elbow, wrist'
    assert after.bend_angle_stddevs == (None,) * 3
    assert after.tip_covariance is None


def test_only_who_measures_all_joints_vouches_for_the_arm():
    arm = follower()
    taken(arm, EVEN)
    assert arm.measure({2: 0.01}, 0.6) == []
    assert not any(arm.take_readings(EVEN, KNOWN, 1.0).angles_assured)
    assert arm.measure({1: 0.0, 2: 0.01, 3: 0.0}, 1.4) == []
    assert all(arm.take_readings(EVEN, KNOWN, 1.8).angles_assured)
    (fault,) = arm.measure({1: 0.0, 3: 7.0}, 1.8)
    assert str(fault).startswith('joint 3: bend_angle is 7.0')


def test_before_the_load_is_known_the_arm_stays_where_it_began():
    arm = follower()
    unknown = KnownLoad(UPRIGHT, is_assured=False, is_measured=False)
    (imagined,) = taken(arm, PULLED, known=unknown)
    assert any(imagined.bend_angles)
    assert imagined.remarks == [Remark.LOAD, Remark.UNASSURED]
    assert not any(arm.take_readings(EVEN, KNOWN, 0.1).bend_angles)


def test_a_slack_joint_is_the_worst_and_nothing_is_said_of_any():
    (found,) = taken(follower(), (1.0, 1.0, 1.0, 0.0))
    assert found.regimes == (Regime.SLACK,) * 3
    assert found.bend_angles is found.tip is None
    assert found.summary == 'worst is elbow, slack'
    assert found.as_dict()['tip_stddev'] is None


def test_the_worst_joint_is_named_with_its_regime_and_margin():
    held, slipped = taken(follower(), EVEN, PULLED)
    assert held.summary.startswith(('worst is base, held', 'worst is elbow, held'))
    assert Regime.SLIPPING in slipped.regimes
    worst = slipped.worst
    assert slipped.regimes[worst] in (Regime.SLIPPING, Regime.DRIVEN_TO_STOP)
    assert NAMES[worst] in slipped.summary


def test_noise_that_can_slip_a_joint_is_remarked_and_the_joint_is_named():
    weak = arm_of([ArmUnit(PRELIMINARY, 0.03)] * 2)
    arm = ArmFollower(ArmSettings(weak, ('a', 'b'), tension_stddev=0.1))
    (found,) = taken(arm, (1.0, 1.8))
    assert Remark.NOISE in found.slow_remarks
    assert found.place_of(Remark.NOISE) in ('a', 'b', 'a, b')
    calm = ArmFollower(ArmSettings(weak, ('a', 'b'), tension_stddev=1e-6))
    (found,) = taken(calm, (1.0, 1.8))
    assert found.slow_remarks == []


def test_what_would_be_is_asked_without_moving_the_arm():
    arm = follower()
    taken(arm, EVEN)
    tilted = KnownLoad(Load((1.0, 0.0, 0.0)))
    assert arm.imagine(PULLED, tilted).bend_angles != arm.imagine(PULLED, KNOWN).bend_angles
    assert not any(arm.take_readings(EVEN, KNOWN, 0.1).bend_angles)
    assert arm.put_back(0.1) == 'the joints are at 0, 0, 0 rad'


def test_an_arm_of_one_unit_says_what_the_unit_says_while_tracking():
    one = arm_of([ArmUnit(PRELIMINARY, 0.03)])
    arm = ArmFollower(ArmSettings(one, ('joint',)))
    unit = UnitEstimator(Settings(PRELIMINARY), 'tracking')
    generator = random.Random(4)
    for place in range(300):
        row = (1.0, 0.0) if place % 97 == 50 else (1.0, 1.0 + 1.2 * generator.random())
        now = 0.01 * place + (2.0 if place > 200 else 0.0)
        ours = arm.take_readings(row, KNOWN, now, now)
        theirs = unit.take(*row, KNOWN, now, now)
        assert ours.regimes == (theirs.regime,)
        assert ours.bend_angles == (None if theirs.bend_angle is None else (theirs.bend_angle,))
        assert ours.slip_margins == (theirs.slip_margin,)
        assert ours.pressures == (theirs.pressure,)
        assert ours.angles_assured == (theirs.angle_assured,)
        (stddev,) = ours.bend_angle_stddevs
        assert (stddev is None) == (theirs.bend_angle_stddev is None)
        assert stddev is None or stddev == pytest.approx(theirs.bend_angle_stddev, rel=1e-12)
