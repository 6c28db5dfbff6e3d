"""``~/tip_force``, ``~/tip_wrench`` and ``~/solve_tip_force`` of an arm, over real ROS."""

import math
import time

import pytest
from arm_client import ArmClient
from geometry_msgs.msg import WrenchStamped
from list_entities import alone, entities
from ros_programs import ask, spinning, wait_for
from stamps import stamp
from tendon_statics_interfaces.msg import TipForce
from tendon_statics_interfaces.srv import SolveArmTipForce

from tendon_statics import ArmTracker, Load, arm_tip_force, load_arm
from tendon_statics.files.installed_files import installed_config
from tendon_statics.node.arm_estimator import ArmEstimator
from tendon_statics.physics.deviations import TENSION_STDDEV

ARM = load_arm(installed_config('arm.yaml'))
NAMES = tuple(f'arm_joint_{number}' for number in range(1, 6))
HELD = dict.fromkeys(ARM.cable_names, 1.0) | {'s_tip': 1.01}
PULLS = 1.38, 1.66
"""N, of cable s_tip"""
FORCE = 0.02
"""N, that pushes the arm while it is pulled"""
OWN = {'~/tip_force', '~/tip_wrench', '~/solve_tip_force'}
STDDEV = 0.0005
"""rad, of measured angles"""
ARGUMENTS = ('tip_force:=true', 'input_timeout:=60.0', f'measured_bend_angle_stddev:={STDDEV}')
ASKED = {
    'direction': (1.0, 0.0),
    'tension_stddev': TENSION_STDDEV,
    'bend_angle_stddev': STDDEV,
}


def names(alias, *arguments):
    # A name of its own, since one of the same name that has ended may still be in the graph.
    with alone(ArmEstimator, '-r', f'__node:={alias}', *arguments) as node:
        return {name for of_kind in entities(node).values() for name in of_kind}


def test_none_of_it_is_there_unless_asked_for():
    assert not OWN & names('arm_without_tip_force')
    assert names('arm_with_tip_force', '-p', 'tip_force:=true') >= OWN


@pytest.fixture
def pushed():
    """A client with an estimator that looks for a tip force, and what comes of it."""
    with spinning(lambda context: ArmClient(context, ARM.cable_names)) as client:
        forces, wrenches = [], []
        client.create_subscription(TipForce, 'arm_estimator/tip_force', forces.append, 100)
        client.create_subscription(WrenchStamped, 'arm_estimator/tip_wrench', wrenches.append, 100)
        with client.estimator(*(part for value in ARGUMENTS for part in ('-p', value))):
            yield client, forces, wrenches


def told(client, angles, said, tensions=HELD) -> bool:
    """Say measured angles and tensions once more; return whether it has come of them."""
    client.measure(**angles)
    client.answer(tensions)
    return bool(said())


def pulled(pull):
    """Tensions of which two joints slip steadily, and the angles of an arm that is pushed."""
    tracker = ArmTracker(ARM)
    for tension in (PULLS[0], pull):
        tensions = HELD | {'s_tip': tension}
        state = tracker.update(tensions, Load(tip_force=(FORCE, 0.0)))
    return tensions, dict(zip(NAMES, state.bend_angles, strict=True))


def test_a_set_at_rest_and_a_force_while_a_measured_joint_moves(pushed):
    client, forces, wrenches = pushed
    straight = dict.fromkeys(NAMES, 0.0)
    some = {'arm_joint_5': 0.0}
    wait_for('a set', lambda: told(client, some, lambda: forces))
    assert not forces[-1].bend_angle_measured
    wait_for(
        'a set of measured angles',
        lambda: told(client, straight, lambda: forces[-1].bend_angle_measured),
    )
    message = forces[-1]
    expected = arm_tip_force(ARM, HELD, bend_angles=[0.0] * 5, **ASKED)
    assert list(message.intervals) == pytest.approx(
        [end for interval in expected.intervals for end in interval], abs=1e-6
    )
    assert message.intervals
    assert message.probability_free == pytest.approx(expected.probability_free)
    assert (message.level, message.at_limit) == (0.95, False)
    assert math.isnan(message.force)
    assert message.header.frame_id == 'base'
    assert (message.direction_x, message.direction_z) == (1.0, 0.0)
    assert message.tip_distance == ARM.units[-1].length
    assert message.load_assured
    assert wrenches == []

    # As slowly as a busy machine needs it, and from the beginning again at the end.
    start = time.monotonic()

    def slips():
        share = 0.1 * (time.monotonic() - start) % 1.0
        tensions, angles = pulled(PULLS[0] + share * (PULLS[1] - PULLS[0]))
        return told(client, angles, lambda: wrenches, tensions)

    wait_for('a force', slips)
    of_wrench = wrenches[0].header
    wait_for('the same as a set', lambda: any(one.header == of_wrench for one in forces))
    first = next(one for one in forces if one.header == of_wrench)
    assert first.at_limit
    assert first.bend_angle_measured
    assert 0.0 < first.force_stddev < 0.01
    assert first.force == pytest.approx(FORCE, abs=4.0 * first.force_stddev)
    assert wrenches[0].wrench.force.x == first.force
    assert wrenches[0].wrench.force.z == 0.0

    # A slack arm and an angle beyond the stop tell nothing: the next set is of what came later.
    client.measure(arm_joint_5=3.0)
    slack = stamp(client.answer(HELD | {'s_mid': 0.0, 's_tip': 0.0}))
    wait_for('a set', lambda: told(client, straight, lambda: stamp(forces[-1]) > slack))
    assert slack not in {stamp(one) for one in forces}
    assert slack not in {stamp(one) for one in wrenches}


def test_the_service_answers_for_any_line_and_refuses_with_the_reason(pushed):
    client, _, _ = pushed
    service = client.create_client(SolveArmTipForce, 'arm_estimator/solve_tip_force')
    angles = [0.05, 0.0, -0.05, 0.02, 0.0]

    def answer(**fields):
        request = SolveArmTipForce.Request(tensions=[1.0, 1.0, 1.0, 1.2], bend_angles=angles)
        for name, value in fields.items():
            setattr(request, name, value)
        return ask(service, request)

    def expected(**more):
        tensions = dict(zip(ARM.cable_names, [1.0, 1.0, 1.0, 1.2], strict=True))
        return arm_tip_force(ARM, tensions, **{'bend_angles': angles, **ASKED, **more})

    def ends(found):
        return pytest.approx([end for interval in found.intervals for end in interval], abs=1e-6)

    found = answer()
    assert found.success, found.message
    assert found.intervals
    assert list(found.intervals) == ends(expected())
    assert list(found.bounding_joints) == [
        joint for joints in expected().bounding_joints for joint in joints
    ]
    assert math.isnan(found.force)
    # The joint that bounds the set above would slip to s there.
    bounding = found.bounding_joints[1]
    slips = answer(slipping=['s' if joint == bounding else '' for joint in range(1, 6)])
    assert slips.at_limit
    assert slips.force == pytest.approx(expected(slipping={bounding: 's'}).force, abs=1e-9)
    assert slips.force_stddev > 0.0
    other = answer(direction=[0.6, 0.0, 0.8], cable_names=list(ARM.cable_names))
    assert list(other.intervals) == ends(expected(direction=(0.6, 0.8)))
    leaning = answer(at_stop=[True, False, False, False, False])
    assert list(leaning.intervals) == ends(expected(at_stop=[1]))
    for fields, reason in (
        ({'direction': [0.0, 1.0, 0.0]}, 'out of the plane'),
        ({'direction': [1.0, 0.0, 1.0]}, 'unit vector'),
        ({'bend_angles': [0.0] * 4}, 'has 5 joints'),
        ({'bend_angles': [0.0] * 4 + [0.9]}, 'joint 5: bend_angle is 0.9'),
        ({'tensions': [0.0, 1.0, 0.0, 1.0]}, 'is slack'),
        ({'tensions': [1.0] * 3}, '3 tensions came for 4 cables'),
        ({'slipping': ['x', '', '', '', '']}, "slipping of joint 1 is 'x'"),
        ({'slipping': ['s']}, 'slipping is of 1 joints'),
        ({'at_stop': [True]}, 'at_stop is of 1 joints'),
    ):
        refused = answer(**fields)
        assert not refused.success
        assert reason in refused.message
        assert '\n' not in refused.message
        assert list(refused.intervals) == []
    for value, reason in (([0.0] * 3, 'length zero'), ([0.0, 1.0, 0.0], 'out of the plane')):
        result = client.set_parameters(tip_direction=value)
        assert not result.successful
        assert reason in result.reason
        assert result.reason.startswith('tip_direction')
