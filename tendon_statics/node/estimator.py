"""The node ``estimator``: bend angle and joint pressure for every pair of tensions."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.subscription import Subscription
from rclpy.time import Time
from std_msgs.msg import Float64, Float64MultiArray, Header, String
from std_srvs.srv import Trigger

from ..physics import (
    BendAngleError,
    Equilibrium,
    Regime,
    StickSlipTracker,
    TensionError,
    TrackedState,
    admissible_angles,
    slip_margin,
    solve,
)
from . import messages
from .settings import SettingError, declare_settings, warn_of_unknown_parameters

WARNING_PERIOD = 5.0
"""Least time in s between two warnings that messages cause."""

INVALID = 'invalid'
"""What ``~/regime`` says of a message that is no pair of tensions."""

INPUT_DEPTH = 1000
"""Messages kept while the node is busy, so that a burst or a stall loses none."""

ESTIMATIONS = ('equilibrium', 'tracking')


class Estimator(Node):
    """Publishes what every pair of tensions that arrives says of the unit.

    With the parameter ``estimation`` at ``equilibrium`` each pair is solved by itself, as in the
    paper; at ``tracking`` a `StickSlipTracker` remembers where the unit was.
    """

    def __init__(self) -> None:
        super().__init__('estimator')
        self._settings = declare_settings(self)
        self._frame_id = self._fixed_parameter(
            'frame_id',
            'joint',
            'Frame of the joint, in every stamped message: origin in the centre of the ball, '
            'Z along the unit at zero bend, X towards cable s',
        )
        self._tracker = self._make_tracker()
        self._latest: tuple[float, float, Time] | None = None
        self._invalid_count = 0
        self._invalid_since_latest = 0
        self._invalid_reason = ''
        self._rejected_corrections = 0

        self._regime = self._publisher(String, '~/regime')
        self._bend_angle = self._publisher(Float64, '~/bend_angle')
        self._joint_pressure = self._publisher(Float64, '~/joint_pressure')
        self._unit_pose = self._publisher(PoseWithCovarianceStamped, '~/unit_pose')
        self._slip_margin = self._publisher(Float64, '~/slip_margin')
        self._admissible_angles = self._publisher(Float64MultiArray, '~/admissible_angles')
        self.create_service(Trigger, '~/solve_latest', self._on_solve_latest)
        self.create_service(Trigger, '~/reset', self._on_reset)
        self._estimate = None
        if messages.INTERFACES_MISSING:
            self.get_logger().warning(
                'No ~/solve, ~/solve_inverse and ~/estimate, since tendon_statics_interfaces is '
                f'not there ({messages.INTERFACES_MISSING}). It is in the folder interfaces/: '
                'colcon build --base-paths . interfaces'
            )
        else:
            self._estimate = self._publisher(messages.Estimate, '~/estimate')
            self.create_service(messages.Solve, '~/solve', self._on_solve)
            self.create_service(messages.SolveInverse, '~/solve_inverse', self._on_solve_inverse)
        self._tensions = self._subscription(Float64MultiArray, 'tensions', self._on_tensions)
        if self._tracker is not None:
            self._subscription(Float64, 'measured_bend_angle', self._on_measured_bend_angle)
        warn_of_unknown_parameters(self)
        # Last, since every declaration fires them too.
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._take_parameters)
        estimation = 'equilibrium' if self._tracker is None else 'tracking'
        self.get_logger().info(f'Ready: {estimation} from {self._tensions.topic_name}')

    def _fixed_parameter(self, name: str, default: str, description: str) -> str:
        descriptor = ParameterDescriptor(description=description, read_only=True)
        value: str = self.declare_parameter(name, default, descriptor).value
        return value

    def _make_tracker(self) -> StickSlipTracker | None:
        estimation = self._fixed_parameter(
            'estimation',
            'equilibrium',
            'equilibrium: each pair of tensions is solved by itself; '
            'tracking: the estimator remembers where the unit was',
        )
        if estimation not in ESTIMATIONS:
            raise SettingError(
                f'estimation is {estimation!r}, allowed is {" or ".join(ESTIMATIONS)}'
            )
        if estimation == 'equilibrium':
            return None
        return StickSlipTracker(self._settings.design, self._settings.initial_bend_angle)

    def _publisher(self, message_type: type, topic: str) -> Publisher:
        return self.create_publisher(
            message_type,
            topic,
            QoSProfile(depth=10),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def _subscription(
        self, message_type: type, topic: str, callback: Callable[[Any], None]
    ) -> Subscription:
        return self.create_subscription(
            message_type,
            topic,
            callback,
            QoSProfile(depth=INPUT_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    # Parameters: all of a change is checked before any of it is taken.

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        try:
            self._settings.changed(parameters)
        except SettingError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _take_parameters(self, parameters: list[Parameter]) -> None:
        self._settings = self._settings.changed(parameters)
        if self._tracker is not None:
            before = self._tracker.bend_angle
            self._tracker.change_design(self._settings.design)
            if self._tracker.bend_angle != before:
                self.get_logger().warning(
                    f'The unit was at {before:.6g} rad, beyond the new stop; it is now taken to '
                    f'be at {self._tracker.bend_angle:.6g} rad'
                )
        changes = ', '.join(f'{parameter.name} = {parameter.value!r}' for parameter in parameters)
        self.get_logger().info(f'Changed: {changes}')

    # Topics

    def _on_tensions(self, message: Float64MultiArray) -> None:
        stamp = self.get_clock().now()
        try:
            tension_l, tension_s = messages.tensions_from_array(message)
            result = self._result(self._tracker, tension_l, tension_s)
        except TensionError as error:
            self._refuse(str(error))
            return
        self._latest = (tension_l, tension_s, stamp)
        self._invalid_since_latest = 0
        self._publish(result, stamp)

    def _result(
        self, tracker: StickSlipTracker | None, tension_l: float, tension_s: float
    ) -> Equilibrium | TrackedState:
        if tracker is None:
            return solve(self._settings.design, tension_l, tension_s)
        return tracker.update(tension_l, tension_s)

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

    def _publish(self, result: Equilibrium | TrackedState, stamp: Time) -> None:
        """Publish all that is determined, and nothing else."""
        design, stddev = self._settings.design, self._settings.tension_stddev
        header = Header(stamp=stamp.to_msg(), frame_id=self._frame_id)
        self._regime.publish(String(data=result.regime.value))
        margin = None
        if result.bend_angle is not None:
            margin = slip_margin(design, result.tension_l, result.tension_s, result.bend_angle)
            self._bend_angle.publish(Float64(data=result.bend_angle))
            self._slip_margin.publish(Float64(data=margin))
            angle_stddev = result.bend_angle_stddev(stddev)
            if angle_stddev is not None:
                pose = messages.unit_pose(design, result.bend_angle, angle_stddev, header)
                self._unit_pose.publish(pose)
        if result.pressure is not None:
            self._joint_pressure.publish(Float64(data=result.pressure))
        intervals = []
        if result.regime is not Regime.SLACK:
            intervals = admissible_angles(design, result.tension_l, result.tension_s)
            self._admissible_angles.publish(messages.intervals_array(intervals))
        if self._estimate is not None:
            self._estimate.publish(messages.estimate(result, margin, intervals, stddev, header))

    def _on_measured_bend_angle(self, message: Float64) -> None:
        assert self._tracker is not None
        try:
            self._tracker.reset(message.data)
        except BendAngleError as error:
            self._rejected_corrections += 1
            self.get_logger().warning(
                f'Rejected a measured bend angle ({self._rejected_corrections} so far): {error}',
                throttle_duration_sec=WARNING_PERIOD,
            )

    # Services

    def _on_solve(
        self, request: messages.Solve.Request, response: messages.Solve.Response
    ) -> messages.Solve.Response:
        try:
            equilibrium = solve(self._settings.design, request.tension_l, request.tension_s)
        except TensionError as error:
            return messages.refuse_solve(response, str(error))
        return messages.fill_solve_response(response, equilibrium, self._settings.tension_stddev)

    def _on_solve_inverse(
        self, request: messages.SolveInverse.Request, response: messages.SolveInverse.Response
    ) -> messages.SolveInverse.Response:
        return messages.fill_inverse_response(response, self._settings.design, request)

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
            # A copy, since asking does not move the unit.
            result = self._result(copy.copy(self._tracker), tension_l, tension_s)
        except TensionError as error:  # valid for the design of then, not for that of now
            response.message = str(error)
            return response
        stddev = self._settings.tension_stddev
        response.success = True
        response.message = json.dumps(
            {
                **result.as_dict(),
                'bend_angle_stddev': result.bend_angle_stddev(stddev),
                'pressure_stddev': result.pressure_stddev(stddev),
                'age': (self.get_clock().now() - stamp).nanoseconds * 1e-9,
                'invalid_since': self._invalid_since_latest,
                'rejected_corrections': self._rejected_corrections,
            },
            allow_nan=False,
        )
        return response

    def _on_reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        if self._tracker is None:
            response.success = False
            response.message = 'estimation is equilibrium, which remembers nothing to reset'
        else:
            self._tracker.reset(self._settings.initial_bend_angle)
            response.success = True
            response.message = f'the unit is at {self._settings.initial_bend_angle:.6g} rad'
        return response
