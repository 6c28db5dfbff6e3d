"""What runs programs and nodes for the tests: it ends them in order, and says if they do not."""

import signal
import sys
import threading
import time

import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from ros_programs import Program, ask, spinning, wait_for
from std_srvs.srv import Trigger


def test_a_node_is_not_destroyed_while_its_thread_gathers_what_to_wait_for(monkeypatch):
    """Then the thread would end by an exception."""
    gathering, errors = threading.Event(), []
    get_nodes = SingleThreadedExecutor.get_nodes

    def get_slowly(executor):
        gathering.set()
        time.sleep(0.1)
        return get_nodes(executor)

    monkeypatch.setattr(SingleThreadedExecutor, 'get_nodes', get_slowly)
    monkeypatch.setattr(threading, 'excepthook', errors.append)
    with spinning(lambda context: Node('spun', context=context)):
        assert gathering.wait(60.0)
    assert not errors


SPEAKER = (
    'import sys\n'
    'for number in range(20000):\n'
    '    sys.stdout.write(f"{number}\\n")\n'
    '    sys.stdout.flush()\n'
)


def test_what_a_program_says_is_whole_however_often_it_is_read_meanwhile():
    with Program.running_command([sys.executable, '-c', SPEAKER]) as program:
        wait_for('its end', lambda: bool(program.output()) and program.process.poll() is not None)
        assert program.output().split() == [str(number) for number in range(20000)]


SLEEPER = (
    'import signal, sys, time\n'
    'def end_late(*_):\n'
    '    time.sleep(1.0)\n'
    '    sys.exit(3)\n'
    'signal.signal(signal.SIGTERM, end_late)\n'
    'print("ready", flush=True)\n'
    'while True: time.sleep(0.1)\n'
)


def test_the_exit_code_of_a_program_is_returned_and_one_that_ends_too_late_is_an_error():
    for within in (60.0, 0.5):
        with Program.running_command([sys.executable, '-c', SLEEPER]) as program:
            wait_for('the program', lambda p=program: 'ready' in p.output())
            if within > 1.0:
                assert program.end(signal.SIGTERM, within) == 3
            else:
                with pytest.raises(TimeoutError, match=r'to end, allowed are 0\.5 s'):
                    program.end(signal.SIGTERM, within)


def test_a_slow_answer_counts_though_it_was_asked_again():
    with (
        spinning(lambda context: Node('server', context=context)) as server,
        spinning(lambda context: Node('asker', context=context)) as asker,
    ):
        is_slow, asked = threading.Event(), []

        def answer(_request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
            if is_slow.is_set():
                time.sleep(1.5)  # longer than it is waited for at first
            asked.append(is_slow.is_set())
            response.message = str(asked.count(True))
            return response

        server.create_service(Trigger, 'slow', answer)
        client = asker.create_client(Trigger, 'slow')
        assert ask(client, Trigger.Request()).message == '0'  # From now on it knows the client.
        is_slow.set()
        assert ask(client, Trigger.Request()).message == '1'
        wait_for('that it was asked again', lambda: asked.count(True) > 1)


def test_what_a_program_has_said_is_shown_when_a_test_of_it_fails(capsys):
    def fail():
        with Program.running_command([sys.executable, '-c', SLEEPER]) as program:
            wait_for('the program', lambda: 'ready' in program.output())
            raise AssertionError('of the test')

    with pytest.raises(AssertionError, match='of the test'):
        fail()
    assert 'has said:\nready\n' in capsys.readouterr().out
