"""The estimator of an arm over real ROS: held against the tracker, and against bad input."""

import csv
import json
import math
import random
import sys
import time
from contextlib import contextmanager

import pytest
from arm_client import ArmClient, array, same, values
from diagnostic_msgs.msg import DiagnosticStatus
from forked_programs import ForkedProgram
from own_estimator import own_estimator
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from ros_programs import Program, spinning, wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, Header
from tendon_statics_interfaces.msg import AdmissibleAngles
from tendon_statics_interfaces.srv import SolveArm

from tendon_statics import ArmTracker, Load, StickSlipTracker, load_arm
from tendon_statics.files.installed_files import installed_config
from tendon_statics.node.outputs.publishers import SLOW_PERIOD

ARM = load_arm(installed_config('arm.yaml'))
NAMES = tuple(f'arm_joint_{number}' for number in range(1, 6))
OK, WARN, ERROR, STALE = (
    *(DiagnosticStatus.OK, DiagnosticStatus.WARN),
    *(DiagnosticStatus.ERROR, DiagnosticStatus.STALE),
)
EVEN = dict.fromkeys(ARM.cable_names, 1.0)
HELD = EVEN | {'s_tip': 1.01}
PULLED = EVEN | {'s_tip': 2.4}
LONG = ('-p', 'input_timeout:=60.0')
"""So that the input of a test that waits is not stale"""


def session():
    """The tensions of the drive cycle that is installed beside the arm."""
    text = installed_config('arm_tensions.csv').read_text(encoding='utf-8')
    titles, *rows = csv.reader(line for line in text.splitlines() if line[0] != '#')
    names = [title.removesuffix(' [N]') for title in titles[1:]]
    return [dict(zip(names, map(float, row[1:]), strict=True)) for row in rows]


def new_client(context):
    return ArmClient(context, ARM.cable_names)


@pytest.fixture(scope='module')
def shared_arm():
    """A client and, in a domain that is theirs, an estimator of the installed arm."""
    with own_estimator(new_client, *LONG) as client:
        yield client


@pytest.fixture
def arm(shared_arm):
    """The same, put back to where it began."""
    shared_arm.send_even()
    assert shared_arm.trigger('reset').success
    shared_arm.settle()
    shared_arm.forget()
    return shared_arm


@pytest.fixture
def client():
    """A client of its own, for an estimator that a test starts."""
    with spinning(new_client) as node:
        yield node


def followed(rows, start=None):
    tracker = ArmTracker(ARM, start)
    return [tracker.update(row) for row in rows]


def test_a_session_gives_what_the_tracker_says_to_the_last_bit(arm):
    rows = session()
    for row in rows:
        arm.send(row)
    wait_for('all estimates', lambda: len(arm.estimates) == len(rows))
    arm.settle()
    expected = followed(rows)
    assert len({estimate.regimes[2] for estimate in arm.estimates}) > 1
    for ours, theirs in zip(arm.estimates, expected, strict=False):
        assert list(ours.joint_names) == list(NAMES)
        assert list(ours.regimes) == [regime.value for regime in theirs.regimes]
        if theirs.is_slack:
            assert all(map(math.isnan, ours.bend_angles))
            continue
        assert same(ours.bend_angles, theirs.bend_angles)
        assert same(ours.slip_margins, theirs.slip_margins)
        assert (ours.tip_x, ours.tip_z, ours.tip_tilt) == tuple(theirs.tip)
        assert list(ours.angles_assured) == list(theirs.angles_assured)
        pressures = [math.nan if of is None else of for of in theirs.pressures]
        assert same(ours.pressures, pressures)
        assert all(map(math.isnan, ours.bend_angle_lows))
        assert same(ours.tensions, theirs.tensions.values())
    with_angles = [state for state in expected if not state.is_slack]
    for ours, theirs in zip(arm.joint_states, with_angles, strict=False):
        assert list(ours.name) == list(NAMES)
        assert same(ours.position, theirs.bend_angles)
    for ours, theirs in zip(arm.regimes, expected, strict=False):
        assert list(ours.regimes) == [regime.value for regime in theirs.regimes]


@contextmanager
def admissible_angles(arm):
    """What comes on where friction can hold the joints, while somebody listens."""
    came = []
    topic = 'arm_estimator/admissible_angles'
    subscription = arm.create_subscription(AdmissibleAngles, topic, came.append, 1000)
    try:
        wait_for('the publisher', lambda: subscription.get_publisher_count() > 0)

        def heard():
            arm.send_even()
            return came

        wait_for('the first', heard)
        yield came
    finally:
        # By the thread that spins, which must not wait for what is destroyed meanwhile.
        ended = arm.executor.create_task(arm.destroy_subscription, subscription)
        wait_for('the end of the subscription', ended.done)


def bands_told(message):
    bands = [[] for _ in message.joint_names]
    for joint, low, high in zip(message.joints, message.lows, message.highs, strict=True):
        bands[joint - 1].append((low, high))
    return bands


def test_where_friction_can_hold_each_joint_is_told_as_the_tracker_has_it(arm):
    with admissible_angles(arm) as came:
        for row in (PULLED, EVEN | {'l_tip': 0.0}):
            estimate, state = arm.answer(row), followed([EVEN, PULLED, row])[-1]
            expected = [[] if state.is_slack else of.admissible_angles for of in state.joints]
            assert any(expected) is not state.is_slack

            def told(row=row, expected=expected):
                arm.send(row)  # again, since not every answer is told
                return bands_told(came[-1]) == expected

            wait_for('the bands', told)
            assert list(came[-1].joint_names) == list(NAMES)
            assert came[-1].header.frame_id == estimate.header.frame_id


def test_where_friction_can_hold_is_told_no_more_often_than_it_is_to_be_looked_at(arm):
    with admissible_angles(arm) as came:
        before, start = len(came), time.monotonic()
        for _ in range(200):
            arm.answer(HELD)
        assert len(came) - before <= 1 + (time.monotonic() - start) / SLOW_PERIOD
        assert len(came) - before < 200


def test_beside_interfaces_without_the_newest_message_it_runs_and_says_how_to_build_them(client):
    code = (
        'import sys, tendon_statics_interfaces.msg as msg\n'
        'del msg.AdmissibleAngles\n'
        'from tendon_statics.node.program import arm_estimator\n'
        'sys.exit(arm_estimator())\n'
    )
    with Program.running_command([sys.executable, '-c', code]) as program:
        client.connect(program)
        client.settle()
        topics = dict(client.get_topic_names_and_types())
        assert '/arm_estimator/arm_estimate' in topics
        assert '/arm_estimator/admissible_angles' not in topics
        said = program.output()
        assert said.count('colcon build --base-paths . interfaces') == 1
        assert 'No ~/admissible_angles, since' in said
        assert program.end() == 0


def test_the_pose_of_the_tip_has_the_covariance_of_the_tracker(arm):
    arm.send(PULLED)
    wait_for('the pose', lambda: len(arm.tip_poses) == 1)
    pose, state = arm.tip_poses[0], followed([EVEN, PULLED])[-1]
    tip, spread = state.tip, state.tip_stddev(0.01)
    assert pose.header.frame_id == 'base'
    assert (pose.pose.pose.position.x, pose.pose.pose.position.z) == (tip.x, tip.z)
    assert 2.0 * math.asin(pose.pose.pose.orientation.y) == pytest.approx(tip.tilt)
    covariance = pose.pose.covariance
    assert math.sqrt(covariance[0]) == pytest.approx(spread.x)
    assert math.sqrt(covariance[14]) == pytest.approx(spread.z)
    assert math.sqrt(covariance[28]) == pytest.approx(spread.tilt)
    assert covariance[2] == covariance[12] != 0.0
    assert not any(covariance[6 * row + column] for row in (1, 3, 5) for column in range(6))


def test_a_whole_array_is_taken_in_the_order_of_the_file():
    def make(context):
        return ArmClient(context, ARM.cable_names, message_type=Float64MultiArray)

    with (
        spinning(make) as client,
        ForkedProgram.running(
            'arm_estimator', *('--ros-args', '-p', 'tension_source:=array', *LONG)
        ) as program,
    ):
        client.connect(program)
        order = [PULLED[name] for name in ARM.cable_names]
        state = followed([PULLED])[-1]

        def come():
            client.tensions.publish(array(*order))
            client.tensions.publish(array(*order[:-1]))
            time.sleep(0.05)
            return client.estimates and any(of.regimes[0] == 'invalid' for of in client.regimes)

        wait_for('an answer', come)
        assert same(client.estimates[-1].bend_angles, state.bend_angles)
        client.status(WARN, 'wrong length', '3 values came', ', '.join(ARM.cable_names), since=0)


BAD = [
    ({**EVEN, 'l_mid': math.nan}, 'not finite', 'the tension of l_mid is nan N'),
    ({**EVEN, 's_tip': -5.0}, 'negative', 'the tension of s_tip is -5.0 N'),
    ({**EVEN, 's_tip': 5000.0}, 'implausible', 'the tension of s_tip is 5000.0 N'),
]


@pytest.mark.parametrize(('tensions', 'reason', 'text'), BAD)
def test_bad_tensions_are_said_and_leave_the_arm_where_it_is(arm, tensions, reason, text):
    before = arm.answer(HELD)
    assert all(before.angles_assured)
    arm.forget()
    count = len(arm.statuses)
    arm.send(tensions)
    wait_for('the word', lambda: bool(arm.regimes))
    assert list(arm.regimes[0].regimes) == ['invalid'] * 5
    wait_for(
        'the report',
        lambda: any(reason in of.message and text in of.message for of in arm.statuses[count:]),
    )
    after = arm.answer(HELD)
    assert same(before.bend_angles, after.bend_angles)
    assert not any(after.angles_assured)
    assert not arm.tip_poses


def test_of_joint_states_of_a_part_of_the_cables_a_whole_is_made(arm):
    """With those of others in between, that are passed over, and in any order of cables."""
    now = arm.get_clock().now().to_msg
    state = followed([EVEN, PULLED])[-1]
    stamp = now()
    arm.send({'s_tip': 2.4, 'wheel': 3.0, 'l_tip': 1.0}, stamp)
    arm.send({'wheel': math.nan}, stamp)
    arm.send({'s_mid': 1.0}, stamp)
    arm.send({'l_mid': 1.0}, stamp)
    wait_for('the estimate', lambda: bool(arm.estimates))
    assert same(arm.estimates[0].bend_angles, state.bend_angles)
    assert arm.estimates[0].header.stamp == stamp


def test_what_is_against_a_message_as_a_whole_is_said(arm):
    header = Header(stamp=arm.get_clock().now().to_msg())
    names = list(ARM.cable_names)
    for message, text in (
        (JointState(header=header, name=names, effort=[1.0]), '4 names came with 1 efforts'),
        (JointState(header=header, name=[*names, 'l_mid'], effort=[1.0] * 5), 'stands twice'),
        (JointState(header=header, name=names, effort=[1.0] * 4), ''),
        (JointState(header=header, name=names, effort=[1.0] * 4), 'repeated stamp'),
    ):
        count = len(arm.statuses)
        arm.tensions.publish(message)
        wait_for(text, lambda of=text, n=count: any(of in s.message for s in arm.statuses[n:]))


def test_measured_angles_put_the_joints_that_they_name(arm):
    arm.answer(HELD)
    arm.measured.publish(JointState(name=['wheel'], position=[7.0]))
    arm.measure(arm_joint_2=0.02, arm_joint_5=-0.01, arm_joint_3=9.0)

    def put():
        return arm.answer(EVEN).bend_angles[1] == 0.02

    wait_for('the angle', put)
    angles = arm.answer(EVEN).bend_angles
    assert angles[4] == -0.01
    assert angles[2] != 9.0
    latest = json.loads(arm.trigger('solve_latest').message)
    assert latest['rejected_corrections'] == 1
    assert latest['bend_angles'][1] == 0.02


def test_the_service_solves_from_stated_angles_and_from_where_the_arm_is(arm):
    stated = [0.1, 0.0, -0.1, 0.05, 0.0]
    arm.answer(PULLED)
    back = list(reversed(ARM.cable_names))
    request = SolveArm.Request(
        cable_names=back, tensions=[PULLED[name] for name in back], bend_angles=stated
    )
    answer = arm.call('solve_arm', request)
    assert answer.success, answer.message
    state = ArmTracker(ARM, stated).update(PULLED)
    assert same(answer.bend_angles, state.bend_angles)
    assert (answer.tip_x, answer.tip_z, answer.tip_tilt) == tuple(state.tip)
    assert answer.load_assured
    order = [EVEN[name] for name in ARM.cable_names]
    answer = arm.call('solve_arm', SolveArm.Request(tensions=order))
    assert same(answer.bend_angles, followed([EVEN, PULLED, EVEN])[-1].bend_angles)
    tilted = SolveArm.Request(tensions=order, gravity_direction=[1.0, 0.0, 0.0])
    assert arm.call('solve_arm', tilted).slip_margins != answer.slip_margins


@pytest.mark.parametrize(
    ('request_of', 'text'),
    [
        ({'tensions': [1.0] * 3}, '3 tensions came for 4 cables'),
        ({'tensions': [1.0, 1.0, 1.0, -1.0]}, 'the tension of cable s_tip is -1.0 N'),
        ({'tensions': [1.0], 'cable_names': ['rope']}, 'l_mid is missing'),
        ({'tensions': [1.0] * 4, 'bend_angles': [0.0]}, 'the arm has 5 joints'),
        ({'tensions': [1.0] * 4, 'bend_angles': [0.0] * 4 + [2.0]}, 'joint 5: bend_angle is 2.0'),
        ({'tensions': [1.0] * 4, 'tip_force_x': 1.0}, 'give the direction too'),
        (
            {'tensions': [1.0] * 4, 'cable_names': ['l_mid', 'l_mid', 'l_tip', 's_tip']},
            'each cable stands in it once',
        ),
    ],
)
def test_the_service_refuses_what_is_not_valid_with_the_reason(arm, request_of, text):
    answer = arm.call('solve_arm', SolveArm.Request(**request_of))
    assert not answer.success
    assert text in answer.message
    assert math.isnan(answer.tip_x)


def test_one_status_says_how_the_arm_is_and_names_the_worst_joint(arm):
    arm.answer(HELD)
    status = arm.status(OK, 'worst is arm_joint_')
    assert status.name == 'arm_estimator: estimation'
    assert status.hardware_id == 'arm'
    found = values(status)
    assert found['worst joint'] in NAMES
    assert found['worst joint'] in status.message
    assert int(found['readings solved']) >= 2
    assert {f'regime of {name}' for name in NAMES} <= found.keys()


def test_a_slack_cable_casts_doubt_on_all_joints_until_they_are_measured(arm):
    since = len(arm.statuses)
    slack = arm.answer(EVEN | {'s_mid': 0.0, 's_tip': 0.0})
    assert list(slack.regimes) == ['slack'] * 5
    assert all(map(math.isnan, slack.bend_angles))
    assert math.isnan(slack.tip_x)
    unsure = arm.answer(EVEN)
    assert not any(unsure.angles_assured)
    assert all(map(math.isnan, unsure.bend_angle_stddevs))
    status = arm.status(WARN, 'may have moved unseen', since=since)
    assert ', '.join(NAMES) in status.message
    assert 'worst is arm_joint_' in status.message
    arm.measure(**dict.fromkeys(NAMES, 0.0))
    wait_for('assured angles', lambda: all(arm.answer(EVEN).angles_assured))


def test_cables_are_tared_by_their_own_parameters(client):
    noise = random.Random(1)
    offsets = {'l_mid': 0.2, 's_mid': -0.1, 'l_tip': 0.05, 's_tip': 0.0}
    slow = ('-p', 'tare_time:=60.0')
    with client.estimator('-p', 'cables.l_mid.gain:=2', *slow, *LONG, greet=False):
        refused = client.trigger('tare').message
        assert 'l_mid has 0 readings' in refused
        assert 'all cables have to hang slack and still' in refused

        def tared():
            for _ in range(10):
                client.send({name: of + noise.gauss(0.0, 0.002) for name, of in offsets.items()})
            return client.trigger('tare').success

        wait_for('the readings', tared)
        assert client.parameter('cables.l_mid.bias') == pytest.approx(-0.4, abs=0.05)
        assert client.parameter('cables.s_mid.bias') == pytest.approx(0.1, abs=0.05)
        result = client.set_parameters(cables__rope__bias=1.0)
        assert not result.successful
        assert client.set_parameters(cables__l_mid__max_tension=3).successful
        refused = client.set_parameters(cables__l_mid__max_tension=-3.0)
        assert 'cables.l_mid.max_tension is -3.0, allowed is' in refused.reason
        # One by one too: nothing that may come could make it fit.
        start = Parameter('initial_bend_angles', value=[0.1]).to_parameter_msg()
        (refused,) = client.call(
            'set_parameters', SetParameters.Request(parameters=[start])
        ).results
        assert not refused.successful
        assert 'initial_bend_angles: bend_angles is (0.1,)' in refused.reason


def test_the_input_gets_stale_and_the_angles_are_in_doubt(client):
    with client.estimator('-p', 'input_timeout:=1.0') as program:
        client.answer(PULLED)
        wait_for(
            'stale', lambda: bool(client.regimes) and client.regimes[-1].regimes[0] == 'stale'
        )
        assert list(client.regimes[-1].regimes) == ['stale'] * 5
        assert client.status(STALE, 'no valid tensions for')
        assert not any(client.answer(EVEN).angles_assured)
        wait_for('the word', lambda: 'Valid tensions come again' in program.output())


def test_the_lifecycle_is_that_of_every_managed_node(client):
    with client.estimator('-p', 'autostart:=false', *LONG, greet=False) as program:
        client.send_even()
        refused = client.call('solve_arm', SolveArm.Request(tensions=[1.0] * 4))
        assert 'arm_estimator is unconfigured; it answers when it is active' in refused.message
        assert not client.estimates
        assert not client.change_state('activate')
        assert client.change_state('configure')
        assert client.change_state('activate')
        client.settle()
        client.forget()
        assert all(client.answer(HELD).angles_assured)
        assert client.change_state('deactivate')
        wait_for('stale', lambda: client.regimes[-1].regimes[0] == 'stale')
        assert client.change_state('activate')
        assert not any(client.answer(HELD).angles_assured)
        assert program.end() == 0


@pytest.mark.parametrize(
    ('arguments', 'text'),
    [
        (['-p', 'arm_file:=/nowhere/arm.yaml'], 'arm_file: /nowhere/arm.yaml: '),
        (['-p', 'cables.rope.bias:=0.1'], 'cables.rope.bias is 0.1, but there is no such'),
        (['-p', 'joint_names:=[a, b]'], "joint_names is ['a', 'b'], but the arm has 5 joints"),
        (['-p', 'initial_bend_angles:=[0.1]'], 'initial_bend_angles: bend_angles is (0.1,)'),
        (['-p', 'tension_source:=wrench_pair'], "tension_source is 'wrench_pair', allowed is"),
        (['-p', 'estimation:=equilibrium'], "estimation is 'equilibrium', allowed is"),
        (['-p', 'max_skew:=.nan'], 'max_skew is nan, allowed is 0 to 10 s'),
    ],
)
def test_what_it_cannot_start_with_is_one_line(arguments, text):
    with Program.running('arm_estimator', '--ros-args', *arguments) as program:
        assert program.wait() == 1
        (line,) = [line for line in program.output().splitlines() if 'cannot start' in line]
    assert line.startswith('arm_estimator cannot start: ')
    assert text in line


def test_an_arm_of_one_unit_says_what_the_estimator_of_the_unit_says(tmp_path):
    """While tracking, through slips, a slack cable and doubt."""
    from designs import PRELIMINARY
    from listener import Listener, reliable_input

    path = tmp_path / 'one.yaml'
    design = installed_config('preliminary_design.yaml')
    path.write_text(
        f'units:\n  - {{design_file: {design}, length: 0.03}}\n'
        'cables:\n  - {name: cable_l, side: l, last_unit: 1}\n'
        '  - {name: cable_s, side: s, last_unit: 1}\n'
    )
    generator = random.Random(3)
    rows = [(1.0 + generator.random(), 1.0 + 1.5 * generator.random()) for _ in range(40)]
    rows[20:20] = [(1.0, 0.0), (1.0, 3.0)]
    with (
        spinning(lambda context: ArmClient(context, ('cable_l', 'cable_s'))) as client,
        spinning(lambda context: Listener(context, 'joint_state')) as listener,
        listener.estimator(*('-p', 'estimation:=tracking', *reliable_input('joint_state'), *LONG)),
        client.estimator('-p', f'arm_file:={path}', *LONG),
    ):
        wait_for('the estimator', lambda: len(listener.estimates) > 0)
        client.trigger('reset')
        listener.reset()
        client.settle()
        last = client.estimates[-1].header.stamp
        wait_for('its answers', lambda: listener.estimates[-1].header.stamp == last)
        client.forget()
        listener.forget()
        tracker = StickSlipTracker(PRELIMINARY)
        for row in rows:
            client.send(dict(zip(('cable_l', 'cable_s'), row, strict=True)))
        wait_for('one', lambda: len(client.estimates) == len(rows))
        wait_for('the other', lambda: len(listener.estimates) == len(rows))
        tracker.update(1.0, 1.0)
        for row, of_arm, of_unit in zip(rows, client.estimates, listener.estimates, strict=True):
            assert of_arm.header.stamp == of_unit.header.stamp
            state = tracker.update(*row)
            assert list(of_arm.regimes) == [of_unit.regime] == [state.regime.value]
            pairs = (
                (of_arm.bend_angles, of_unit.bend_angle),
                (of_arm.slip_margins, of_unit.slip_margin),
                (of_arm.pressures, of_unit.pressure),
            )
            for ours, theirs in pairs:
                assert same(ours, [theirs])
            (stddev,) = of_arm.bend_angle_stddevs
            if math.isnan(of_unit.bend_angle_stddev):
                assert math.isnan(stddev)
            else:
                assert stddev == pytest.approx(of_unit.bend_angle_stddev, rel=1e-12)
            assert list(of_arm.angles_assured) == [of_unit.angle_assured]


def test_gravity_and_the_force_on_the_tip_come_from_sensors(client):
    """In the base's frame; until they come the arm stays where it began."""
    from geometry_msgs.msg import Vector3, Wrench, WrenchStamped
    from sensor_msgs.msg import Imu

    imu = client.create_publisher(Imu, 'imu', 10)
    wrench = client.create_publisher(WrenchStamped, 'tip_wrench', 10)
    sensors = ('-p', 'gravity_source:=imu', '-p', 'tip_wrench:=true', '-p', 'load_timeout:=60.0')
    with client.estimator(*sensors, *LONG, greet=False):

        def without():
            client.send(PULLED)
            time.sleep(0.05)
            return bool(client.estimates)

        wait_for('an estimate', without)
        assert not client.estimates[-1].load_assured
        assert not any(client.estimates[-1].angles_assured)
        header = Header(frame_id='base')
        gravity = Imu(linear_acceleration=Vector3(x=-9.81))
        gravity.orientation_covariance[0] = -1.0
        push = WrenchStamped(header=header, wrench=Wrench(force=Vector3(z=-0.01)))

        def with_sensors():
            imu.publish(gravity)
            wrench.publish(push)
            client.send_even()
            time.sleep(0.05)
            return client.estimates[-1].load_assured

        wait_for('the load', with_sensors)
        newest = client.estimates[-1]
        assert newest.gravity_direction_x == pytest.approx(1.0)
        assert newest.tip_force_z == -0.01
        load = Load((1.0, 0.0, 0.0), (0.0, -0.01))
        assert same(newest.bend_angles, ArmTracker(ARM).update(EVEN, load).bend_angles)
