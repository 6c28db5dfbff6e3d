"""A node that talks to the estimator: sends tensions, keeps what comes of them, asks it."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any, ClassVar

from geometry_msgs.msg import PoseWithCovarianceStamped
from lifecycle_msgs.srv import GetState
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile
from ros_programs import TIME_LIMIT, Program, ask, wait_for
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray, String
from tendon_statics_interfaces.msg import Estimate
from tendon_statics_interfaces.srv import Solve

# With the preliminary design.
ANSWERED_ON_ALL_TOPICS = (1.0, 3.0)
MIRRORED = (3.5, 1.0)
ANSWERED_AS_HELD = (1.0, 1.5)

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
    def estimator(self, *ros_arguments: str, greet: bool = True) -> Iterator[Program]:
        """Run the installed estimator, connected with this node in both directions."""
        arguments = ('--ros-args', *ros_arguments) if ros_arguments else ()
        with Program.running('estimator', *arguments) as program:
            self.connect(program, greet=greet)
            yield program

    def connect(self, program: Program, *, without: str = '', greet: bool = True) -> None:
        """Wait until nothing is lost any more either way, on every topic but the one named.

        Unless it is not to be greeted, it has answered tensions then; what it said is forgotten.
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
        self.become_known()
        if not greet:
            return
        self.forget()
        deadline = time.monotonic() + TIME_LIMIT
        while not all(kept.values()):
            missing = ', '.join(topic for topic, store in kept.items() if not store)
            assert time.monotonic() < deadline, f'no answer on {missing}'
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

    def become_known(self) -> None:
        """Wait until the estimator knows all that this node has made so far, and is spun.

        Whether both ends of a topic have found each other is known on this side only, and what
        the other side sends before is lost, or never sent. It learns of the publishers,
        subscriptions and clients of a node in the order in which they were made, so it knows all
        of them when it answers one that is made now.
        """
        ask(self.create_client(GetState, 'estimator/get_state'), GetState.Request())

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
