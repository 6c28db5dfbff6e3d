"""The kinds of messages that drivers send, over real ROS: what comes of them, with which stamp."""

import itertools
import math
import sys

import pytest
from builtin_interfaces.msg import Time
from designs import PRELIMINARY
from diagnostic_msgs.msg import DiagnosticStatus
from forked_programs import ForkedProgram
from listener import Listener, reliable_input
from rclpy.node import Node
from ros_programs import Program, spinning, wait_for
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from test_health import values

from tendon_statics import solve

HELD, SLIPPING, STOP = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0)
STAMPED = ('joint_state', 'wrench_pair')


@pytest.fixture
def driver(request):
    """A listener that sends tensions as messages of the kind asked for."""
    with spinning(lambda context: Listener(context, request.param)) as node:
        yield node


def latest_values(driver) -> dict[str, str]:
    """What the next report on /diagnostics counts."""
    return values(driver.report())


@pytest.mark.parametrize('driver', STAMPED, indirect=True)
def test_the_stamp_of_the_measurement_travels_unchanged(driver):
    """Also one that is far from the present."""
    with driver.estimator(*reliable_input(driver.tension_source)):
        stamps = [Time(sec=2**31 - 1, nanosec=nanosec) for nanosec in range(1, 1000, 100)]
        for stamp in stamps:
            driver.publish(*SLIPPING, stamp=stamp)
        wait_for('the estimates', lambda: len(driver.estimates) == len(stamps))
        wait_for('the rest', lambda: len(driver.unit_poses) == len(driver.estimates))
        wait_for('the joint', lambda: len(driver.joint_states) == len(driver.estimates))
        expected = solve(PRELIMINARY, *SLIPPING)
        for stored in (driver.estimates, driver.unit_poses, driver.joint_states):
            assert [message.header.stamp for message in stored] == stamps
        assert {estimate.bend_angle for estimate in driver.estimates} == {expected.bend_angle}
        joint = driver.joint_states[0]
        assert (list(joint.name), list(joint.position)) == (['bend'], [expected.bend_angle])
        assert not joint.effort
        assert not joint.velocity


@pytest.mark.parametrize('driver', STAMPED, indirect=True)
def test_what_comes_late_or_twice_is_dropped_and_counted(driver):
    reliable = reliable_input(driver.tension_source)
    with driver.estimator('-p', 'input_timeout:=60.0', *reliable):
        driver.answer(*SLIPPING)
        before = latest_values(driver)
        last = driver.newest_estimate().header.stamp
        for _ in range(10):
            driver.publish(*STOP, stamp=last)
            driver.publish(*STOP, stamp=Time(sec=last.sec - 1, nanosec=last.nanosec))
        driver.answer(*SLIPPING)
        assert set(driver.regimes) == {'equilibrium'}

        each = len(driver.tension_publishers)  # messages of a reading

        def grown(key: str) -> int:
            return int(latest_values(driver)[key]) - int(before[key])

        wait_for('the counts', lambda: grown('dropped: out of order') == 10 * each)
        assert grown('dropped: repeated stamp') == 10 * each
        assert grown('pairs solved') == 1
        assert grown('messages received') == 21 * each


@pytest.mark.parametrize('driver', ['joint_state'], indirect=True)
def test_joint_states_of_one_cable_each_are_joined(driver):
    """As some drivers publish one actuator a message."""
    with driver.estimator('-p', 'max_skew:=0.01', *reliable_input('joint_state')):
        driver.answer(*SLIPPING)
        driver.newest_estimate()
        sent = driver.get_clock().now().nanoseconds // 10**9 + 1
        before = len(driver.estimates)
        for number in range(20):
            early, late = (
                Time(sec=sent, nanosec=number * 20_000_000 + of) for of in (1, 5_000_001)
            )
            for name, effort, stamp in (('cable_s', 3.0, early), ('cable_l', 1.0, late)):
                driver.tension_publishers[0].publish(
                    JointState(header=Header(stamp=stamp), name=[name], effort=[effort])
                )
        wait_for('the estimates', lambda: len(driver.estimates) == before + 20)
        assert {(of.tension_l, of.tension_s) for of in driver.estimates[before:]} == {STOP}
        assert latest_values(driver)['dropped: unpaired'] == '0'


@pytest.mark.parametrize('driver', ['joint_state'], indirect=True)
def test_what_others_publish_on_the_topic_is_passed_over(driver):
    """With the very stamps of ours, and before and after them; the case of two_sources."""
    reliable = reliable_input('joint_state')
    foreign = 'messages about neither cable'
    with driver.estimator('-p', 'input_timeout:=60.0', *reliable):
        driver.answer(*SLIPPING)
        with spinning(lambda context: Node('other', context=context)) as other:
            wheel = other.create_publisher(JointState, 'tensions', 1000)

            def is_heard() -> bool:
                wheel.publish(JointState(name=['wheel'], effort=[0.1]))
                return latest_values(driver).get(foreign, '0') != '0'

            wait_for('the other to be heard', is_heard)

            def is_quiet() -> bool:
                """Whether all of that was counted: two reports in a row say the same."""
                return latest_values(driver).get(foreign) == latest_values(driver).get(foreign)

            wait_for('the last of that', is_quiet)
            before = latest_values(driver)
            count = len(driver.regimes)
            for _ in range(40):
                stamp = driver.get_clock().now().to_msg()
                wheel.publish(JointState(header=Header(stamp=stamp), name=['wheel'], effort=[0.1]))
                wheel.publish(JointState(name=['wheel', 'arm'], effort=[0.1]))
                driver.publish(*SLIPPING, stamp=stamp)
                wheel.publish(JointState(header=Header(stamp=stamp), name=['wheel'], effort=[0.1]))
            wait_for('all answers', lambda: len(driver.regimes) == count + 40)
            wait_for(
                'the count',
                lambda: int(latest_values(driver)[foreign]) == int(before[foreign]) + 120,
            )
            after = latest_values(driver)
            level, message = driver.diagnostics[-1].level, driver.diagnostics[-1].message
        assert set(driver.regimes) == {'equilibrium'}
        assert int(after['messages received']) == int(before['messages received']) + 40
        assert not [key for key in after if key.startswith('dropped: ') and after[key] != '0']
        assert (level, message) == (DiagnosticStatus.OK, 'equilibrium')


@pytest.mark.parametrize('driver', ['joint_state'], indirect=True)
def test_efforts_of_some_names_are_of_the_wrong_length(driver):
    with driver.estimator():
        header = Header(stamp=driver.get_clock().now().to_msg())
        names = ['cable_l', 'cable_s', 'wheel']
        driver.tension_publishers[0].publish(
            JointState(header=header, name=names, effort=[1.0, 2.0])
        )
        wait_for('that it is invalid', lambda: 'invalid' in driver.regimes)
        assert latest_values(driver)['dropped: wrong length'] == '1'
        assert not driver.estimates


@pytest.mark.parametrize('driver', STAMPED, indirect=True)
def test_stamps_of_another_clock_are_a_warning(driver):
    with driver.estimator('-p', 'input_timeout:=60.0', '-p', 'max_clock_offset:=30.0'):
        now = driver.get_clock().now().to_msg()
        since = len(driver.diagnostics)
        driver.publish(*SLIPPING, stamp=Time(sec=now.sec + 100))
        driver.wait_for_status(
            DiagnosticStatus.WARN, 'stamps differ from the clock of the node by +', since=since
        )


@pytest.mark.parametrize('driver', ['joint_state'], indirect=True)
def test_a_driver_that_does_not_stamp_is_taken_as_it_arrives(driver):
    with driver.estimator('-p', 'input_timeout:=60.0'):
        for _ in range(5):
            driver.publish(*STOP, stamp=Time())
        wait_for('all answers', lambda: len(driver.regimes) == 5)
        assert set(driver.regimes) == {'driven_to_stop'}
        assert driver.newest_estimate().header.stamp.sec > 0


@pytest.mark.parametrize(
    ('parameter', 'rows', 'reason'),
    [
        ('max_tension_rate:=1.0', [(1.0, 400.0)], 'too fast'),
        ('saturation_count:=5', [(1.0, 4.0)] * 8, 'saturated'),
        ('frozen_count:=5', [(1.0, 2.0)] * 8, 'frozen'),
    ],
)
def test_a_reading_that_is_not_plausible_is_dropped_counted_and_said(
    parameter, rows, reason, listener
):
    with listener.estimator('-p', 'input_timeout:=60.0', '-p', parameter):
        assert listener.answer(1.0, 2.5) == 'driven_to_stop'
        since = len(listener.diagnostics)
        for row in rows:
            listener.publish(*row)
        listener.wait_for_status(DiagnosticStatus.WARN, f'dropped {reason}', since=since)
        assert int(latest_values(listener)[f'dropped: {reason}']) > 0
        assert 'invalid' in listener.regimes


@pytest.mark.parametrize('driver', ['wrench_pair'], indirect=True)
def test_a_load_cell_alone_gives_nothing_and_is_counted(driver):
    reliable = reliable_input('wrench_pair')
    with driver.estimator('-p', 'max_skew:=0.0', *reliable) as program:
        driver.answer(*SLIPPING)
        count = len(driver.regimes)
        for _ in range(150):
            driver.publish_one(1.0)
        assert driver.answer(*SLIPPING) == 'equilibrium'
        assert len(driver.regimes) == count + 1
        wait_for('the count', lambda: latest_values(driver)['dropped: unpaired'] == '150')
        wait_for(
            'the warning',
            lambda: 'has no partner of its own within max_skew, 0 s' in program.output(),
        )


def test_each_cable_has_its_own_unit(listener):
    calibration = (
        *('cable_l.gain:=0.5', 'cable_l.bias:=-1.0', 'cable_s.gain:=-0.001', 'cable_s.bias:=1.0'),
        'cable_s.max_tension:=3.5',
    )
    arguments = [part for value in calibration for part in ('-p', value)]
    with listener.estimator(*arguments) as program:
        listener.answer(4.0, -1000.0)
        estimate = listener.newest_estimate()
        assert (estimate.tension_l, estimate.tension_s) == SLIPPING
        # Of the drivers' 4.0 and -1000.0, now in another unit.
        assert listener.set_estimator_parameters(cable_l__bias=-1.5).successful
        listener.publish(4.0, -1000.0)
        wait_for('an estimate in that', lambda: listener.estimates[-1].tension_l == 0.5)
        listener.publish(4.0, -2501.0)
        wait_for('that it is invalid', lambda: 'invalid' in listener.regimes)
        wait_for(
            'the warning',
            lambda: 'tension_s is 3.501 N, allowed is 0 to 3.5 N' in program.output(),
        )
        refused = listener.set_estimator_parameters(cable_s__gain=0.0)
        assert 'cable_s.gain is 0.0' in refused.reason


@pytest.mark.parametrize('driver', STAMPED, indirect=True)
def test_one_stamp_far_in_the_future_does_no_lasting_harm(driver):
    """Also if its message holds no tensions and comes while the input is stale."""
    with driver.estimator('-p', 'input_timeout:=0.2'):
        driver.answer(*SLIPPING)
        wait_for('that it is stale', lambda: driver.stale_regimes)
        future = Time(sec=2**31 - 1)
        driver.publish(math.nan, 1.0, stamp=future)
        wait_for('the next estimates', lambda: driver.publish(*STOP) or len(driver.estimates) > 9)
        driver.publish(*STOP, stamp=future)
        driver.stale_regimes.clear()
        count = len(driver.estimates)
        wait_for(
            'estimates again',
            lambda: driver.publish(*STOP) or len(driver.estimates) > count + 9,
        )


@pytest.mark.parametrize('driver', ['array', *STAMPED], indirect=True)
def test_a_simulated_clock_that_jumps_back_does_not_hang_it(driver):
    clock = driver.create_publisher(Clock, '/clock', 10)

    def told(seconds: int) -> None:
        clock.publish(Clock(clock=Time(sec=seconds)))

    sent = itertools.count(1)

    def answered_at(seconds: int) -> bool:
        """Tell time and tensions until both have come."""
        told(seconds)
        driver.publish(*STOP, stamp=Time(sec=seconds, nanosec=next(sent)))
        return any(estimate.header.stamp.sec == seconds for estimate in driver.estimates)

    with driver.estimator('-p', 'use_sim_time:=true') as program:
        for seconds in (1000, 1001, 5, 6, 1002):
            wait_for(f'an estimate at {seconds} s', lambda s=seconds: answered_at(s))
        # The clock stands still, and that tensions stop is seen all the same.
        before = len(driver.stale_regimes)
        wait_for('that the input is stale', lambda: len(driver.stale_regimes) > before)
        assert program.process.poll() is None


def test_markers_only_if_asked_for(listener):
    from visualization_msgs.msg import Marker, MarkerArray

    drawn: list[MarkerArray] = []
    listener.create_subscription(MarkerArray, 'estimator/markers', drawn.append, 10)
    with listener.estimator():
        listener.answer(*SLIPPING)
        assert listener.count_publishers('/estimator/markers') == 0
    with listener.estimator('-p', 'markers:=true', '-p', 'input_timeout:=0.2'):

        def actions() -> list[int]:
            return [message.markers[0].action for message in drawn]

        wait_for('a drawing', lambda: listener.answer(*SLIPPING) and Marker.ADD in actions())
        wait_for('its end', lambda: actions()[-1] == Marker.DELETEALL)


def test_with_sensor_data_qos_any_driver_fits():
    with (
        ForkedProgram.running('pulley_driver', '--ros-args', '-p', 'rate:=100.0'),
        spinning(Listener) as listener,
        ForkedProgram.running('estimator'),
    ):
        wait_for('estimates', lambda: len(listener.estimates) > 10)
        assert not math.isnan(listener.estimates[-1].tension_l)


def test_whatever_a_middleware_leaves_out_of_a_messages_info_is_optional(listener):
    """As one may that does not number messages, or has no clock: left out here by turns."""
    code = (
        'import itertools, sys\n'
        'from rclpy.impl.implementation_singleton import rclpy_implementation\n'
        'from tendon_statics.node.program import estimator\n'
        'Subscription = rclpy_implementation.Subscription\n'
        'take, kinds = Subscription.take_message, itertools.cycle(range(5))\n'
        'def take_less(*arguments):\n'
        '    taken = take(*arguments)\n'
        '    if taken is None:\n'
        '        return None\n'
        '    message, info = taken\n'
        '    left = [{}, dict.fromkeys(info), dict.fromkeys(info, 0),\n'
        '            {**info, "publication_sequence_number": None},\n'
        '            {**info, "received_timestamp": None}]\n'
        '    return message, left[next(kinds)]\n'
        'Subscription.take_message = take_less\n'
        'sys.exit(estimator())\n'
    )
    with Program.running_command([sys.executable, '-c', code]) as program:
        listener.connect(program)
        for _ in range(10):
            assert listener.answer(*SLIPPING) == 'equilibrium'
            assert listener.newest_estimate().header.stamp.sec > 0
        assert latest_values(listener)['messages lost on the way'] == 'not counted'
        assert program.end() == 0
