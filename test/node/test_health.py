"""What the estimator says about itself on /diagnostics, alone and over ROS."""

import math
import time

from designs import PRELIMINARY
from diagnostic_msgs.msg import DiagnosticStatus
from estimates import estimate_of
from forked_programs import ForkedProgram
from listener import Listener
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from ros_programs import spinning, wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray

from tendon_statics import solve
from tendon_statics.estimation.health import Health, Level
from tendon_statics.node.diagnostics import status_of
from tendon_statics.physics import StickSlipTracker
from tendon_statics.tensions.reason import Reason

HELD, SLIPPING, STOP = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0)
OK, WARN, ERROR, STALE = (
    *(DiagnosticStatus.OK, DiagnosticStatus.WARN),
    *(DiagnosticStatus.ERROR, DiagnosticStatus.STALE),
)


def said(health: Health, **publishers: int) -> tuple[bytes, str]:
    status = status_of(health, 'estimator: estimation', 'bend', publishers)
    assert status.name == 'estimator: estimation'
    assert status.hardware_id == 'bend'
    return status.level, status.message


def values(status: DiagnosticStatus) -> dict[str, str]:
    return {item.key: item.value for item in status.values}


def test_the_worst_since_the_last_report_counts():
    health = Health()
    assert said(health) == (OK, 'no tensions came yet')
    health.note_estimate(estimate_of(solve(PRELIMINARY, *SLIPPING)), 1e-4)
    assert said(health) == (OK, 'equilibrium')
    health.note_estimate(estimate_of(solve(PRELIMINARY, *HELD)), 1e-4)
    health.note_estimate(estimate_of(solve(PRELIMINARY, *STOP)), 1e-4)
    level, message = said(health)
    assert level == WARN
    assert message == 'held, so that tensions do not determine the angle (1 of 3)'
    health.note_drop(Reason.IMPLAUSIBLE, 'tension_l is 2000.0 N')
    level, message = said(health)
    assert level == ERROR
    assert message.startswith('implausible tension; dropped implausible 1; the last: tension_l')
    health.begin_period()
    assert said(health) == (OK, 'driven_to_stop')


def test_a_known_fault_says_more_than_silence():
    health = Health()
    health.stale = True
    assert said(health) == (STALE, 'no valid tensions came yet')
    health.note_drop(Reason.NOT_FINITE, 'tension_l is nan N')
    assert said(health)[0] == STALE
    assert 'dropped not finite 1' in said(health)[1]
    health.note_drop(Reason.IMPLAUSIBLE, 'tension_l is 2000.0 N')
    assert said(health)[0] == ERROR
    assert health.level is Level.ERROR
    health.note_estimate(estimate_of(solve(PRELIMINARY, *SLIPPING)), 1e-4)
    assert not health.stale


def test_with_memory_held_is_as_it_should_be():
    health = Health()
    health.note_estimate(estimate_of(StickSlipTracker(PRELIMINARY).update(*HELD)), 1e-4)
    assert said(health) == (OK, 'held')


def test_a_result_of_the_other_branch_is_a_warning():
    # So little tension that friction does not lift the unit's weight.
    result = solve(PRELIMINARY, 0.05, 0.15)
    assert result.branch_consistent is False
    health = Health()
    health.note_estimate(estimate_of(result), 1e-4)
    assert said(health) == (WARN, 'forces ask for the other root of the model (1 of 1)')


def test_two_publishers_and_lost_messages_are_warnings():
    health = Health()
    health.note_estimate(estimate_of(solve(PRELIMINARY, *SLIPPING)), 1e-4)
    status = status_of(health, 'n: t', 'bend', {'/tensions': 2})
    assert (status.level, status.message) == (WARN, '2 publishers on /tensions, one is expected')
    assert values(status)['publishers on /tensions'] == '2'
    health.note_lost(3)
    assert said(health) == (WARN, '3 messages lost on the way')
    health.begin_period()
    assert said(health)[0] == OK
    assert values(status_of(health, 'n: t', 'bend', {}))['messages lost on the way'] == '3'


def test_where_lost_messages_are_not_seen_none_is_claimed():
    health = Health(counts_lost=False)
    assert (
        values(status_of(health, 'n: t', 'bend', {}))['messages lost on the way'] == 'not counted'
    )


def test_tensions_that_waited_long_are_older_and_a_warning():
    health = Health()
    health.note_estimate(estimate_of(solve(PRELIMINARY, *SLIPPING)), 1e-4)
    health.note_lag(0.2, most=0.5)
    assert said(health)[0] == OK
    assert float(values(status_of(health, 'n: t', 'b', {}))['age of newest tensions [s]']) >= 0.2
    health.note_lag(0.7, most=0.5)
    assert said(health) == (WARN, 'behind: tensions waited 0.7 s to be taken')


def test_counts_are_kept_by_reason():
    health = Health()
    for reason in Reason:
        health.note_drop(reason, f'a {reason.value} message')
    found = values(status_of(health, 'n: t', 'bend', {}))
    assert all(found[f'dropped: {reason.value}'] == '1' for reason in Reason)
    assert found['last drop'] == 'a unpaired message'
    assert found['pairs solved'] == '0'
    assert found['age of newest tensions [s]'] == ''


def test_a_quiet_start_a_stream_and_its_end(listener):
    """STALE at once when tensions stop, and OK at once when they come again."""
    with listener.estimator('-p', 'input_timeout:=0.2', '-p', 'joint_name:=elbow') as program:
        since = len(listener.diagnostics)
        assert listener.answer(*SLIPPING) == 'equilibrium'
        stale = listener.wait_for_status(STALE, 'no valid tensions for ', since=since)
        assert stale.name == 'estimator: estimation'
        assert stale.hardware_id == 'elbow'
        assert values(stale)['regime of newest tensions'] == 'equilibrium'
        assert 'No valid tensions on /tensions for 0.2 s' in program.output()
        since = len(listener.diagnostics)
        sent = time.monotonic()
        assert listener.answer(*SLIPPING) == 'equilibrium'

        def recovered() -> list[DiagnosticStatus]:
            return [status for status in listener.diagnostics[since:] if status.level != STALE]

        wait_for('that tensions come again', recovered)
        status = recovered()[0]
        assert float(values(status)['age of newest tensions [s]']) <= time.monotonic() - sent
        assert float(values(status)['mean solve time [ms]']) > 0.0


def test_a_changed_timeout_counts_from_then(listener):
    with listener.estimator('-p', 'input_timeout:=60.0'):
        listener.answer(*SLIPPING)
        assert listener.set_estimator_parameters(input_timeout=0.2).successful
        wait_for('that it is stale', lambda: listener.stale_regimes)


def test_stale_is_said_at_once_also_after_an_error(listener):
    with listener.estimator('-p', 'input_timeout:=0.1', '-p', 'cable_s.max_tension:=5.0'):
        for _ in range(3):
            listener.answer(*SLIPPING)
            since = len(listener.diagnostics)
            listener.answer(1.0, 5.5)
            listener.wait_for_status(ERROR, 'implausible tension', since=since)
        listener.wait_for_status(STALE, 'no valid tensions', since=since)


def test_an_angle_that_is_not_assured_is_a_warning(listener):
    arguments = ('estimation:=tracking', 'input_timeout:=0.2')
    with listener.estimator(*(part for value in arguments for part in ('-p', value))):
        listener.answer(*STOP)
        assert listener.reset().success
        wait_for('that it is stale', lambda: listener.stale_regimes)
        # Put somewhere while nobody looks, and left alone again.
        assert listener.reset().success
        since = len(listener.diagnostics)
        listener.report()
        listener.report()
        count = len(listener.estimates)
        listener.answer(*HELD)
        wait_for('the estimate', lambda: len(listener.estimates) > count)
        assert not listener.newest_estimate().angle_assured
        listener.wait_for_status(WARN, 'its angle is not assured', since=since)


def test_stale_is_said_once_and_nothing_else_until_tensions_come_again(listener):
    # Twenty times the timeout is waited for, by the reports that come each second.
    with listener.estimator('-p', 'input_timeout:=0.1'):
        assert listener.answer(*SLIPPING) == 'equilibrium'
        wait_for('all of the answer', listener.has_all)
        wait_for('that it is stale', lambda: listener.stale_regimes)
        counts = listener.count_kept()
        said_before = len(listener.stale_regimes)
        listener.report()
        listener.report()
        assert len(listener.stale_regimes) == said_before
        assert listener.count_kept() == counts
        # What is no tensions does not end it.
        since = len(listener.diagnostics)
        assert listener.answer(math.nan, 1.0) == 'invalid'
        listener.wait_for_status(STALE, 'not finite 1', since=since)
        assert listener.answer(*SLIPPING) == 'equilibrium'
        wait_for('stale again', lambda: len(listener.stale_regimes) == said_before + 1)


def test_before_the_first_tensions_only_diagnostics_say_so(listener):
    with listener.estimator('-p', 'input_timeout:=0.1'):
        status = listener.wait_for_status(STALE, 'no valid tensions came yet')
        assert values(status)['messages received'] == '0'
        left = values(status)['design values left at the preliminary design']
        assert 'design.mass' in left
        assert not listener.regimes
        assert not listener.stale_regimes


def test_levels_follow_the_tensions(listener):
    def report_of(*tensions: float, level: bytes, named: str) -> None:
        """Tell the tensions again and again, as a driver does, until a report is of them."""
        since = len(listener.diagnostics)

        def found() -> bool:
            listener.answer(*tensions)
            return any(
                status.level == level and named in status.message
                for status in listener.diagnostics[since:]
            )

        wait_for(f'a report of {tensions}', found)

    with listener.estimator('-p', 'cable_s.max_tension:=5.0'):
        report_of(*SLIPPING, level=OK, named='equilibrium')
        report_of(*HELD, level=WARN, named='held, so that tensions do not determine the angle')
        report_of(*STOP, level=OK, named='driven_to_stop')
        report_of(1.0, 5.5, level=ERROR, named='implausible tension')
        report_of(*STOP, level=OK, named='driven_to_stop')
        report_of(-1.0, 2.0, level=WARN, named='dropped negative')
        report_of(0.05, 0.1, level=STALE, named='dropped below the weight')
        assert not listener.solve_latest().message.startswith('no valid')


def test_a_second_publisher_is_noticed(listener):
    with listener.estimator():
        with spinning(Listener):
            listener.wait_for_status(STALE, '2 publishers on /tensions, one is expected')
        since = len(listener.diagnostics)
        wait_for(
            'it to be gone',
            lambda: any(
                values(status).get('publishers on /tensions') == '1'
                for status in listener.diagnostics[since:]
            ),
        )


def test_two_nodes_of_one_name_both_say_so(listener):
    quiet = ('--ros-args', '-p', 'input_timeout:=600.0')
    with ForkedProgram.running('estimator', *quiet), ForkedProgram.running('estimator', *quiet):
        for _ in range(2):  # of the two, each once a second
            listener.wait_for_status(WARN, '2 nodes are called /estimator, and each publishes')
    with ForkedProgram.running('estimator', *quiet, '-r', '__ns:=/left'):
        since = len(listener.diagnostics)

        def told() -> list[DiagnosticStatus]:
            return [of for of in listener.diagnostics[since:] if of.name.startswith('left/')]

        wait_for('a status', told)
        assert 'nodes are called' not in told()[0].message


def test_a_driver_of_another_kind_is_named(listener):
    """Which ROS by itself does not say: nothing comes, and no publisher is counted."""
    with (
        spinning(lambda context: Listener(context, 'joint_state')),
        ForkedProgram.running('estimator', '--ros-args', '-p', 'input_timeout:=0.1'),
    ):
        status = listener.wait_for_status(STALE, '/tensions is published as sensor_msgs/msg/Joint')
        assert 'tension_source array takes std_msgs/msg/Float64MultiArray' in status.message


def test_a_driver_whose_quality_of_service_does_not_fit_is_named(listener):
    reliable = ('-p', 'qos_overrides./tensions.subscription.reliability:=reliable')
    with spinning(lambda context: Node('driver', context=context)) as driver:
        best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        driver.create_publisher(Float64MultiArray, 'tensions', best_effort)
        with ForkedProgram.running(
            'estimator', '--ros-args', '-p', 'input_timeout:=0.1', *reliable
        ):
            status = listener.wait_for_status(STALE, 'a quality of service that does not fit')
            assert 'reliab' in status.message.lower()


def test_one_of_two_drivers_that_does_not_fit_is_named_though_tensions_come(listener):
    reliable = ('-p', 'qos_overrides./tensions.subscription.reliability:=reliable')
    with spinning(lambda context: Node('driver', context=context)) as driver:
        heard = driver.create_publisher(Float64MultiArray, 'tensions', 10)
        best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        driver.create_publisher(Float64MultiArray, 'tensions', best_effort)
        with ForkedProgram.running(
            'estimator', '--ros-args', '-p', 'input_timeout:=60.0', *reliable
        ):

            def is_answered() -> bool:
                heard.publish(Float64MultiArray(data=[1.0, 2.0]))
                return bool(listener.regimes)

            # Again and again, since what is sent before all have found each other is lost.
            wait_for('an answer', is_answered)
            listener.wait_for_status(WARN, 'a quality of service that does not fit')


def test_a_sensor_of_the_angle_that_does_not_fit_is_named(listener):
    arguments = (
        *('-p', 'estimation:=tracking', '-p', 'input_timeout:=60.0'),
        *('-p', 'qos_overrides./measured_bend_angle.subscription.reliability:=reliable'),
    )
    with spinning(lambda context: Node('sensor', context=context)) as sensor:
        best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        sensor.create_publisher(Float64, 'measured_bend_angle', best_effort)
        with listener.estimator(*arguments):
            assert listener.answer(*HELD) == 'held'
            listener.wait_for_status(WARN, '/measured_bend_angle is published with a quality')


def test_a_driver_is_found_by_the_topic_that_is_remapped_once():
    """With swapped cables each name is also that of the other topic."""
    swapped = ('-r', 'tension_l:=/tension_s', '-r', 'tension_s:=/tension_l')
    with (
        spinning(Listener) as listener,
        spinning(lambda context: Node('driver', context=context)) as driver,
        ForkedProgram.running(
            'estimator', '--ros-args', '-p', 'tension_source:=wrench_pair', *swapped
        ),
    ):
        driver.create_publisher(JointState, 'tension_s', 10)
        status = listener.wait_for_status(STALE, 'JointState')
        assert '/tension_s is published as sensor_msgs/msg/JointState' in status.message
        assert '/tension_l' not in status.message


def test_the_name_tells_estimators_apart(listener):
    arguments = ('-r', '__ns:=/left/wrist')
    with ForkedProgram.running('estimator', '--ros-args', *arguments):
        wait_for('a status', lambda: listener.diagnostics)
        assert listener.diagnostics[-1].name == 'left/wrist/estimator: estimation'
