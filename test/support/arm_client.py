"""A node that talks to the estimator of an arm: sends tensions, keeps what comes, asks it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, ClassVar

from builtin_interfaces.msg import Time as Stamp
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from forked_programs import ForkedProgram
from geometry_msgs.msg import PoseWithCovarianceStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.qos import DurabilityPolicy, QoSProfile
from ros_programs import EXECUTOR, Program, answer_of, become_known, wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, Header
from std_srvs.srv import Trigger
from tendon_statics_interfaces.msg import ArmEstimate, JointRegimes
from tendon_statics_interfaces.srv import SolveArm

RELIABLE = ('-p', 'qos_overrides./tensions.subscription.reliability:=reliable')
"""Arguments with which the estimator takes every message of tensions"""

LATCHED = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class ArmClient(Node):
    """Keeps what the estimator of an arm publishes, and does with it what a test asks for.

    Parameters
    ----------
    cable_names : tuple of str
        Of the arm.
    even : float
        Tension in N of all cables under which the straight arm stays straight.
    """

    SERVICES: ClassVar[dict[str, type]] = {
        'solve_arm': SolveArm,
        'solve_latest': Trigger,
        'reset': Trigger,
        'tare': Trigger,
        'change_state': ChangeState,
        'get_state': GetState,
        'get_parameters': GetParameters,
        'set_parameters': SetParameters,
        'set_parameters_atomically': SetParametersAtomically,
    }

    def __init__(
        self,
        context: Context,
        cable_names: tuple[str, ...],
        even: float = 1.0,
        message_type: type = JointState,
    ) -> None:
        super().__init__('arm_client', context=context)
        self.cable_names = cable_names
        self.even = even
        self.joint_states: list[JointState] = []
        self.tip_poses: list[PoseWithCovarianceStamped] = []
        self.estimates: list[ArmEstimate] = []
        self.regimes: list[JointRegimes] = []
        self.statuses: list[DiagnosticStatus] = []
        self.tensions = self.create_publisher(message_type, 'tensions', 1000)
        self.measured = self.create_publisher(JointState, 'measured_joint_states', 100)
        self._keep(JointState, 'arm_estimator/joint_states', self.joint_states)
        self._keep(PoseWithCovarianceStamped, 'arm_estimator/tip_pose', self.tip_poses)
        self._keep(ArmEstimate, 'arm_estimator/arm_estimate', self.estimates)
        self._keep(JointRegimes, 'arm_estimator/regimes', self.regimes, LATCHED)
        self._answered = list(self.subscriptions)
        self.create_subscription(
            DiagnosticArray,
            '/diagnostics',
            lambda message: self.statuses.extend(message.status),
            QoSProfile(depth=1000),
        )
        self._asked = {
            name: self.create_client(kind, f'arm_estimator/{name}')
            for name, kind in self.SERVICES.items()
        }

    def _keep(self, kind: type, topic: str, store: list, qos: QoSProfile | None = None) -> None:
        self.create_subscription(kind, topic, store.append, qos or QoSProfile(depth=5000))

    @contextmanager
    def estimator(self, *arguments: str, greet: bool = True) -> Iterator[Program]:
        """Run the estimator of an arm, connected with this node.

        Unless it is not to be greeted, it has answered even tensions, and that is forgotten.
        """
        more = ('-p', f'executor:={EXECUTOR}') if EXECUTOR else ()
        with ForkedProgram.running(
            'arm_estimator', '--ros-args', *RELIABLE, *arguments, *more
        ) as program:
            self.connect(program)
            if greet:
                self.settle()
                self.forget()
            yield program

    def connect(self, program: Program) -> None:
        """Wait until nothing is lost any more of what goes either way."""

        def found() -> bool:
            assert program.process.poll() is None, program.output()
            return (
                self.tensions.get_subscription_count() > 0
                and self.measured.get_subscription_count() > 0
                and all(of.get_publisher_count() > 0 for of in self._answered)
                and all(of.service_is_ready() for of in self._asked.values())
            )

        wait_for('the estimator of the arm', found)
        become_known(self, 'arm_estimator')

    def settle(self) -> None:
        """Wait until as much has come on all topics; a mark tells the last."""
        mark = self.get_clock().now().to_msg()
        self.send_even(mark)
        for store in (self.joint_states, self.tip_poses, self.estimates, self.regimes):
            wait_for(
                'the last answer',
                lambda of=store: bool(of) and of[-1].header.stamp == mark,
            )

    def forget(self) -> None:
        """Forget what came of results."""
        for store in (self.joint_states, self.tip_poses, self.estimates, self.regimes):
            store.clear()

    def send_even(self, stamp: Stamp | None = None) -> None:
        """Publish the same tension of all cables."""
        self.send(dict.fromkeys(self.cable_names, self.even), stamp)

    def send(self, tensions: Mapping[str, float], stamp: Stamp | None = None) -> None:
        """Publish tensions of cables by name, stamped with the present time or `stamp`."""
        efforts = [float(value) for value in tensions.values()]
        header = Header(stamp=stamp or self.get_clock().now().to_msg())
        self.tensions.publish(JointState(header=header, name=list(tensions), effort=efforts))

    def answer(self, tensions: Mapping[str, float]) -> ArmEstimate:
        """Publish valid tensions and return the estimate of them."""
        stamp = self.get_clock().now().to_msg()
        self.send(tensions, stamp)

        def found() -> list[ArmEstimate]:
            # By its stamp, since an answer to what was sent before may come as late.
            return [estimate for estimate in self.estimates if estimate.header.stamp == stamp]

        wait_for(f'an answer to {tensions}', found)
        return found()[0]

    def measure(self, **angles: float) -> None:
        """Publish measured angles of joints by name."""
        self.measured.publish(
            JointState(name=list(angles), position=[float(angle) for angle in angles.values()])
        )

    def call(self, name: str, request: Any) -> Any:
        """Call a service, whose answer cannot be lost since the estimator knows this node."""
        return answer_of(self._asked[name].call_async(request), name)

    def trigger(self, name: str) -> Trigger.Response:
        """Call a service that takes nothing."""
        return self.call(name, Trigger.Request())

    def change_state(self, transition: str) -> bool:
        """Ask for a transition of the lifecycle by its label."""
        request = ChangeState.Request(transition=Transition(label=transition))
        return self.call('change_state', request).success

    def set_parameters(self, **values: Any) -> Any:
        """Set parameters in one step; ``__`` stands for a dot."""
        parameters = [
            Parameter(name.replace('__', '.'), value=value).to_parameter_msg()
            for name, value in values.items()
        ]
        request = SetParametersAtomically.Request(parameters=parameters)
        return self.call('set_parameters_atomically', request).result

    def parameter(self, name: str) -> Any:
        """Return the value of a parameter."""
        answer = self.call('get_parameters', GetParameters.Request(names=[name]))
        return parameter_value_to_python(answer.values[0])

    def status(self, level: bytes, *parts: str, since: int | None = None) -> DiagnosticStatus:
        """Wait for a status of a level whose message has these parts.

        It is the first after the number `since` of those that have come, or from now on. A report
        tells of the second before it, so what is said once may be told before it is asked for.
        """
        before = len(self.statuses) if since is None else since

        def fitting() -> list[DiagnosticStatus]:
            return [
                status
                for status in self.statuses[before:]
                if status.level == level and all(part in status.message for part in parts)
            ]

        wait_for(f'a status with {parts}', lambda: bool(fitting()))
        return fitting()[0]


def values(status: DiagnosticStatus) -> dict[str, str]:
    """What a status counts, by what it is."""
    return {item.key: item.value for item in status.values}


def array(*data: float) -> Float64MultiArray:
    """Return an array of tensions."""
    return Float64MultiArray(data=[float(value) for value in data])


def same(ours: list[float], theirs: list[float]) -> bool:
    """Whether numbers are the same to the last bit, NaN being the same as NaN."""
    return len(ours) == len(theirs) and all(
        a == b or (math.isnan(a) and math.isnan(b)) for a, b in zip(ours, theirs, strict=True)
    )
