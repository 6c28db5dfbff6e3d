"""The installed programs as processes, and a node that talks to the estimator."""

from __future__ import annotations

import json
import math
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
from typing import Any, TypeVar

from ament_index_python.packages import get_package_prefix
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped, Vector3, Wrench, WrenchStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.msg import Parameter, ParameterValue, SetParametersResult
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParametersAtomically
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray, Header, String
from std_srvs.srv import Trigger
from tendon_statics_interfaces.msg import Estimate
from tendon_statics_interfaces.srv import Solve, SolveInverse

EXECUTOR = os.environ.get('EXECUTOR')
"""What every estimator that is run here is told to spin in, if it is told"""

TIME_LIMIT = 30.0
"""Seconds to wait for anything; ten times what is expected."""


def wait_for(what: str, condition: Callable[[], bool], time_limit: float = TIME_LIMIT) -> None:
    """Wait until a condition holds."""
    deadline = time.monotonic() + time_limit
    while not condition():
        if time.monotonic() > deadline:
            raise TimeoutError(f'waited {time_limit:.0f} s for {what}')
        time.sleep(0.002)


# With the preliminary design.
ANSWERED_ON_ALL_TOPICS = (1.0, 3.0)
MIRRORED = (3.5, 1.0)
ANSWERED_AS_HELD = (1.0, 1.5)


END_WITH_PARENT = ('setpriv', '--pdeathsig', 'TERM', '--') if shutil.which('setpriv') else ()
"""So that a run that is killed leaves nothing behind in a ROS domain that others may take"""


class Program:
    """A program of the package as a process of its own."""

    def __init__(self, command: Sequence[str | Path]) -> None:
        # Appending, since the position in the file is shared with the program.
        self._output = tempfile.TemporaryFile('a+')  # noqa: SIM115  closed in running_command
        self.process = subprocess.Popen(
            [*END_WITH_PARENT, *command], stdout=self._output, stderr=subprocess.STDOUT
        )

    def output(self) -> str:
        """What it has written so far, on both streams."""
        self._output.seek(0)
        return self._output.read()

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

    def end(self, number: int = signal.SIGINT, time_limit: float = TIME_LIMIT) -> int:
        """Send a signal and return the exit code."""
        self.process.send_signal(number)
        return self.wait(time_limit)

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
        finally:
            if program.process.poll() is None:
                # Politely, so that it says goodbye to the others of its domain.
                program.process.send_signal(signal.SIGINT)
                try:
                    program.wait(time_limit=5.0)
                except subprocess.TimeoutExpired:
                    program.process.kill()
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
    thread = threading.Thread(target=executor.spin)
    thread.start()
    try:
        yield node
    finally:
        executor.shutdown()
        thread.join()
        node.destroy_node()
        context.try_shutdown()


class Listener(Node):
    """Keeps all that the estimator publishes, publishes tensions and calls its services.

    Tensions are published as messages of the kind `tension_source`; with None they are left to a
    driver.
    """

    def __init__(self, context: Context, tension_source: str | None = 'array') -> None:
        super().__init__('listener', context=context)
        self._tension_source = tension_source
        self.regimes: list[str] = []
        self.stale_regimes: list[str] = []
        self.bend_angles: list[float] = []
        self.joint_pressures: list[float] = []
        self.unit_poses: list[PoseWithCovarianceStamped] = []
        self.joint_states: list[JointState] = []
        self.slip_margins: list[float] = []
        self.admissible_angles: list[Float64MultiArray] = []
        self.estimates: list[Estimate] = []
        self.diagnostics: list[DiagnosticStatus] = []
        self.measured_bend_angle = self.create_publisher(Float64, 'measured_bend_angle', 10)
        kinds: dict[str | None, dict[str, type]] = {
            None: {},
            'array': {'tensions': Float64MultiArray},
            'joint_state': {'tensions': JointState},
            'wrench_pair': {'tension_l': WrenchStamped, 'tension_s': WrenchStamped},
        }
        self.tension_publishers = [
            self.create_publisher(message_type, topic, 1000)
            for topic, message_type in kinds[tension_source].items()
        ]
        self._clients_by_name = {
            name: self.create_client(service_type, f'estimator/{name}')
            for name, service_type in (
                ('solve', Solve),
                ('solve_inverse', SolveInverse),
                ('solve_latest', Trigger),
                ('reset', Trigger),
                ('tare', Trigger),
                ('change_state', ChangeState),
                ('get_state', GetState),
                ('get_parameters', GetParameters),
                ('describe_parameters', DescribeParameters),
                ('set_parameters_atomically', SetParametersAtomically),
            )
        }
        self._stores = (
            self._keep_regimes(),
            self._keep(Float64, 'bend_angle', self.bend_angles, attribute='data'),
            self._keep(Float64, 'joint_pressure', self.joint_pressures, attribute='data'),
            self._keep(PoseWithCovarianceStamped, 'unit_pose', self.unit_poses),
            self._keep(JointState, 'joint_state', self.joint_states),
            self._keep(Float64, 'slip_margin', self.slip_margins, attribute='data'),
            self._keep(Float64MultiArray, 'admissible_angles', self.admissible_angles),
            self._keep(Estimate, 'estimate', self.estimates),
        )
        self._answered = list(self.subscriptions)
        self.create_subscription(
            DiagnosticArray,
            '/diagnostics',
            lambda message: self.diagnostics.extend(message.status),
            QoSProfile(depth=5000),
        )

    def _keep(self, message_type: type, topic: str, store: list, attribute: str = '') -> list:
        def keep(message: Any) -> None:
            store.append(getattr(message, attribute) if attribute else message)

        self.create_subscription(message_type, f'estimator/{topic}', keep, QoSProfile(depth=5000))
        return store

    def _keep_regimes(self) -> list:
        """Keep ``stale`` apart, since no message causes it."""

        def keep(message: String) -> None:
            (self.stale_regimes if message.data == 'stale' else self.regimes).append(message.data)

        self.create_subscription(String, 'estimator/regime', keep, QoSProfile(depth=5000))
        return self.regimes

    @contextmanager
    def estimator(self, *ros_arguments: str, greet: bool = True) -> Iterator[Program]:
        """Run the installed estimator, connected with this node in both directions."""
        source = (
            ()
            if self._tension_source in (None, 'array')
            else ('-p', f'tension_source:={self._tension_source}')
        )
        arguments = (*source, *ros_arguments)
        if arguments:
            arguments = ('--ros-args', *arguments)
        with Program.running('estimator', *arguments) as program:
            self.connect(program, greet=greet)
            yield program

    def connect(self, program: Program, *, without: str = '', greet: bool = True) -> None:
        """Wait until messages pass both ways on every topic but the one named.

        That both ends are found is known on this side only, and the first messages may be lost
        while the other side does not know yet. So the estimator is greeted with tensions that it
        answers on all topics, until it has answered; what it said is then forgotten.
        """
        kept = {
            subscription.topic_name: store
            for subscription, store in zip(self._answered, self._stores, strict=True)
            if not (without and subscription.topic_name.endswith(without))
        }

        def found() -> bool:
            assert program.process.poll() is None, program.output()
            return all(
                publisher.get_subscription_count() > 0 for publisher in self.tension_publishers
            ) and all(
                subscription.get_publisher_count() > 0
                for subscription in self._answered
                if subscription.topic_name in kept
            )

        wait_for('the estimator', found)
        if not greet:
            return
        self.forget()
        deadline = time.monotonic() + TIME_LIMIT
        while not all(kept.values()):
            assert time.monotonic() < deadline, f'no answer on all of {", ".join(kept)}'
            self.publish(*ANSWERED_ON_ALL_TOPICS)
            with suppress(TimeoutError):
                wait_for('an answer', lambda: all(kept.values()), time_limit=0.5)
        # Nothing is lost any more: each topic is seen to answer the last of these that it answers.
        self.publish(*MIRRORED)
        wait_for('the mirrored angle', lambda: self.bend_angles[-1] < 0.0)
        wait_for(
            'the mirrored pressure', lambda: self.joint_pressures[-1] > self.joint_pressures[0]
        )
        wait_for('the mirrored pose', lambda: self.unit_poses[-1].pose.pose.orientation.y < 0.0)
        wait_for('the mirrored margin', lambda: self.slip_margins[-1] < 0.0)
        wait_for('the mirrored joint', lambda: self.joint_states[-1].position[0] < 0.0)
        numbers = (self.bend_angles, self.slip_margins, self.unit_poses, self.joint_states)
        before = [len(store) for store in (*numbers, self.joint_pressures)]
        self.publish(*ANSWERED_AS_HELD)
        wait_for('the regime held', lambda: self.regimes[-1] == 'held')
        wait_for('the intervals of a held unit', lambda: len(self.admissible_angles[-1].data) > 0)
        if not without:
            wait_for('the estimate of a held unit', lambda: self.estimates[-1].regime == 'held')
            # A tracker knows where it is held.
            held = self.estimates[-1]
            known = [not math.isnan(held.bend_angle)] * 4 + [not math.isnan(held.pressure)]
            for store, count, more in zip(
                (*numbers, self.joint_pressures), before, known, strict=True
            ):
                wait_for('the numbers of a held unit', lambda s=store, n=count + more: len(s) == n)
        self.forget()

    def forget(self) -> None:
        """Forget all that came of results."""
        for store in self._stores:
            store.clear()

    def hears_all(self) -> bool:
        """Whether something came of results on every topic."""
        return all(self._stores)

    def connect_to_services(self, program: Program) -> None:
        """Wait until the estimator's services are there; it may be in any state."""

        def found() -> bool:
            assert program.process.poll() is None, program.output()
            return all(client.service_is_ready() for client in self._clients_by_name.values())

        wait_for('the services', found)

    def change_state(self, transition: str) -> bool:
        """Ask for a transition of the estimator's lifecycle by its label."""
        before = self.estimator_state()
        request = ChangeState.Request(transition=Transition(label=transition))
        changed = self.call('change_state', request).success
        # An answer may be lost after it was done; the second call then finds it done.
        return changed or self.estimator_state() != before

    def estimator_state(self) -> str:
        """Return the state of the estimator's lifecycle."""
        return self.call('get_state', GetState.Request()).current_state.label

    def wait_for_status(
        self, level: bytes, *parts: str, since: int | None = None
    ) -> DiagnosticStatus:
        """Wait for a status of a level whose message has these parts.

        It is the first after the number `since` of those that have come; of those to come, if
        that is not given.
        """
        begin = len(self.diagnostics) if since is None else since

        def newest() -> list[DiagnosticStatus]:
            return [
                status
                for status in self.diagnostics[begin:]
                if status.level == level and all(part in status.message for part in parts)
            ]

        wait_for(f'a status with {parts}', lambda: bool(newest()))
        return newest()[0]

    def count(self, key: str) -> int:
        """Return a count of the newest report on ``/diagnostics``."""
        (value,) = [item.value for item in self.diagnostics[-1].values if item.key == key]
        return int(value)

    def wait_for_node(self, name: str, namespace: str = '/') -> None:
        """Wait until a node is known by name, which is later than its topics are."""
        wait_for(name, lambda: (name, namespace) in self.get_node_names_and_namespaces())

    def publish(self, *data: float, stamp: Time | None = None) -> None:
        """Publish one reading; unless it is an array, stamped with the present time or `stamp`."""
        values = [float(value) for value in data]
        if self._tension_source == 'array':
            self.tension_publishers[0].publish(Float64MultiArray(data=values))
            return
        header = Header(stamp=stamp or self.get_clock().now().to_msg())
        if self._tension_source == 'joint_state':
            names = ['cable_l', 'cable_s']
            message = JointState(header=header, name=names[: len(values)], effort=values)
            self.tension_publishers[0].publish(message)
            return
        for publisher, value in zip(self.tension_publishers, values, strict=True):
            publisher.publish(WrenchStamped(header=header, wrench=_wrench(value)))

    def publish_one(self, tension: float) -> None:
        """Publish what the load cell of cable l says, and nothing of the other."""
        header = Header(stamp=self.get_clock().now().to_msg())
        message = WrenchStamped(header=header, wrench=_wrench(tension))
        self.tension_publishers[0].publish(message)

    def answer(self, *data: float) -> str:
        """Publish one message and wait until its regime, the first thing said of it, is here."""
        before = len(self.regimes)
        self.publish(*data)
        wait_for(f'an answer to {data}', lambda: len(self.regimes) > before)
        return self.regimes[before]

    def newest_estimate(self) -> Any:
        """Wait for the estimate of the last answer, which is the last thing said of it."""

        def come() -> bool:
            return len(self.estimates) >= sum(regime != 'invalid' for regime in self.regimes)

        wait_for('the estimate', come)
        return self.estimates[-1]

    def call(self, name: str, request: Any) -> Any:
        """Call a service of the estimator.

        An answer may be lost while the estimator does not know this client yet, so the call is
        repeated; none of the services counts its calls.
        """
        client = self._clients_by_name[name]
        assert client.wait_for_service(TIME_LIMIT)
        deadline = time.monotonic() + TIME_LIMIT
        while True:
            future = client.call_async(request)
            try:
                wait_for(f'an answer of {name}', future.done, time_limit=2.0)
                return future.result()
            except TimeoutError:
                if time.monotonic() > deadline:
                    raise

    def solve(self, tension_l: float, tension_s: float) -> Solve.Response:
        """Call ``~/solve``."""
        return self.call('solve', Solve.Request(tension_l=tension_l, tension_s=tension_s))

    def solve_inverse(self, bend_angle: float, **given: float) -> SolveInverse.Response:
        """Call ``~/solve_inverse``."""
        request = SolveInverse.Request(bend_angle=bend_angle, **given)
        return self.call('solve_inverse', request)

    def reset(self) -> Trigger.Response:
        """Call ``~/reset``."""
        return self.call('reset', Trigger.Request())

    def tare(self) -> Trigger.Response:
        """Call ``~/tare``."""
        return self.call('tare', Trigger.Request())

    def solve_latest(self) -> Trigger.Response:
        """Call ``~/solve_latest``."""
        return self.call('solve_latest', Trigger.Request())

    def set_estimator_parameters(self, **values: ParameterValue) -> SetParametersResult:
        """Set parameters of the estimator in one step; ``__`` stands for a dot."""
        parameters = [
            Parameter(name=name.replace('__', '.'), value=value) for name, value in values.items()
        ]
        request = SetParametersAtomically.Request(parameters=parameters)
        return self.call('set_parameters_atomically', request).result

    def estimator_parameter(self, name: str) -> Any:
        """Return the value of a parameter of the estimator."""
        request = GetParameters.Request(names=[name])
        answer = self.call('get_parameters', request)
        return parameter_value_to_python(answer.values[0])

    def describe_estimator_parameters(self, *names: str) -> list:
        """Return descriptors of parameters of the estimator."""
        request = DescribeParameters.Request(names=list(names))
        return self.call('describe_parameters', request).descriptors


def _wrench(tension: float) -> Wrench:
    return Wrench(force=Vector3(z=tension))
