"""What an arm is, and what is refused."""

import math

import pytest
from designs import PRELIMINARY

from tendon_statics import (
    Arm,
    ArmError,
    ArmTracker,
    ArmUnit,
    BendAngleError,
    Cable,
    Load,
    LoadError,
    TensionError,
    arm_margins,
)

UNIT = ArmUnit(PRELIMINARY, 0.02)
PAIR = (Cable('l', 'l', 2), Cable('s', 's', 2))
ARM = Arm([UNIT, UNIT], PAIR)
EVEN = {'l': 1.0, 's': 1.0}


def test_an_arm_cannot_be_changed():
    with pytest.raises(AttributeError):
        ARM.units = ()
    assert isinstance(ARM.units, tuple)
    assert Arm([UNIT, UNIT], list(PAIR)) == ARM


@pytest.mark.parametrize(
    ('make', 'named'),
    [
        (lambda: ArmUnit(PRELIMINARY, -0.1), 'length is -0.1 m, allowed is 0 to 10 m'),
        (lambda: ArmUnit(PRELIMINARY, math.nan), 'length is nan'),
        (lambda: ArmUnit(PRELIMINARY, '1'), "length is '1', which is not a number"),
        (lambda: ArmUnit(PRELIMINARY, True), 'length is True'),
        (lambda: ArmUnit('unit.yaml', 0.1), "design is 'unit.yaml', a JointDesign is needed"),
        (lambda: Cable('', 'l', 1), "name is ''"),
        (lambda: Cable('l', 'L', 1), "side is 'L', allowed is l or s"),
        (lambda: Cable('l', 'l', 0), 'last_unit is 0, allowed is 1 to 50'),
        (lambda: Cable('l', 'l', 1.5), 'last_unit is 1.5, a whole number'),
        (lambda: Cable('l', 'l', 1, -0.001), 'offset is -0.001 m'),
        (lambda: Arm([], PAIR), 'there are 0 units, allowed are 1 to 50'),
        (lambda: Arm([UNIT] * 51, PAIR), 'there are 51 units'),
        (lambda: Arm([UNIT, PRELIMINARY], PAIR), 'units[2] is JointDesign('),
        (lambda: Arm([UNIT], PAIR), "cable 'l' ends at unit 2, but the last unit is 1"),
        (lambda: Arm([UNIT] * 3, PAIR), 'no cable l crosses joint 3'),
        (lambda: Arm([UNIT] * 2, PAIR[:1]), 'no cable s crosses joint 1'),
        (lambda: Arm([UNIT] * 2, [*PAIR, PAIR[0]]), "two cables are called 'l'"),
        (lambda: Arm([UNIT] * 2, PAIR, -0.1), 'cable_friction_coefficient is -0.1'),
    ],
)
def test_what_cannot_be_is_refused_with_the_reason(make, named):
    with pytest.raises(ArmError) as caught:
        make()
    assert named in str(caught.value)
    assert '\n' not in str(caught.value)


@pytest.mark.parametrize(
    ('tensions', 'named'),
    [
        ({'l': 1.0}, 'the tension of cable s is missing'),
        ({**EVEN, 't': 1.0}, "there is no cable 't'; there are l, s"),
        ({'l': 1.0, 's': -1.0}, 'the tension of cable s is -1.0 N, allowed is 0 to 1e+09 N'),
        ({'l': 1.0, 's': math.nan}, 'the tension of cable s is nan N'),
        ({'l': 1.0, 's': '2'}, "the tension of cable s is '2', which is not a number"),
        ({'l': 0.1, 's': 0.1}, 'cross joint 1 add up to 0.2 N, which must exceed'),
    ],
)
def test_bad_tensions_are_refused_and_the_arm_stays_as_it_was(tensions, named):
    tracker = ArmTracker(ARM, [0.1, -0.1])
    with pytest.raises(TensionError) as caught:
        tracker.update(tensions)
    assert named in str(caught.value)
    assert tracker.bend_angles == (0.1, -0.1)
    with pytest.raises(TensionError):
        arm_margins(ARM, [0.1, -0.1], tensions)


@pytest.mark.parametrize('angles', [[0.1], [0.1, 0.1, 0.1], [0.1, 0.6], [0.1, math.nan], 0.1])
def test_angles_that_the_arm_cannot_have_are_refused(angles):
    with pytest.raises(BendAngleError):
        ArmTracker(ARM, angles)
    tracker = ArmTracker(ARM, [0.1, 0.2])
    with pytest.raises(BendAngleError):
        tracker.reset(angles)
    assert tracker.bend_angles == (0.1, 0.2)


@pytest.mark.parametrize('joint', [0, 3, -1, 1.0, True])
def test_a_joint_that_the_arm_does_not_have_cannot_be_measured(joint):
    with pytest.raises(ArmError, match='the arm has joints 1 to 2'):
        ArmTracker(ARM).measure(joint, 0.1)


def test_the_tip_force_acts_at_the_end_and_nowhere_else():
    with pytest.raises(LoadError, match=r'at the end of its last unit, at 0\.02 m'):
        arm_margins(ARM, [0.0, 0.0], EVEN, Load(tip_force=(0.1, 0.0), tip_distance=0.01))
    said = Load(tip_force=(0.1, 0.0), tip_distance=0.02)
    unsaid = Load(tip_force=(0.1, 0.0))
    assert arm_margins(ARM, [0.1, 0.0], EVEN, said) == arm_margins(ARM, [0.1, 0.0], EVEN, unsaid)
