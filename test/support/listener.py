"""A node that does with the estimator all that a test asks for."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, ClassVar

from builtin_interfaces.msg import Time as Stamp
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from estimator_client import ARRAY, EstimatorClient
from forked_programs import ForkedProgram
from geometry_msgs.msg import Vector3, Wrench, WrenchStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.context import Context
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.qos import QoSProfile
from ros_programs import Program, answer_of, wait_for
from sensor_msgs.msg import JointState
from stamps import stamp
from std_msgs.msg import Float64, Header
from std_srvs.srv import Trigger
from tendon_statics_interfaces.srv import LoadDesign, SolveInverse

KINDS: dict[str | None, dict[str, type]] = {
    None: {},
    'array': ARRAY,
    'joint_state': {'tensions': JointState},
    'wrench_pair': {'tension_l': WrenchStamped, 'tension_s': WrenchStamped},
}
"""``tension_source`` → topics of tensions → types"""


def reliable_input(tension_source: str | None = 'array') -> list[str]:
    """Return arguments with which the estimator takes every message of tensions."""
    topics = KINDS[tension_source]
    values = (f'qos_overrides./{topic}.subscription.reliability:=reliable' for topic in topics)
    return [part for value in values for part in ('-p', value)]


class Listener(EstimatorClient):
    """Sends tensions of any kind, keeps diagnostics, calls all services, sets parameters.

    Tensions are published as messages of the kind `tension_source`; with None they are left to a
    driver.
    """

    SERVICES: ClassVar[dict[str, type]] = {
        **EstimatorClient.SERVICES,
        'solve_inverse': SolveInverse,
        'solve_latest': Trigger,
        'reset': Trigger,
        'tare': Trigger,
        'change_state': ChangeState,
        'get_parameters': GetParameters,
        'describe_parameters': DescribeParameters,
        'set_parameters': SetParameters,
        'set_parameters_atomically': SetParametersAtomically,
        'load_design': LoadDesign,
        'get_state': GetState,
    }

    PROGRAM = ForkedProgram

    def __init__(self, context: Context, tension_source: str | None = 'array') -> None:
        super().__init__(context, KINDS[tension_source])
        self.tension_source = tension_source
        self.diagnostics: list[DiagnosticStatus] = []
        self.measured_bend_angle = self.create_publisher(Float64, 'measured_bend_angle', 10)
        self._reported: list[int] = []  # when each status was, in ns
        self.create_subscription(
            DiagnosticArray, '/diagnostics', self._keep_report, QoSProfile(depth=5000)
        )

    def _keep_report(self, message: DiagnosticArray) -> None:
        time = stamp(message)
        self.diagnostics.extend(message.status)
        self._reported.extend(time for _ in message.status)

    @contextmanager
    def estimator(self, *ros_arguments: str) -> Iterator[Program]:
        """Run the estimator for the kind of tensions, connected with this node."""
        if self.tension_source not in (None, 'array'):
            ros_arguments = ('-p', f'tension_source:={self.tension_source}', *ros_arguments)
        with super().estimator(*ros_arguments) as program:
            yield program

    def count_kept(self) -> list[int]:
        """How much came of results, by topic."""
        return [len(store) for store in self._stores]

    def hears_all(self) -> bool:
        """Whether something came of results on every topic."""
        return all(self._stores)

    def has_all(self) -> bool:
        """Whether all has come that belongs to the regimes that have; unless they are tracked."""
        answered = [regime for regime in self.regimes if regime != 'invalid']
        angles = sum(not math.isnan(estimate.bend_angle) for estimate in self.estimates)
        pressures = sum(not math.isnan(estimate.pressure) for estimate in self.estimates)
        of_angles = (self.bend_angles, self.slip_margins, self.unit_poses, self.joint_states)
        return (
            len(self.estimates) == len(answered)
            and all(len(store) == angles for store in of_angles)
            and len(self.joint_pressures) == pressures
            and len(self.admissible_angles) == sum(regime != 'slack' for regime in answered)
        )

    def change_state(self, transition: str) -> bool:
        """Ask for a transition of the estimator's lifecycle by its label."""
        request = ChangeState.Request(transition=Transition(label=transition))
        return self.call_once('change_state', request).success

    def estimator_state(self) -> str:
        """Return the state of the estimator's lifecycle."""
        return self.call('get_state', GetState.Request()).current_state.label

    def wait_for_status(
        self, level: bytes, *parts: str, since: int | None = None
    ) -> DiagnosticStatus:
        """Wait for a status of a level whose message has these parts.

        It is the first after the number `since` of those that have come; of those made from now
        on, if that is not given.
        """
        now = self.get_clock().now().nanoseconds

        def newest() -> list[DiagnosticStatus]:
            statuses = self.diagnostics[since:] if since is not None else self._made_after(now)
            return [
                status
                for status in statuses
                if status.level == level and all(part in status.message for part in parts)
            ]

        wait_for(f'a status with {parts}', lambda: bool(newest()))
        return newest()[0]

    def report(self) -> DiagnosticStatus:
        """Wait for a report that is made from now on; others may still be on their way."""
        now = self.get_clock().now().nanoseconds
        wait_for('a report', lambda: bool(self._made_after(now)))
        return self._made_after(now)[0]

    def _made_after(self, time: int) -> list[DiagnosticStatus]:
        pairs = zip(self._reported, self.diagnostics, strict=False)
        return [status for reported, status in pairs if reported > time]

    def count(self, key: str) -> int:
        """Return a count of the newest report on ``/diagnostics``."""
        (value,) = [item.value for item in self.diagnostics[-1].values if item.key == key]
        return int(value)

    def wait_for_node(self, name: str, namespace: str = '/') -> None:
        """Wait until a node is known by name, which is later than its topics are."""
        wait_for(name, lambda: (name, namespace) in self.get_node_names_and_namespaces())

    def publish(self, *data: float, stamp: Stamp | None = None) -> None:
        """Publish one reading; unless it is an array, stamped with the present time or `stamp`."""
        values = [float(value) for value in data]
        if self.tension_source == 'array':
            super().publish(*values)
            return
        header = Header(stamp=stamp or self.get_clock().now().to_msg())
        if self.tension_source == 'joint_state':
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

    def has_all_estimates(self) -> bool:
        """Whether the estimate of every answer has come."""
        return len(self.estimates) >= sum(regime != 'invalid' for regime in self.regimes)

    def newest_estimate(self) -> Any:
        """Wait for the estimate of the last answer, which is the last thing said of it."""
        wait_for('the estimate', self.has_all_estimates)
        return self.estimates[-1]

    def call_once(self, name: str, request: Any) -> Any:
        """Call a service that does something else if it is called again, such as ``~/tare``.

        Its answer cannot be lost, since the estimator has known this node since `connect`.
        """
        client = self._clients_by_name[name]
        wait_for(name, client.service_is_ready)
        return answer_of(client.call_async(request), name)

    def solve_inverse(self, bend_angle: float, **given: float) -> SolveInverse.Response:
        """Call ``~/solve_inverse``."""
        request = SolveInverse.Request(bend_angle=bend_angle, **given)
        return self.call('solve_inverse', request)

    def reset(self) -> Trigger.Response:
        """Call ``~/reset``."""
        return self.call('reset', Trigger.Request())

    def tare(self) -> Trigger.Response:
        """Call ``~/tare``."""
        return self.call_once('tare', Trigger.Request())

    def solve_latest(self) -> Trigger.Response:
        """Call ``~/solve_latest``."""
        return self.call('solve_latest', Trigger.Request())

    def set_estimator_parameters(self, **values: float | str | None) -> SetParametersResult:
        """Set parameters of the estimator in one step; ``__`` stands for a dot, None deletes."""
        request = SetParametersAtomically.Request(parameters=_messages(values))
        return self.call('set_parameters_atomically', request).result

    def set_one_by_one(self, **values: float | str | None) -> list[SetParametersResult]:
        """Set parameters as ``ros2 param set`` and ``load`` do, in one request."""
        request = SetParameters.Request(parameters=_messages(values))
        return self.call('set_parameters', request).results

    def load_design(self, **given: str) -> LoadDesign.Response:
        """Call ``~/load_design``."""
        return self.call('load_design', LoadDesign.Request(**given))

    def estimator_parameter(self, name: str) -> Any:
        """Return the value of a parameter of the estimator."""
        request = GetParameters.Request(names=[name])
        answer = self.call('get_parameters', request)
        return parameter_value_to_python(answer.values[0])

    def describe_estimator_parameters(self, *names: str) -> list:
        """Return descriptors of parameters of the estimator."""
        request = DescribeParameters.Request(names=list(names))
        return self.call('describe_parameters', request).descriptors


def _messages(values: dict[str, float | str | None]) -> list:
    return [
        Parameter(name.replace('__', '.'), value=value).to_parameter_msg()
        for name, value in values.items()
    ]


def _wrench(tension: float) -> Wrench:
    return Wrench(force=Vector3(z=tension))
