"""The node ``estimator``: bend angle and joint pressure for every pair of tensions."""

from __future__ import annotations

import json
from collections.abc import Sequence

from geometry_msgs.msg import PoseWithCovarianceStamped
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.time import Time
from std_msgs.msg import Float64, Float64MultiArray, Header, String
from std_srvs.srv import Trigger

from ..physics import DesignError, Equilibrium, TensionError, solve
from . import messages
from .design_parameters import changed_design, declare_design
from .program import StartError, run_node

WARNING_PERIOD = 5.0
"""Least time in s between two warnings that messages cause."""

INVALID = 'invalid'
"""What ``~/regime`` says of a message that is no pair of tensions."""

MAX_TENSION_STDDEV = 1000.0
"""Largest standard deviation of a tension in N that is taken."""

INPUT_DEPTH = 1000
"""Tension messages kept while the node is busy, so that a burst or a stall loses none."""


class Estimator(Node):
    """Solves every pair of tensions that arrives and publishes what the model determines."""

    def __init__(self) -> None:
        super().__init__('estimator')
        self._design = declare_design(self)
        self._tension_stddev = self._declare_tension_stddev()
        self._frame_id = self.declare_parameter(
            'frame_id',
            'joint',
            ParameterDescriptor(
                description='Frame of the joint, in every stamped message: origin in the centre '
                'of the ball, Z along the unit at zero bend, X towards cable s'
            ),
        ).value
        self._latest: tuple[float, float, Time] | None = None
        self._invalid_count = 0
        self._invalid_since_latest = 0
        self._invalid_reason = ''

        self._regime = self._publisher(String, '~/regime')
        self._bend_angle = self._publisher(Float64, '~/bend_angle')
        self._joint_pressure = self._publisher(Float64, '~/joint_pressure')
        self._unit_pose = self._publisher(PoseWithCovarianceStamped, '~/unit_pose')
        self.create_service(Trigger, '~/solve_latest', self._on_solve_latest)
        self._estimate = None
        if messages.INTERFACES_MISSING:
            self.get_logger().warning(
                'No ~/solve and no ~/estimate, since tendon_statics_interfaces is not there '
                f'({messages.INTERFACES_MISSING}). It is in the folder interfaces/: '
                'colcon build --base-paths . interfaces'
            )
        else:
            self._estimate = self._publisher(messages.Estimate, '~/estimate')
            self.create_service(messages.Solve, '~/solve', self._on_solve)
        # Last, since every declaration fires them too.
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._take_parameters)
        self._tensions = self.create_subscription(
            Float64MultiArray,
            'tensions',
            self._on_tensions,
            QoSProfile(depth=INPUT_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def _publisher(self, message_type: type, topic: str) -> Publisher:
        return self.create_publisher(
            message_type,
            topic,
            QoSProfile(depth=10),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def _declare_tension_stddev(self) -> float:
        descriptor = ParameterDescriptor(
            description='[N]: standard deviation of each measured tension, the two independent',
            floating_point_range=[FloatingPointRange(from_value=0.0, to_value=MAX_TENSION_STDDEV)],
            dynamic_typing=True,
        )
        parameter = Parameter(
            'tension_stddev',
            value=self.declare_parameter('tension_stddev', 0.01, descriptor).value,
        )
        return _checked_stddev(parameter.value)

    # Parameters: all of a change is checked before any of it is taken.

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        try:
            changed_design(self._design, parameters)
            for parameter in parameters:
                if parameter.name == 'tension_stddev':
                    _checked_stddev(parameter.value)
        except (DesignError, StartError) as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _take_parameters(self, parameters: list[Parameter]) -> None:
        self._design = changed_design(self._design, parameters)
        for parameter in parameters:
            if parameter.name == 'tension_stddev':
                self._tension_stddev = _checked_stddev(parameter.value)

    # Topics

    def _on_tensions(self, message: Float64MultiArray) -> None:
        stamp = self.get_clock().now()
        try:
            tension_l, tension_s = messages.tensions_from_array(message)
            equilibrium = solve(self._design, tension_l, tension_s)
        except TensionError as error:
            self._refuse(str(error))
            return
        self._latest = (tension_l, tension_s, stamp)
        self._invalid_since_latest = 0
        self._publish(equilibrium, stamp)

    def _refuse(self, reason: str) -> None:
        """Count and report a message that is no pair of tensions."""
        self._invalid_count += 1
        self._invalid_since_latest += 1
        self._invalid_reason = reason
        self._regime.publish(String(data=INVALID))
        self.get_logger().warning(
            f'Invalid message on {self._tensions.topic_name} '
            f'({self._invalid_count} so far): {reason}',
            throttle_duration_sec=WARNING_PERIOD,
        )

    def _publish(self, equilibrium: Equilibrium, stamp: Time) -> None:
        self._regime.publish(String(data=equilibrium.regime.value))
        header = Header(stamp=stamp.to_msg(), frame_id=self._frame_id)
        if equilibrium.bend_angle is not None and equilibrium.pressure is not None:
            self._bend_angle.publish(Float64(data=equilibrium.bend_angle))
            self._joint_pressure.publish(Float64(data=equilibrium.pressure))
            stddev = equilibrium.bend_angle_stddev(self._tension_stddev)
            if stddev is not None:
                pose = messages.unit_pose(self._design, equilibrium.bend_angle, stddev, header)
                self._unit_pose.publish(pose)
        if self._estimate is not None:
            self._estimate.publish(messages.estimate(equilibrium, self._tension_stddev, header))

    # Services

    def _on_solve(
        self, request: messages.Solve.Request, response: messages.Solve.Response
    ) -> messages.Solve.Response:
        try:
            equilibrium = solve(self._design, request.tension_l, request.tension_s)
        except TensionError as error:
            return messages.refuse_solve(response, str(error))
        return messages.fill_solve_response(response, equilibrium, self._tension_stddev)

    def _on_solve_latest(
        self, _request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        response.success = False
        if self._latest is None:
            response.message = f'no valid tensions have come on {self._tensions.topic_name} yet'
            if self._invalid_reason:
                response.message += f'; the newest message was invalid: {self._invalid_reason}'
            return response
        tension_l, tension_s, stamp = self._latest
        try:
            equilibrium = solve(self._design, tension_l, tension_s)
        except TensionError as error:  # valid for the design of then, not for that of now
            response.message = str(error)
            return response
        response.success = True
        response.message = json.dumps(
            {
                **equilibrium.as_dict(),
                'bend_angle_stddev': equilibrium.bend_angle_stddev(self._tension_stddev),
                'pressure_stddev': equilibrium.pressure_stddev(self._tension_stddev),
                'age': (self.get_clock().now() - stamp).nanoseconds * 1e-9,
                'invalid_since': self._invalid_since_latest,
            },
            allow_nan=False,
        )
        return response


def _checked_stddev(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise StartError(f'tension_stddev is {value!r}, which is not a number in N')
    if not 0.0 <= value <= MAX_TENSION_STDDEV:
        raise StartError(f'tension_stddev is {value!r}, allowed is 0 to {MAX_TENSION_STDDEV:g} N')
    return float(value)


def main(args: Sequence[str] | None = None) -> int:
    """Run the node; the entry point of ``ros2 run tendon_statics estimator``."""
    return run_node(Estimator, args)
