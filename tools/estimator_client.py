"""A node that talks to the estimator: sends tensions, keeps what comes of them, asks it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, ClassVar

from geometry_msgs.msg import PoseWithCovarianceStamped
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile
from ros_programs import Program, ask, become_known, wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray, String
from tendon_statics_interfaces.msg import Estimate
from tendon_statics_interfaces.srv import Solve

ARRAY = {'tensions': Float64MultiArray}
"""Topic of tensions → type, as the estimator takes them by default"""


class EstimatorClient(Node):
    """Keeps all that the estimator publishes, publishes tensions and calls its services.

    Parameters
    ----------
    tensions : mapping
        Topics of tensions → types of their messages.
    """

    SERVICES: ClassVar[dict[str, type]] = {'solve': Solve}
    """Of the estimator, name → type"""

    PROGRAM: ClassVar[type[Program]] = Program
    """How the estimator is run"""

    def __init__(self, context: Context, tensions: Mapping[str, type] = ARRAY) -> None:
        super().__init__('listener', context=context)
        self.regimes: list[str] = []
        self.stale_regimes: list[int] = []
        """How many other regimes came before each ``stale``"""
        self.bend_angles: list[float] = []
        self.joint_pressures: list[float] = []
        self.unit_poses: list[PoseWithCovarianceStamped] = []
        self.joint_states: list[JointState] = []
        self.slip_margins: list[float] = []
        self.admissible_angles: list[Float64MultiArray] = []
        self.estimates: list[Estimate] = []
        self.tension_publishers = [
            self.create_publisher(message_type, topic, 1000)
            for topic, message_type in tensions.items()
        ]
        self._clients_by_name = {
            name: self.create_client(service_type, f'estimator/{name}')
            for name, service_type in self.SERVICES.items()
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

    def _keep(self, message_type: type, topic: str, store: list, attribute: str = '') -> list:
        def keep(message: Any) -> None:
            store.append(getattr(message, attribute) if attribute else message)

        self.create_subscription(message_type, f'estimator/{topic}', keep, QoSProfile(depth=5000))
        return store

    def _keep_regimes(self) -> list:
        """Keep ``stale`` apart, since no message causes it."""

        def keep(message: String) -> None:
            if message.data == 'stale':
                self.stale_regimes.append(len(self.regimes))
            else:
                self.regimes.append(message.data)

        self.create_subscription(String, 'estimator/regime', keep, QoSProfile(depth=5000))
        return self.regimes

    @contextmanager
    def estimator(self, *ros_arguments: str) -> Iterator[Program]:
        """Run the estimator, connected with this node."""
        arguments = ('--ros-args', *ros_arguments) if ros_arguments else ()
        with self.PROGRAM.running('estimator', *arguments) as program:
            self.connect(program)
            yield program

    def connect(self, program: Program, *, without: str = '') -> None:
        """Wait until nothing is lost any more either way, on every topic but the one named."""
        expected = [
            subscription
            for subscription in self._answered
            if not (without and subscription.topic_name.endswith(without))
        ]

        def found() -> bool:
            assert program.process.poll() is None, program.output()
            return all(
                publisher.get_subscription_count() > 0 for publisher in self.tension_publishers
            ) and all(subscription.get_publisher_count() > 0 for subscription in expected)

        wait_for('the estimator', found)
        become_known(self, 'estimator')

    def forget(self) -> None:
        """Forget all that came of results."""
        for store in self._stores:
            store.clear()

    def publish(self, *data: float) -> None:
        """Publish the tensions of one reading."""
        message = Float64MultiArray(data=[float(value) for value in data])
        self.tension_publishers[0].publish(message)

    def call(self, name: str, request: Any) -> Any:
        """Call a service of the estimator that does the same however often it is called."""
        return ask(self._clients_by_name[name], request)

    def solve(self, tension_l: float, tension_s: float) -> Solve.Response:
        """Call ``~/solve``."""
        return self.call('solve', Solve.Request(tension_l=tension_l, tension_s=tension_s))
