"""The installed programs as processes, nodes that spin beside them, and waiting for either."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Protocol, TypeVar

from ament_index_python.packages import get_package_prefix
from lifecycle_msgs.srv import GetState
from rclpy.client import Client
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

EXECUTOR = os.environ.get('EXECUTOR')
"""What every estimator that is run here is told to spin in, if it is told"""

TIME_LIMIT = 120.0
"""Seconds to wait for anything; more than ten times what a quiet machine needs"""


def wait_for(what: str, condition: Callable[[], bool], time_limit: float = TIME_LIMIT) -> None:
    """Wait until a condition holds."""
    deadline = time.monotonic() + time_limit
    while not condition():
        if time.monotonic() > deadline:
            raise TimeoutError(f'waited {time_limit:.0f} s for {what}')
        time.sleep(0.002)


def ask(client: Client, request: Any) -> Any:
    """Ask a service that does the same however often it is asked, until it answers.

    An answer is lost while the server does not know the client yet, so it is asked again, each
    time after twice as long. Of a server that is only slow the answer to any of them counts.
    """
    wait_for(client.srv_name, client.service_is_ready)
    asked = []
    patience, deadline = 1.0, time.monotonic() + TIME_LIMIT
    while not any(future.done() for future in asked):
        if time.monotonic() > deadline:
            raise TimeoutError(f'{client.srv_name} was asked {len(asked)} times, without answer')
        asked.append(client.call_async(request))
        with suppress(TimeoutError):
            wait_for(
                'an answer', lambda: any(future.done() for future in asked), time_limit=patience
            )
        patience *= 2.0
    return next(future.result() for future in asked if future.done())


def answer_of(future: Future, name: str) -> Any:
    """Wait for the answer of a service that was asked once."""
    wait_for(f'an answer of {name}', future.done)
    return future.result()


def become_known(node: Node, managed: str) -> None:
    """Wait until a managed node knows all that a node has made so far, and is spun.

    The node sees itself which publishers and subscriptions it has found. But what the other side
    does not know yet is lost, or never sent. That learns of the publishers, subscriptions and
    clients of a node in the order in which they were made, so it knows all of them when it answers
    a client that is made now.
    """
    ask(node.create_client(GetState, f'{managed}/get_state'), GetState.Request())


END_WITH_PARENT = ('setpriv', '--pdeathsig', 'TERM', '--') if shutil.which('setpriv') else ()
"""So that a run that is killed leaves nothing behind in a ROS domain that others may take"""


class Process(Protocol):
    """What a program needs of `subprocess.Popen`."""

    pid: int

    def poll(self) -> int | None:
        """Return its exit code if it has ended; minus the signal if that ended it."""

    def wait(self, timeout: float | None = None) -> int:
        """Return its exit code when it has ended, or raise `subprocess.TimeoutExpired`."""

    def send_signal(self, sig: int, /) -> None:
        """Send a signal if it has not ended."""


class Program:
    """A program of the package as a process of its own."""

    def __init__(self, command: Sequence[str | Path]) -> None:
        self._output = tempfile.TemporaryFile()  # noqa: SIM115  closed in running_command
        self.process = self._start(command)

    def _start(self, command: Sequence[str | Path]) -> Process:
        return subprocess.Popen(
            [*END_WITH_PARENT, *command], stdout=self._output, stderr=subprocess.STDOUT
        )

    def output(self) -> str:
        """What it has written so far, on both streams."""
        # Without moving the place in the file where the program, which shares it, writes next.
        file = self._output.fileno()
        return os.pread(file, os.fstat(file).st_size, 0).decode(errors='replace')

    def sent(self) -> dict[str, int]:
        """What a driver that has ended says that it sent: readings, messages, by fault."""
        (line,) = [line for line in self.output().splitlines() if 'Sent: ' in line]
        return json.loads(line.split('Sent: ', 1)[1])

    def memory(self) -> float:
        """Memory that it holds, in MB."""
        lines = Path(f'/proc/{self.process.pid}/status').read_text().splitlines()
        (line,) = [line for line in lines if line.startswith('VmRSS:')]
        return int(line.split()[1]) / 1024.0

    def cpu_time(self) -> float:
        """CPU time in s that all of its threads took so far."""
        tasks = Path(f'/proc/{self.process.pid}/task')
        of_tasks = (task.joinpath('schedstat').read_text() for task in tasks.iterdir())
        return 1e-9 * sum(int(text.split()[0]) for text in of_tasks)

    def end(self, number: int = signal.SIGINT, within: float = TIME_LIMIT) -> int:
        """Send a signal and return the exit code.

        Raises
        ------
        TimeoutError
            If it needs more seconds than `within`, without those in which others had the cores.
        """
        if self.process.poll() is not None:
            return self.wait()
        begin, waited, took = time.monotonic(), 0.0, 0.0

        def has_ended() -> bool:
            nonlocal took
            with suppress(OSError):  # of one that is gone
                took = time.monotonic() - begin - (self._waited_for_core() - waited)
            return self.process.poll() is not None

        with suppress(OSError):  # likewise
            waited = self._waited_for_core()
        self.process.send_signal(number)
        wait_for('its end', has_ended)
        if took > within:
            raise TimeoutError(f'it took {took:.1f} s to end, allowed are {within:g} s')
        return self.wait()

    def _waited_for_core(self) -> float:
        """Seconds in which its main thread could run, but others had the cores."""
        return 1e-9 * int(Path(f'/proc/{self.process.pid}/schedstat').read_text().split()[1])

    def wait(self, time_limit: float = TIME_LIMIT) -> int:
        """Return the exit code when it has ended."""
        return self.process.wait(timeout=time_limit)

    @classmethod
    @contextmanager
    def running(cls, name: str, *ros_arguments: str) -> Iterator[Program]:
        """Run an installed program; it is ended on leaving if it has not been."""
        if name == 'estimator' and EXECUTOR and ros_arguments[:1] in ((), ('--ros-args',)):
            ros_arguments = (*(ros_arguments or ('--ros-args',)), '-p', f'executor:={EXECUTOR}')
        path = Path(get_package_prefix('tendon_statics'), 'lib', 'tendon_statics', name)
        with cls.running_command([path, *ros_arguments]) as program:
            yield program

    @classmethod
    @contextmanager
    def running_command(cls, command: Sequence[str | Path]) -> Iterator[Program]:
        """Run any command in the same way."""
        program = cls(command)
        try:
            yield program
        except Exception:  # not Ctrl-C, at which nobody asks
            print(f'{" ".join(map(str, command))} has said:\n{program.output()}')
            raise
        finally:
            if program.process.poll() is None:
                # Politely, so that it says goodbye to the others of its domain.
                program.process.send_signal(signal.SIGINT)
                try:
                    program.wait()
                except subprocess.TimeoutExpired:
                    program.process.send_signal(signal.SIGKILL)
                    program.wait()
            program._output.close()


NodeType = TypeVar('NodeType', bound=Node)


@contextmanager
def spinning(make_node: Callable[[Context], NodeType]) -> Iterator[NodeType]:
    """Spin a node in a thread of its own, in a context of its own."""
    context = Context()
    context.init()
    node = make_node(context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    ended = threading.Event()

    def spin() -> None:
        while not ended.is_set():
            executor.spin_once(timeout_sec=1.0)

    thread = threading.Thread(target=spin)
    thread.start()
    try:
        yield node
    finally:
        # In this order: what the thread still waits for must not be destroyed under it.
        ended.set()
        executor.wake()
        thread.join()
        executor.shutdown()
        node.destroy_node()
        context.try_shutdown()
