"""More that happens on rigs: clocks that jump, processes that stop, managers that cycle."""

import signal
import threading
from dataclasses import replace
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_prefix
from builtin_interfaces.msg import Time
from designs import PRELIMINARY
from listener import Listener, reliable_input
from ros_programs import EXECUTOR, Program, spinning, wait_for

from tendon_statics import solve

STOP = (1.0, 3.0)
JUMP = 37
"""s"""


@pytest.fixture
def joint_state_listener():
    with spinning(lambda context: Listener(context, 'joint_state')) as node:
        yield node


def test_a_drivers_clock_may_jump_both_ways_and_only_a_timeout_is_lost(joint_state_listener):
    """Forward at once; back as soon as the input is stale and three stamps in a row rise."""
    listener = joint_state_listener
    with listener.estimator('-p', 'input_timeout:=0.3', *reliable_input('joint_state')):
        now = listener.get_clock().now().nanoseconds // 10**9
        listener.forget()
        seconds = 0

        def tell(offset: int) -> Time:
            nonlocal seconds
            seconds += 1
            stamp = Time(sec=now + seconds + offset)
            listener.publish(*STOP, stamp=stamp)
            return stamp

        def told(offset: int) -> bool:
            tell(offset)
            listener.report()  # longer than the timeout
            return bool(listener.estimates)

        since = len(listener.diagnostics)
        ahead = tell(JUMP)
        wait_for('what is ahead', lambda: listener.estimates)
        assert listener.estimates[-1].header.stamp == ahead
        offset = 'stamps differ from the clock of the node by +3'
        wait_for(
            'a warning',  # by then the input may be stale, which says more
            lambda: any(offset in status.message for status in listener.diagnostics[since:]),
        )
        listener.forget()
        listener.stale_regimes.clear()
        for offset in (-JUMP, JUMP, 0):
            before = listener.count('dropped: out of order')
            wait_for('the clock to be believed again', lambda o=offset: told(o))
            assert listener.count('dropped: out of order') - before <= 3
            listener.forget()


@pytest.mark.parametrize('stamp', [Time(sec=-1), Time(sec=-1, nanosec=500_000_000)])
def test_a_stamp_before_all_time_does_no_harm(stamp, joint_state_listener):
    listener = joint_state_listener
    arguments = ('-p', 'input_timeout:=60.0', *reliable_input('joint_state'))

    def is_dropped() -> bool:
        listener.report()
        return listener.count('dropped: out of order') == 1

    with listener.estimator(*arguments) as program:
        assert listener.answer(*STOP) == 'driven_to_stop'
        listener.publish(*STOP, stamp=stamp)
        wait_for('that it is dropped', is_dropped)
        assert f'{stamp.sec + 1e-9 * stamp.nanosec:.9f} s' in program.output()
        assert listener.answer(*STOP) == 'driven_to_stop'
    listener.forget()
    with listener.estimator(*arguments):
        # As the first of all.
        wait_for('an answer', lambda: listener.publish(*STOP, stamp=stamp) or listener.regimes)
        assert listener.answer(*STOP) == 'driven_to_stop'


def test_what_waited_while_the_process_was_stopped_is_all_taken(joint_state_listener):
    """SIGSTOP for the time of 600 messages, as a laptop that sleeps or a debugger does it."""
    listener = joint_state_listener
    with listener.estimator(*reliable_input('joint_state')) as program:
        listener.report()
        before = listener.count('pairs solved')
        since = len(listener.diagnostics)
        program.process.send_signal(signal.SIGSTOP)
        rows = [(1.0, 2.6 + 0.001 * index) for index in range(600)]
        for row in rows:
            listener.publish(*row)
        threading.Event().wait(3.0)
        program.process.send_signal(signal.SIGCONT)
        wait_for('all of them', lambda: len(listener.estimates) == len(rows))
        assert [(e.tension_l, e.tension_s) for e in listener.estimates] == rows
        # The middleware was stopped too, so that they arrived just now; their stamps tell.
        wait_for(
            'a warning',
            lambda: any('that are old' in of.message for of in listener.diagnostics[since:]),
        )
        assert listener.answer(*STOP) == 'driven_to_stop'
        listener.report()
        assert listener.count('pairs solved') == before + len(rows) + 1


def test_two_clients_that_set_parameters_at_once_leave_a_design_that_one_asked_for(listener):
    """Each sets two values that belong together, all through a stream."""
    asked = ((0.2, 0.02), (0.4, 0.04))
    pairs = {design: solve_stop(*design) for design in asked}
    with listener.estimator(*reliable_input()) as program, spinning(Listener) as other:
        other.connect(program)
        ended = threading.Event()

        def stream() -> None:
            for _ in range(100_000):
                if ended.wait(0.002):
                    return
                listener.publish(*STOP)

        def keep_setting(client, stop: float, mass: float) -> None:
            for _ in range(100):
                design = {'design__max_bend_angle': stop, 'design__mass': mass}
                results = client.set_one_by_one(**design)
                assert all(result.successful for result in results), results

        threads = [threading.Thread(target=stream)]
        threads += [
            threading.Thread(target=keep_setting, args=(client, *design))
            for client, design in zip((listener, other), asked, strict=True)
        ]
        assert listener.set_estimator_parameters(
            design__max_bend_angle=asked[0][0], design__mass=asked[0][1]
        ).successful
        listener.forget()
        for thread in threads:
            thread.start()
        try:
            for thread in threads[1:]:
                thread.join()
            wait_for('estimates', lambda: len(listener.estimates) > 200)
        finally:
            ended.set()
            threads[0].join()
        found = {(e.bend_angle, e.pressure) for e in listener.estimates}
        assert found <= set(pairs.values())
        assert listener.estimator_parameter('design.mass') in (0.02, 0.04)


def solve_stop(stop: float, mass: float) -> tuple[float, float]:
    answer = solve(replace(PRELIMINARY, max_bend_angle=stop, mass=mass), *STOP)
    return answer.bend_angle, answer.pressure


def test_a_manager_may_cycle_it_a_thousand_times(listener):
    """Nothing is left behind of a cycle: no timer, no memory, no state."""
    with listener.estimator('-p', 'input_timeout:=600.0') as program:

        def cycle(count: int) -> None:
            for _ in range(count):
                for transition in ('deactivate', 'cleanup', 'configure', 'activate'):
                    assert listener.change_state(transition)

        cycle(20)
        memory = program.memory()
        cycle(980)
        assert program.memory() < memory + 8.0
        assert listener.estimator_state() == 'active'
        assert listener.answer(*STOP) == 'driven_to_stop'
        listener.newest_estimate()
        assert 'Traceback' not in program.output()


def test_a_disk_that_is_full_costs_the_log_and_nothing_else(listener):
    """By a limit on the size of files, with neither room for ROS's log nor for the console's."""
    estimator = Path(get_package_prefix('tendon_statics'), 'lib', 'tendon_statics', 'estimator')
    full = ('bash', '-c', 'ulimit -f 0; exec "$@"', 'bash')
    given = ('--ros-args', '-p', f'executor:={EXECUTOR or "single"}')
    with Program.running_command((*full, estimator, *given)) as program:
        listener.connect(program)
        for mass in (0.03, -1.0, 0.02):  # of which each is said, or that it is refused
            result = listener.set_estimator_parameters(design__mass=mass)
            assert result.successful == (mass > 0.0)
            assert listener.answer(*STOP) == 'driven_to_stop'
        assert program.output() == ''
        assert program.end() == 0
